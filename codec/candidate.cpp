#include "codec/candidate.h"

#include "codec/encoder_memory.h"
#include "codec/mesh_oracle.h"
#include "codec/primal.h"
#include "codec/range_coder.h"
#include "codec/repairs.h"
#include "codec/script.h"
#include "codec/walk.h"

namespace tutte {
namespace {

constexpr Limits kNoLimits{kNone, kNone, kNone};

template <class Statistics>
Result<WalkedCandidate> walkWith(const Topology& topology, const Candidate& candidate, EncoderMemory& memory,
                                 size_t most_bits) {
  RangeWriter port;
  port.wantAtMost(most_bits / 8 + 8);
  MeshOracle oracle(topology, candidate.components, memory.oracle);
  const SectionHeader& header = candidate.header;
  Script<Statistics, RangeWriter, MeshOracle> script(header, port, oracle, memory.statistics);
  Walk walk(script, header.tie, header.leastDegree(), kNoLimits, topology.twin.size(), memory.gaps);
  if (const Error error = walk.run(); error != Error::kNone) return error;
  WalkedCandidate walked;
  walked.header = header;
  walked.connectivity = std::move(walk.connectivity());
  walked.order = {std::move(oracle).startCorners(), std::move(oracle).umbrellaOrder()};
  walked.components = candidate.components;
  walked.on_boundary = std::move(walk).onBoundary();
  walked.dummy_umbrellas = std::move(walk).dummyUmbrellas();
  walked.symbols = std::move(port);
  walked.symbols.wantAll();
  walked.splits = walk.splits();
  return walked;
}

// Where the coded mesh's parts stand in the primal topology.
struct Sources {
  std::vector<Index> corners, faces, umbrellas;
};

std::vector<Index> expandCorners(const Topology& topology, const std::vector<Index>& start_corners) {
  std::vector<Index> corners(topology.faces.first[topology.real_faces]);
  Index* at = corners.data();
  for (const Index start : start_corners) {
    const Index face = topology.faces.faceOf(start);
    const Index first = topology.faces.first[face], end = topology.faces.first[face + 1];
    for (Index corner = start; corner < end; ++corner) *at++ = corner;
    for (Index corner = first; corner < start; ++corner) *at++ = corner;
  }
  return corners;
}

Sources primalSources(const Topology& topology, WalkedCandidate& walked) {
  Sources sources{expandCorners(topology, walked.order.start_corners), {}, std::move(walked.order.umbrellas)};
  sources.faces.reserve(walked.order.start_corners.size());
  for (const Index start : walked.order.start_corners) sources.faces.push_back(topology.faces.faceOf(start));
  return sources;
}

Sources dualSources(const DualTopology& dual, const PrimalMesh& primal, const Topology& primal_topology,
                    const WalkedCandidate& walked) {
  Sources sources;
  const std::vector<Index> dual_corners = expandCorners(dual.topology, walked.order.start_corners);
  for (const Index c : primal.dual_corner) sources.corners.push_back(dual.primal_corner[dual_corners[c]]);
  Index first = 0;
  for (const Index degree : primal.connectivity.face_degrees) {
    sources.faces.push_back(primal_topology.faces.faceOf(sources.corners[first]));
    first += degree;
  }
  for (const Index start : walked.order.start_corners) {
    sources.umbrellas.push_back(dual.primal_umbrella[dual.topology.faces.faceOf(start)]);
  }
  return sources;
}

// Puts what is named in place of its number, where it has another name.
std::vector<Index> renamed(const std::vector<Index>& names, std::vector<Index> numbers) {
  if (names.empty()) return numbers;
  for (Index& number : numbers) number = names[number];
  return numbers;
}

// Fills in the orders of faces and corners, and notes flips and strays. What `sources` says of those is moved away.
RepairNotes orderFaces(const Topology& topology, Sources& sources, PolygonView mesh, Encoded& encoded) {
  RepairNotes notes;
  if (!topology.flipped.empty()) {
    for (const Index face : sources.faces) notes.flipped.push_back(topology.flipped[face]);
  }
  encoded.face_order = renamed(topology.source_face, std::move(sources.faces));
  encoded.corner_order = renamed(topology.source_corner, std::move(sources.corners));
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
void orderVertices(const Topology& topology, const std::vector<Index>& umbrellas, PolygonView mesh, Encoded& encoded,
                   RepairNotes& notes) {
  std::vector<Index> number(mesh.vertex_count, kNone), vertices;
  encoded.vertex_order.reserve(mesh.vertex_count);
  vertices.reserve(umbrellas.size());
  const auto meet = [&](Index vertex) {
    if (number[vertex] == kNone) {
      number[vertex] = static_cast<Index>(encoded.vertex_order.size());
      encoded.vertex_order.push_back(vertex);
    }
    vertices.push_back(number[vertex]);
  };
  for (const Index umbrella : umbrellas) meet(topology.vertex_of[umbrella]);
  for (size_t i = topology.faces.first[topology.real_faces]; i < encoded.corner_order.size(); ++i) {
    meet(mesh.corners[encoded.corner_order[i]]);  // strays
  }
  if (vertices.size() != encoded.vertex_order.size()) notes.vertices = std::move(vertices);
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    if (number[v] != kNone) continue;
    encoded.vertex_order.push_back(v);
    ++notes.isolated;
  }
}

}  // namespace

Result<WalkedCandidate> walkCandidate(TopologyPair& topologies, const Candidate& candidate, EncoderMemory& memory,
                                      size_t most_bits) {
  const Topology& topology = topologies.walked(candidate.header.dual);
  return withQuickStatistics(candidate.header, [&]<class Statistics>(std::type_identity<Statistics>) {
    return walkWith<Statistics>(topology, candidate, memory, most_bits);
  });
}

Result<Encoded> finishCandidate(TopologyPair& topologies, WalkedCandidate&& walked, PolygonView mesh) {
  Encoded encoded;
  Sources sources;
  if (walked.header.dual) {
    Result<PrimalMesh> primal = primalOf(walked.connectivity, walked.dummy_umbrellas, kNoLimits);
    if (!primal) return primal.error();
    sources = dualSources(topologies.dual(), *primal, topologies.primal(), walked);
    walked.connectivity = std::move(primal->connectivity);
    walked.on_boundary = std::move(primal->on_boundary);
  } else {
    const Topology& primal = topologies.primal();
    const bool joins = primal.vertex_of.size() > mesh.vertex_count;
    if (joins) orderCopies(primal, walked.components, walked.connectivity, walked.order);
    sources = primalSources(primal, walked);
  }
  RepairNotes notes = orderFaces(topologies.primal(), sources, mesh, encoded);
  orderVertices(topologies.primal(), sources.umbrellas, mesh, encoded, notes);
  encoded.connectivity = std::move(walked.connectivity);
  walked.header.repairs = notes.any();
  if (notes.any()) {
    RepairCoder coder(walked.symbols, notes, walked.on_boundary, kNoLimits, encoded.connectivity);
    if (const Error error = coder.run(); error != Error::kNone) return error;
  }
  encoded.splits = walked.splits;
  encoded.bytes = writeSection(walked.header, std::move(walked.symbols).finish());
  return encoded;
}

}  // namespace tutte
