#include "gltf_ext/mesh_rules.h"

#include <algorithm>
#include <numeric>

#include "codec/face_groups.h"
#include "codec/payload.h"

namespace tutte {
namespace {

Failure invalid(std::string where, std::string what) {
  return {FailureKind::kInvalid, std::move(where), std::move(what)};
}

bool allBelow(const std::vector<Index>& values, Index bound) {
  return std::ranges::all_of(values, [&](Index value) { return value < bound; });
}

Outcome<Done> checkCorners(const PolygonMesh& mesh) {
  const std::vector<Index>& degrees = mesh.polygons.face_degrees;
  const size_t corners = mesh.polygons.corners.size();
  const uint64_t sum = std::accumulate(degrees.begin(), degrees.end(), uint64_t{0});
  if (sum != corners) return invalid("polygons", "the degrees do not add up to the number of corners");
  if (!allBelow(mesh.polygons.corners, mesh.polygons.vertex_count)) {
    return invalid("polygons", "a corner names a vertex that does not exist");
  }
  if (!mesh.wedges.empty() && mesh.wedges.size() != corners) {
    return invalid("wedges", "there is not one wedge per corner");
  }
  if (mesh.wedges.empty() && mesh.wedge_count != mesh.polygons.vertex_count) {
    return invalid("wedges", "without wedges per corner, there must be as many wedges as vertices");
  }
  if (!allBelow(mesh.wedges, mesh.wedge_count)) return invalid("wedges", "a corner names a wedge that does not exist");
  return Done{};
}

Outcome<Done> checkFaces(const PolygonMesh& mesh) {
  const size_t faces = mesh.polygons.face_degrees.size();
  if (!mesh.groups.empty() && mesh.groups.size() != faces) return invalid("groups", "there is not one group per face");
  if (mesh.group_count > std::max<size_t>(faces, 1)) return invalid("groups", "there are more groups than faces");
  if (mesh.group_count == 0 && faces != 0) return invalid("groups", "there are faces, but no group");
  if (!allBelow(mesh.groups, mesh.group_count)) return invalid("groups", "a face names a group that does not exist");
  if (mesh.ring_owners.empty()) return Done{};
  if (mesh.ring_owners.size() != faces) return invalid("rings", "there is not one ring owner per face");
  if (!ringsAreValid(mesh.ring_owners, mesh.groups)) {
    return invalid("rings", "an interior ring must belong to an exterior ring of its own group");
  }
  return Done{};
}

Outcome<Done> checkTriangles(const PolygonMesh& mesh) {
  const Triangulation& triangles = mesh.triangulation;
  if (triangles.counts.empty() && triangles.corners.empty()) return Done{};
  const uint64_t sum = std::accumulate(triangles.counts.begin(), triangles.counts.end(), uint64_t{0});
  if (triangles.counts.size() != mesh.polygons.face_degrees.size() || 3 * sum != triangles.corners.size()) {
    return invalid("triangulation", "the triangle counts do not fit the polygons or the triangles");
  }
  if (sum >= kNone / 3) return invalid("triangulation", "there are more than 2^32 triangle corners");
  if (!allBelow(triangles.corners, static_cast<Index>(mesh.polygons.corners.size()))) {
    return invalid("triangulation", "a triangle names a corner that does not exist");
  }
  return Done{};
}

Outcome<Done> checkAttributes(const PolygonMesh& mesh) {
  if (mesh.attributes.empty()) return Done{};
  if (mesh.attributes.size() > kMaxAttributes) return invalid("attributes", "there are too many attributes");
  if (mesh.attributes[0].name != "POSITION") return invalid("attributes", "the first attribute must be POSITION");
  for (const Attribute& attribute : mesh.attributes) {
    if (attribute.components < 1 || attribute.components > 4) {
      return invalid(attribute.name, "an attribute must have 1 to 4 components");
    }
    if (attribute.data.size() != uint64_t{mesh.wedge_count} * attribute.stride()) {
      return invalid(attribute.name, "there is not one value per wedge");
    }
  }
  return Done{};
}

}  // namespace

Outcome<Done> checkMesh(const PolygonMesh& mesh) {
  for (const auto check : {checkCorners, checkFaces, checkTriangles, checkAttributes}) {
    if (Outcome<Done> done = check(mesh); !done) return done;
  }
  return Done{};
}

}  // namespace tutte
