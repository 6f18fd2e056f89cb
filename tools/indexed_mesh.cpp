#include "tools/indexed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string_view>

#include "tools/values.h"

namespace tutte {
namespace {

/// Used vertices first, isolated ones last, both in their order: old vertex -> new.
std::vector<Index> isolatedLast(const IndexedMesh& mesh) {
  std::vector<Index> map(mesh.vertex_count, kNone);
  for (Index vertex : mesh.corners) map[vertex] = 0;
  Index next = 0;
  for (Index& place : map) place = place == 0 ? next++ : kNone;
  for (Index& place : map) place = place == kNone ? next++ : place;
  return map;
}

/// Where each wedge's values are: a vertex and, per corner attribute, an index or kNone.
struct WedgeSources {
  std::vector<Index> vertices;
  std::vector<std::vector<Index>> indices;
};

/// Numbers the distinct index tuples of corners by (new) vertex, then by tuple.
class WedgeNumbering {
 public:
  WedgeNumbering(const IndexedMesh& mesh, const std::vector<Index>& new_vertices)
      : mesh_(mesh), new_vertices_(new_vertices) {}

  WedgeSources run(PolygonMesh& out) {
    std::vector<Index> order(mesh_.corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return compare(a, b) < 0; });
    WedgeSources sources;
    sources.indices.resize(mesh_.corner_attributes.size());
    out.wedges.resize(mesh_.corners.size());
    for (size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || compare(order[i - 1], order[i]) != 0) addWedge(sources, order[i]);
      out.wedges[order[i]] = static_cast<Index>(sources.vertices.size() - 1);
    }
    return sources;
  }

 private:
  int compare(Index a, Index b) const {
    const auto three_way = [](Index x, Index y) { return x < y ? -1 : x > y ? 1 : 0; };
    if (const int by_vertex = three_way(new_vertices_[mesh_.corners[a]], new_vertices_[mesh_.corners[b]])) {
      return by_vertex;
    }
    for (const auto& attribute : mesh_.corner_attributes) {
      if (const int by_index = three_way(attribute.indices[a], attribute.indices[b])) return by_index;
    }
    return 0;
  }

  void addWedge(WedgeSources& sources, Index corner) const {
    sources.vertices.push_back(mesh_.corners[corner]);
    for (size_t i = 0; i < sources.indices.size(); ++i) {
      sources.indices[i].push_back(mesh_.corner_attributes[i].indices[corner]);
    }
  }

  const IndexedMesh& mesh_;
  const std::vector<Index>& new_vertices_;
};

Attribute gather(const Attribute& values, const std::vector<Index>& sources) {
  Attribute result = values;
  const size_t stride = values.stride();
  result.data.assign(sources.size() * stride, 0);
  for (size_t i = 0; i < sources.size(); ++i) {
    if (sources[i] != kNone) std::memcpy(&result.data[i * stride], &values.data[sources[i] * stride], stride);
  }
  return result;
}

using Vector = std::array<double, 3>;

Vector vectorAt(const std::vector<float>& values, size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

/// Per wedge the sum of the normals of its faces, not normalised.
std::vector<Vector> faceNormalSums(const PolygonMesh& mesh) {
  std::vector<Vector> sums(mesh.wedge_count);
  const Attribute* position = findAttribute(mesh, "POSITION");
  if (!position) return sums;
  const std::vector<float> at = floatsOf(*position);
  Index start = 0;
  for (Index degree : mesh.polygons.face_degrees) {
    Vector normal{};
    for (Index i = 0; i < degree; ++i) {
      const Vector a = vectorAt(at, mesh.wedgeOf(start + i)), b = vectorAt(at, mesh.wedgeOf(start + (i + 1) % degree));
      for (int axis = 0; axis < 3; ++axis) {
        const int y = (axis + 1) % 3, z = (axis + 2) % 3;
        normal[axis] += (a[y] - b[y]) * (a[z] + b[z]);
      }
    }
    for (Index i = 0; i < degree; ++i) {
      for (int axis = 0; axis < 3; ++axis) sums[mesh.wedgeOf(start + i)][axis] += normal[axis];
    }
    start += degree;
  }
  return sums;
}

/// Unit length within what glTF validators accept; zero and non-finite vectors are replaced by the faces' normal.
void repairNormals(PolygonMesh& mesh, std::vector<std::string>& warnings) {
  auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                            [](const Attribute& attribute) { return attribute.name == "NORMAL"; });
  if (found == mesh.attributes.end() || found->type != ComponentType::kFloat) return;
  std::vector<float> normals = floatsOf(*found);
  std::vector<Vector> computed;
  size_t replaced = 0, scaled = 0;
  for (Index wedge = 0; wedge < mesh.wedge_count; ++wedge) {
    Vector normal = vectorAt(normals, wedge);
    double length = std::hypot(normal[0], normal[1], normal[2]);
    if (std::abs(length - 1) < 1e-4) continue;
    if (!(length > 1e-12)) {
      if (computed.empty()) computed = faceNormalSums(mesh);
      normal = computed[wedge];
      length = std::hypot(normal[0], normal[1], normal[2]);
      ++replaced;
    } else {
      ++scaled;
    }
    if (!(length > 0) || !std::isfinite(length)) normal = {0, 0, 1}, length = 1;
    for (int axis = 0; axis < 3; ++axis) normals[3 * wedge + axis] = static_cast<float>(normal[axis] / length);
  }
  if (replaced) warnings.push_back(std::to_string(replaced) + " normals were missing or zero; computed from the faces");
  if (scaled) warnings.push_back(std::to_string(scaled) + " normals were brought to unit length, as glTF demands");
  *found = floatAttribute("NORMAL", 3, normals);
}

void warnAboutGaps(const IndexedMesh& mesh, std::vector<std::string>& warnings) {
  for (const auto& attribute : mesh.corner_attributes) {
    const auto gaps = std::count(attribute.indices.begin(), attribute.indices.end(), kNone);
    if (gaps && attribute.values.name != "NORMAL") {
      warnings.push_back(std::to_string(gaps) + " corners have no " + attribute.values.name + "; they get zeros");
    }
  }
}

/// Wedges with equal values, numbered in order of first appearance.
struct DistinctValues {
  std::vector<Index> numbers;  ///< per wedge
  std::vector<Index> firsts;   ///< per number: the first wedge that has it
};

/// Compares POSITION only, or all attributes, bit by bit.
DistinctValues distinctValues(const PolygonMesh& mesh, bool positions_only) {
  const auto compare = [&](Index a, Index b) {
    for (const Attribute& attribute : mesh.attributes) {
      if (positions_only && attribute.name != "POSITION") continue;
      const size_t stride = attribute.stride();
      const int order = std::memcmp(&attribute.data[a * stride], &attribute.data[b * stride], stride);
      if (order != 0) return order;
    }
    return 0;
  };
  std::vector<Index> order(mesh.wedge_count), first(mesh.wedge_count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return compare(a, b) < 0; });
  for (size_t i = 0; i < order.size(); ++i) {
    first[order[i]] = i > 0 && compare(order[i - 1], order[i]) == 0 ? first[order[i - 1]] : order[i];
  }
  DistinctValues result{std::vector<Index>(mesh.wedge_count), {}};
  for (Index wedge = 0; wedge < mesh.wedge_count; ++wedge) {
    if (first[wedge] == wedge) {
      result.numbers[wedge] = static_cast<Index>(result.firsts.size());
      result.firsts.push_back(wedge);
    } else {
      result.numbers[wedge] = result.numbers[first[wedge]];
    }
  }
  return result;
}

}  // namespace

PolygonMesh buildMesh(IndexedMesh mesh, std::vector<std::string>& warnings) {
  std::erase_if(mesh.corner_attributes, [](const auto& attribute) {
    return std::all_of(attribute.indices.begin(), attribute.indices.end(), [](Index i) { return i == kNone; });
  });
  warnAboutGaps(mesh, warnings);
  const std::vector<Index> new_vertices = isolatedLast(mesh);
  PolygonMesh out;
  WedgeSources sources = WedgeNumbering(mesh, new_vertices).run(out);
  std::vector<Index> old_vertices(mesh.vertex_count);
  for (Index vertex = 0; vertex < mesh.vertex_count; ++vertex) old_vertices[new_vertices[vertex]] = vertex;
  std::vector<uint8_t> used(mesh.vertex_count);
  for (Index vertex : mesh.corners) used[vertex] = 1;
  for (Index vertex : old_vertices) {
    if (used[vertex]) continue;
    sources.vertices.push_back(vertex);
    for (auto& indices : sources.indices) indices.push_back(kNone);
  }
  out.wedge_count = static_cast<Index>(sources.vertices.size());
  if (out.wedge_count == mesh.vertex_count) out.wedges.clear();
  for (Index& vertex : mesh.corners) vertex = new_vertices[vertex];
  out.polygons = {std::move(mesh.face_degrees), std::move(mesh.corners), mesh.vertex_count};
  out.groups = std::move(mesh.groups);
  out.group_count = mesh.group_count;
  for (const Attribute& values : mesh.vertex_attributes) out.attributes.push_back(gather(values, sources.vertices));
  for (size_t i = 0; i < mesh.corner_attributes.size(); ++i) {
    out.attributes.push_back(gather(mesh.corner_attributes[i].values, sources.indices[i]));
  }
  repairNormals(out, warnings);
  return out;
}

PolygonMesh weld(PolygonMesh mesh, std::vector<std::string>& warnings) {
  const DistinctValues vertices = distinctValues(mesh, true);
  const DistinctValues tuples = distinctValues(mesh, false);
  IndexedMesh indexed;
  indexed.vertex_count = static_cast<Index>(vertices.firsts.size());
  indexed.face_degrees = std::move(mesh.polygons.face_degrees);
  indexed.groups = std::move(mesh.groups);
  indexed.group_count = mesh.group_count;
  for (Index corner : mesh.polygons.corners) indexed.corners.push_back(vertices.numbers[corner]);
  for (const Attribute& attribute : mesh.attributes) {
    if (attribute.name == "POSITION") {
      indexed.vertex_attributes.push_back(gather(attribute, vertices.firsts));
      continue;
    }
    std::vector<Index> indices;
    for (Index corner : mesh.polygons.corners) indices.push_back(tuples.numbers[corner]);
    indexed.corner_attributes.push_back({gather(attribute, tuples.firsts), std::move(indices)});
  }
  return buildMesh(std::move(indexed), warnings);
}

}  // namespace tutte
