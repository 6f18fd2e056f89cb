#include "gltf_ext/gather.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "gltf_ext/distinct.h"

namespace tutte {
namespace {

/// Old wedges in their new order: those that faces use, then the others.
std::vector<Index> usedFirst(const std::vector<PrimitiveFaces>& groups, Index wedge_count, Index& used_count) {
  std::vector<uint8_t> used(wedge_count);
  for (const PrimitiveFaces& group : groups) {
    for (const Index wedge : group.corners) used[wedge] = 1;
  }
  std::vector<Index> order(wedge_count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_partition(order.begin(), order.end(), [&](Index wedge) { return used[wedge]; });
  used_count = static_cast<Index>(std::count(used.begin(), used.end(), 1));
  return order;
}

void reorder(Attribute& attribute, const std::vector<Index>& order) {
  const size_t size = attribute.stride();
  std::vector<uint8_t> data(attribute.data.size());
  for (size_t i = 0; i < order.size(); ++i) {
    std::memcpy(data.data() + i * size, attribute.data.data() + order[i] * size, size);
  }
  attribute.data = std::move(data);
}

/// The vertices of the first wedges, those with corners.
Distinct weld(const Attribute& position, Index used_count) {
  const auto value = [&](Index wedge) {
    return std::span(position.data).subspan(size_t{wedge} * position.stride(), position.stride());
  };
  return findDistinct(
      used_count, [&](Index wedge) { return hashOf(value(wedge), 0); },
      [&](Index a, Index b) { return std::ranges::equal(value(a), value(b)); });
}

void appendTriangulation(PolygonMesh& mesh, const PrimitiveFaces& group, Index first_corner) {
  Triangulation& all = mesh.triangulation;
  if (group.triangulation.counts.empty()) {
    all.counts.insert(all.counts.end(), group.degrees.size(), 1);
    for (Index i = 0; i < group.corners.size(); ++i) all.corners.push_back(first_corner + i);
    return;
  }
  all.counts.insert(all.counts.end(), group.triangulation.counts.begin(), group.triangulation.counts.end());
  for (const Index corner : group.triangulation.corners) all.corners.push_back(first_corner + corner);
}

void appendGroup(PolygonMesh& mesh, const PrimitiveFaces& group, Index number) {
  const auto first_face = static_cast<Index>(mesh.polygons.face_degrees.size());
  const auto first_corner = static_cast<Index>(mesh.wedges.size());
  mesh.polygons.face_degrees.insert(mesh.polygons.face_degrees.end(), group.degrees.begin(), group.degrees.end());
  mesh.wedges.insert(mesh.wedges.end(), group.corners.begin(), group.corners.end());
  mesh.groups.insert(mesh.groups.end(), group.degrees.size(), number);
  mesh.ring_owners.resize(mesh.groups.size(), kNone);
  for (size_t i = 0; i < group.ring_owners.size(); ++i) {
    if (group.ring_owners[i] != kNone) mesh.ring_owners[first_face + i] = first_face + group.ring_owners[i];
  }
  appendTriangulation(mesh, group, first_corner);
}

}  // namespace

PolygonMesh weldMesh(std::vector<PrimitiveFaces> groups, std::vector<Attribute> attributes, Index wedge_count) {
  Index used_count = 0;
  const std::vector<Index> order = usedFirst(groups, wedge_count, used_count);
  std::vector<Index> moved(wedge_count);
  for (Index i = 0; i < wedge_count; ++i) moved[order[i]] = i;

  PolygonMesh mesh;
  mesh.group_count = static_cast<Index>(groups.size());
  bool has_holes = false;
  for (size_t g = 0; g < groups.size(); ++g) {
    for (Index& corner : groups[g].corners) corner = moved[corner];
    appendGroup(mesh, groups[g], static_cast<Index>(g));
    has_holes |= !groups[g].ring_owners.empty();
  }
  if (!has_holes) mesh.ring_owners.clear();
  for (Attribute& attribute : attributes) reorder(attribute, order);
  const Distinct vertices = weld(attributes[0], used_count);
  mesh.polygons.corners.reserve(mesh.wedges.size());
  for (const Index wedge : mesh.wedges) mesh.polygons.corners.push_back(vertices.numbers[wedge]);
  mesh.polygons.vertex_count = static_cast<Index>(vertices.firsts.size()) + (wedge_count - used_count);
  mesh.wedge_count = wedge_count;
  mesh.attributes = std::move(attributes);
  return mesh;
}

}  // namespace tutte
