#include "gltf_ext/welding.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "gltf_ext/distinct.h"

namespace tutte {
namespace {

std::span<const uint8_t> valueOf(const Attribute& attribute, Index wedge) {
  return std::span(attribute.data).subspan(size_t{wedge} * attribute.stride(), attribute.stride());
}

/// Per vertex one of its wedges, per wedge its vertex; kNone where no corner is.
struct Owners {
  std::vector<Index> wedge_of, vertex_of;

  explicit Owners(const PolygonMesh& mesh)
      : wedge_of(mesh.polygons.vertex_count, kNone), vertex_of(mesh.wedge_count, kNone) {
    for (Index corner = 0; corner < mesh.polygons.corners.size(); ++corner) {
      const Index vertex = mesh.polygons.corners[corner], wedge = mesh.wedgeOf(corner);
      if (wedge_of[vertex] == kNone) wedge_of[vertex] = wedge;
      vertex_of[wedge] = vertex;
    }
  }
};

}  // namespace

std::optional<Polygons> weldedPolygons(const PolygonMesh& mesh) {
  if (mesh.attributes.empty()) return std::nullopt;
  const Attribute& position = mesh.attributes[0];
  std::vector<Index> vertices, wedges;  // with corners
  const Owners owners(mesh);
  for (Index vertex = 0; vertex < mesh.polygons.vertex_count; ++vertex) {
    if (owners.wedge_of[vertex] == kNone) continue;
    vertices.push_back(vertex);
    wedges.push_back(owners.wedge_of[vertex]);
  }
  const auto value = [&](Index i) { return valueOf(position, wedges[i]); };
  const Distinct points = findDistinct(
      static_cast<Index>(vertices.size()), [&](Index i) { return hashOf(value(i), 0); },
      [&](Index a, Index b) { return std::ranges::equal(value(a), value(b)); });
  if (points.firsts.size() == vertices.size()) return std::nullopt;

  std::vector<Index> point_of(mesh.polygons.vertex_count, kNone);
  for (size_t i = 0; i < vertices.size(); ++i) point_of[vertices[i]] = points.numbers[i];
  Polygons welded{mesh.polygons.face_degrees, mesh.polygons.corners, 0};
  for (Index& corner : welded.corners) corner = point_of[corner];
  const size_t isolated = mesh.polygons.vertex_count - vertices.size();
  welded.vertex_count = static_cast<Index>(points.firsts.size() + isolated);
  return welded;
}

void joinEqualWedges(PolygonMesh& mesh) {
  if (mesh.wedges.empty()) return;  // no vertex has two
  const Owners owners(mesh);
  const auto hash = [&](Index wedge) {
    uint64_t result = hashOf({}, owners.vertex_of[wedge]);
    for (const Attribute& attribute : mesh.attributes) result = hashOf(valueOf(attribute, wedge), result);
    return owners.vertex_of[wedge] == kNone ? hashOf({}, wedge) : result;
  };
  const auto equal = [&](Index a, Index b) {
    if (owners.vertex_of[a] == kNone || owners.vertex_of[a] != owners.vertex_of[b]) return false;
    return std::ranges::all_of(mesh.attributes, [&](const Attribute& attribute) {
      return std::ranges::equal(valueOf(attribute, a), valueOf(attribute, b));
    });
  };
  const Distinct distinct = findDistinct(mesh.wedge_count, hash, equal);
  for (Index& wedge : mesh.wedges) wedge = distinct.numbers[wedge];
  for (Attribute& attribute : mesh.attributes) {
    const size_t stride = attribute.stride();
    for (size_t i = 0; i < distinct.firsts.size(); ++i) {
      std::memmove(&attribute.data[i * stride], &attribute.data[distinct.firsts[i] * stride], stride);
    }
    attribute.data.resize(distinct.firsts.size() * stride);
  }
  mesh.wedge_count = static_cast<Index>(distinct.firsts.size());
}

void keepAttributes(PolygonMesh& mesh, const std::set<std::string>& names) {
  if (names.empty()) return;
  std::erase_if(mesh.attributes, [&](const Attribute& attribute) {
    const std::string name = attribute.name.substr(0, attribute.name.find('@'));
    return name != "POSITION" && !names.count(name);
  });
  joinEqualWedges(mesh);
}

}  // namespace tutte
