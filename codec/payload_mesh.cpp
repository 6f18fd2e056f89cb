#include "codec/payload_mesh.h"

#include <algorithm>
#include <utility>

#include "codec/face_groups.h"

namespace tutte {
namespace {

// Each step decodes one section into `mesh`.

Error decodeConnectivity(const PayloadView& payload, PayloadMesh& mesh, Decoder& decoder) {
  const PayloadCounts& counts = payload.counts;
  Result<Connectivity> connectivity =
      decoder.decode(payload[Section::kConnectivity], {counts.points(), counts.faces, counts.corners});
  if (!connectivity) return connectivity.error();
  mesh.connectivity = *std::move(connectivity);
  const bool as_claimed = mesh.connectivity.vertex_count == counts.points() &&
                          mesh.connectivity.face_degrees.size() == counts.faces &&
                          mesh.connectivity.umbrellas.size() == counts.corners;
  return as_claimed ? Error::kNone : Error::kCountMismatch;
}

Error decodeWedges(const PayloadView& payload, PayloadMesh& mesh) {
  if (!payload.has(Section::kSeams)) {
    mesh.seams = withoutSeams(mesh.connectivity, payload.counts.attributes);
    return Error::kNone;
  }
  const PayloadCounts& counts = payload.counts;
  Result<Seams> seams = decodeSeams(mesh.connectivity, counts.welded > 0, payload[Section::kSeams], counts.attributes);
  if (!seams) return seams.error();
  mesh.seams = *std::move(seams);
  if (mesh.seams.wedge_count != counts.wedges || mesh.seams.vertex_count != counts.vertices) {
    return Error::kCountMismatch;
  }
  return Error::kNone;
}

Error decodeFaceGroups(const PayloadView& payload, PayloadMesh& mesh) {
  if (!payload.has(Section::kGroups)) return Error::kNone;
  Result<std::vector<Index>> groups = decodeGroups(mesh.connectivity, payload[Section::kGroups], payload.counts.groups);
  if (!groups) return groups.error();
  mesh.groups = *std::move(groups);
  return Error::kNone;
}

Error decodeRingOwners(const PayloadView& payload, PayloadMesh& mesh) {
  if (!payload.has(Section::kRings)) return Error::kNone;
  Result<std::vector<Index>> owners = decodeRings(payload[Section::kRings], payload.counts.faces);
  if (!owners) return owners.error();
  if (!ringsAreValid(*owners, mesh.groups)) return Error::kMalformed;
  mesh.ring_owners = *std::move(owners);
  return Error::kNone;
}

// The fans of all polygons, which go without saying, are made when the polygons are.
Error decodeTriangles(const PayloadView& payload, PayloadMesh& mesh) {
  if (!payload.has(Section::kTriangulation)) return Error::kNone;
  Result<Triangulation> triangles = decodeTriangulation(mesh.connectivity, mesh.ring_owners,
                                                        payload[Section::kTriangulation], payload.counts.triangles);
  if (!triangles) return triangles.error();
  mesh.triangulation = *std::move(triangles);
  return Error::kNone;
}

/// Values per coded corner, by corner of the mesh.
std::vector<Index> inMeshOrder(const std::vector<Index>& values, const std::vector<Index>& coded_corners) {
  std::vector<Index> result;
  result.reserve(coded_corners.size());
  for (const Index corner : coded_corners) result.push_back(values[corner]);
  return result;
}

/// From coded orientation to that of the mesh: a flipped face keeps its first corner.
void turnFaces(const Connectivity& coded, std::vector<Index>& values) {
  if (coded.flipped.empty() || values.empty()) return;
  auto first = values.begin();
  for (size_t face = 0; face < coded.face_degrees.size(); ++face) {
    const auto end = first + coded.face_degrees[face];
    if (coded.flipped[face] && end - first > 1) std::reverse(first + 1, end);
    first = end;
  }
}

/// The polygons' triangles, if they are not given and not the polygons themselves.
Error completeTriangles(PayloadMesh& mesh, bool given) {
  const bool plain = !given && mesh.ring_owners.empty() && onlyTriangles(mesh.polygons.face_degrees);
  if (!given && !plain) mesh.triangulation = fanTriangulation(mesh.polygons, mesh.ring_owners);
  const size_t corners = plain ? mesh.polygons.corners.size() : mesh.triangulation.corners.size();
  return corners == uint64_t{3} * mesh.counts.triangles ? Error::kNone : Error::kCountMismatch;
}

struct Step {
  Section section;
  Error (*decode)(const PayloadView&, PayloadMesh&);
};

// After the connectivity, in the order in which they need each other.
constexpr Step kSteps[] = {
    {Section::kSeams, decodeWedges},
    {Section::kGroups, decodeFaceGroups},
    {Section::kRings, decodeRingOwners},
};

}  // namespace

bool isWithin(const PayloadCounts& counts, const Limits& limits) {
  return counts.vertices <= limits.max_vertices && counts.wedges <= limits.max_corners &&
         counts.faces <= limits.max_faces && counts.corners <= limits.max_corners &&
         counts.triangles <= limits.max_corners;
}

ArraySource PayloadMesh::arraySource() const {
  return {polygons, wedges, counts.wedges, groups, counts.groups, ring_owners, triangulation};
}

Result<PayloadMesh, PayloadFailure> decodeSections(const PayloadView& payload, const Limits& limits, Decoder& decoder) {
  if (!isWithin(payload.counts, limits)) return PayloadFailure{Error::kLimitExceeded};
  PayloadMesh mesh;
  mesh.counts = payload.counts;
  if (const Error error = decodeConnectivity(payload, mesh, decoder); error != Error::kNone) {
    return PayloadFailure{error, nameOf(Section::kConnectivity)};
  }
  for (const Step& step : kSteps) {
    if (const Error error = step.decode(payload, mesh); error != Error::kNone) {
      return PayloadFailure{error, nameOf(step.section)};
    }
  }
  return mesh;
}

Error completePolygons(const PayloadView& payload, PayloadMesh& mesh) {
  mesh.polygons = polygonsOf(mesh.connectivity, &mesh.coded_corners);
  if (payload.has(Section::kSeams)) mesh.wedges = inMeshOrder(mesh.seams.wedges, mesh.coded_corners);
  if (mesh.counts.welded > 0) {
    mesh.polygons.corners = inMeshOrder(mesh.seams.vertices, mesh.coded_corners);
    mesh.polygons.vertex_count = mesh.counts.vertices;
  }
  return completeTriangles(mesh, payload.has(Section::kTriangulation));
}

Error turnIntoPolygons(const PayloadView& payload, PayloadMesh& mesh) {
  Seams seams = std::exchange(mesh.seams, {});
  seams.attribute_seams = std::vector<std::vector<uint8_t>>();
  if (const Error error = decodeTriangles(payload, mesh); error != Error::kNone) return error;
  Connectivity coded = std::exchange(mesh.connectivity, {});
  coded.twins = std::vector<Index>();
  std::vector<Index>& corners = mesh.polygons.corners;
  if (payload.has(Section::kSeams)) mesh.wedges = std::move(seams.wedges);
  if (mesh.counts.welded > 0) {
    corners = std::move(seams.vertices);
  } else if (!seams.wedges.empty()) {
    corners = std::move(seams.wedges);
  } else {
    corners = std::move(coded.umbrellas);
    if (!coded.vertices.empty()) {
      for (Index& corner : corners) corner = coded.vertices[corner];
    }
  }
  turnFaces(coded, corners);
  turnFaces(coded, mesh.wedges);
  mesh.polygons.face_degrees = std::move(coded.face_degrees);
  mesh.polygons.vertex_count = mesh.counts.vertices;
  return completeTriangles(mesh, payload.has(Section::kTriangulation));
}

Result<PayloadMesh, PayloadFailure> decodePayloadMesh(const PayloadView& payload, const Limits& limits) {
  Decoder decoder;
  return decodePayloadMesh(payload, limits, decoder);
}

Result<PayloadMesh, PayloadFailure> decodePayloadMesh(const PayloadView& payload, const Limits& limits,
                                                      Decoder& decoder) {
  Result<PayloadMesh, PayloadFailure> mesh = decodeSections(payload, limits, decoder);
  if (!mesh) return mesh;
  Error error = decodeTriangles(payload, *mesh);
  if (error == Error::kNone) error = completePolygons(payload, *mesh);
  if (error != Error::kNone) return PayloadFailure{error, nameOf(Section::kTriangulation)};
  return mesh;
}

}  // namespace tutte
