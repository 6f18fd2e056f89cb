#include "codec/encode.h"

#include <algorithm>

#include "codec/mesh_oracle.h"
#include "codec/range_coder.h"
#include "codec/repairs.h"
#include "codec/script.h"
#include "codec/section.h"
#include "codec/topology.h"
#include "codec/walk.h"

namespace tutte {
namespace {

constexpr Limits kNoLimits{kNone, kNone, kNone};

SectionHeader describe(const Topology& topology) {
  SectionHeader header;
  header.closed = topology.faces.faceCount() == topology.real_faces;
  const auto& first = topology.faces.first;
  const Index degree = topology.real_faces == 0 ? 3 : first[1];
  if (degree > 15) return header;
  for (Index f = 0; f < topology.real_faces; ++f) {
    if (first[f + 1] - first[f] != degree) return header;
  }
  header.uniform_degree = degree;
  return header;
}

Index sourceFace(const Topology& topology, Index face) {
  return topology.source_face.empty() ? face : topology.source_face[face];
}

Index sourceCorner(const Topology& topology, Index corner) {
  return topology.source_corner.empty() ? corner : topology.source_corner[corner];
}

// Fills in the orders and, coded face by coded face, what the walk did not see: flips and strays.
RepairNotes orderFaces(const Topology& topology, const MeshOracle& oracle, PolygonView mesh, Encoded& encoded) {
  RepairNotes notes;
  encoded.face_order.reserve(mesh.face_degrees.size());
  encoded.corner_order.reserve(mesh.corners.size());
  for (const Index start : oracle.startCorners()) {
    const Index face = topology.faces.face[start];
    encoded.face_order.push_back(sourceFace(topology, face));
    if (!topology.flipped.empty()) notes.flipped.push_back(topology.flipped[face]);
    Index corner = start;
    do {
      encoded.corner_order.push_back(sourceCorner(topology, corner));
      corner = topology.faces.next(corner);
    } while (corner != start);
  }
  if (topology.strays.empty()) return notes;
  std::vector<Index> first(mesh.face_degrees.size() + 1, 0);
  for (size_t f = 0; f < mesh.face_degrees.size(); ++f) first[f + 1] = first[f] + mesh.face_degrees[f];
  for (const Index face : topology.strays) {
    encoded.face_order.push_back(face);
    notes.stray_degrees.push_back(mesh.face_degrees[face]);
    for (Index c = first[face]; c < first[face + 1]; ++c) encoded.corner_order.push_back(c);
  }
  return notes;
}

// Numbers the vertices by their first umbrella, isolated ones last.
void orderVertices(const Topology& topology, const MeshOracle& oracle, PolygonView mesh, Encoded& encoded,
                   RepairNotes& notes) {
  std::vector<Index> number(mesh.vertex_count, kNone);
  encoded.vertex_order.reserve(mesh.vertex_count);
  std::vector<Index> vertices;
  const auto meet = [&](Index vertex) {
    if (number[vertex] == kNone) {
      number[vertex] = static_cast<Index>(encoded.vertex_order.size());
      encoded.vertex_order.push_back(vertex);
    }
    vertices.push_back(number[vertex]);
  };
  for (const Index umbrella : oracle.umbrellaOrder()) meet(topology.vertex_of[umbrella]);
  Index strays = 0;
  for (const Index degree : notes.stray_degrees) strays += degree;
  for (size_t i = encoded.corner_order.size() - strays; i < encoded.corner_order.size(); ++i) {
    meet(mesh.corners[encoded.corner_order[i]]);
  }
  const bool cut = vertices.size() != encoded.vertex_order.size();
  if (cut) notes.vertices = std::move(vertices);
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    if (number[v] != kNone) continue;
    encoded.vertex_order.push_back(v);
    ++notes.isolated;
  }
}

}  // namespace

Result<Encoded> encode(PolygonView mesh, const EncodeOptions&) noexcept {
  Result<Topology> topology = buildTopology(mesh);
  if (!topology) return topology.error();
  SectionHeader header = describe(*topology);
  RangeWriter valences, degrees, repairs;
  MeshOracle oracle(*topology);
  Script script(header, valences, degrees, oracle);
  Walk walk(script, header.tie, kNoLimits);
  if (const Error error = walk.run(); error != Error::kNone) return error;

  Encoded encoded;
  encoded.connectivity = std::move(walk.connectivity());
  encoded.splits = walk.splits();
  RepairNotes notes = orderFaces(*topology, oracle, mesh, encoded);
  orderVertices(*topology, oracle, mesh, encoded, notes);
  header.repairs = notes.any();
  if (header.repairs) {
    RepairCoder coder(repairs, notes, walk.onBoundary(), kNoLimits, encoded.connectivity);
    if (const Error error = coder.run(); error != Error::kNone) return error;
  }
  const std::vector<uint8_t> valence_bytes = std::move(valences).finish();
  const std::vector<uint8_t> degree_bytes = std::move(degrees).finish();
  const std::vector<uint8_t> repair_bytes = std::move(repairs).finish();
  encoded.valence_bytes = static_cast<uint32_t>(valence_bytes.size());
  encoded.degree_bytes = static_cast<uint32_t>(degree_bytes.size());
  encoded.bytes = writeSection(header, {valence_bytes, degree_bytes, repair_bytes});
  return encoded;
}

}  // namespace tutte
