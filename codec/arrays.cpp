#include "codec/arrays.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "codec/polygon_table.h"
#include "codec/start_chain.h"
#include "codec/triangulation_shape.h"

namespace tutte {
namespace {

/// The polygons (no interior rings) in the order of all arrays.
struct PolygonOrder {
  std::vector<Index> faces;
  std::vector<Index> group_starts;

  explicit PolygonOrder(const ArraySource& mesh) : group_starts(mesh.group_count + 1) {
    const Index face_count = static_cast<Index>(mesh.polygons.face_degrees.size());
    const auto group = [&](Index face) { return mesh.groups.empty() ? 0 : mesh.groups[face]; };
    const auto isHole = [&](Index face) { return !mesh.ring_owners.empty() && mesh.ring_owners[face] != kNone; };
    for (Index face = 0; face < face_count; ++face) {
      if (!isHole(face)) ++group_starts[group(face) + 1];
    }
    std::partial_sum(group_starts.begin(), group_starts.end(), group_starts.begin());
    std::vector<Index> next(group_starts.begin(), group_starts.end() - 1);
    faces.resize(group_starts.back());
    for (Index face = 0; face < face_count; ++face) {
      if (!isHole(face)) faces[next[group(face)]++] = face;
    }
  }
};

/// Calls `polygon(face)` for the polygons of each group, and notes in `array` where the groups start.
template <class EachPolygon>
void forEachGroup(const PolygonOrder& order, DerivedArray& array, EachPolygon&& polygon) {
  for (size_t g = 0; g + 1 < order.group_starts.size(); ++g) {
    array.group_starts.push_back(static_cast<Index>(array.values.size()));
    for (Index i = order.group_starts[g]; i < order.group_starts[g + 1]; ++i) polygon(order.faces[i]);
  }
  array.group_starts.push_back(static_cast<Index>(array.values.size()));
}

/// Per face, where its triangles start in Triangulation::corners.
std::vector<Index> triangleStarts(const Triangulation& triangulation) {
  std::vector<Index> starts(triangulation.counts.size());
  Index start = 0;
  for (size_t face = 0; face < starts.size(); ++face) {
    starts[face] = start;
    start += 3 * triangulation.counts[face];
  }
  return starts;
}

/// Writes the triangles of one group after the other.
class TriangleWriter {
 public:
  explicit TriangleWriter(const ArraySource& mesh)
      : mesh_(mesh),
        polygons_(mesh.polygons.face_degrees, mesh.ring_owners),
        wedges_(mesh.wedges.empty() ? mesh.polygons.corners.data() : mesh.wedges.data()),
        starts_(triangleStarts(mesh.triangulation)) {}

  /// Indices in all.
  size_t size() const {
    const Triangulation& triangles = mesh_.triangulation;
    return triangles.counts.empty() ? mesh_.polygons.corners.size() : triangles.corners.size();
  }

  /// Writes the triangles of `faces` to `out`, and tells whether FB_ngon_encoding holds.
  bool write(std::span<const Index> faces, Index*& out) {
    apexes_.resize(faces.size());
    for (size_t i = 0; i < faces.size(); ++i) apexes_[i] = fanApex(faces[i]);
    const bool ngons = chain_.choose(faces.size(), [&](size_t i) { return startsOf(faces[i], apexes_[i]); });
    for (size_t i = 0; i < faces.size(); ++i) {
      const Index degree = mesh_.polygons.face_degrees[faces[i]];
      if (apexes_[i] == kNone)
        list(faces[i], out);
      else
        fan(faces[i], apexes_[i] + chain_.chosen(i) * stepOf(degree), out);
    }
    return ngons;
  }

 private:
  /// The first corner that all triangles of the face share; kNone if they are no fan.
  Index fanApex(Index face) {
    if (mesh_.triangulation.counts.empty()) return 0;
    if (const Index apex = plainFanApex(face); apex != kNone) return apex;
    const Polygon polygon = polygons_[face];
    const Index count = mesh_.triangulation.counts[face];
    shape_.triangles.resize(count);
    for (Index i = 0; i < 3 * count; ++i) {
      shape_.triangles[i / 3][i % 3] = polygon.localOf(mesh_.triangulation.corners[starts_[face] + i]);
    }
    finder_.classify(polygon);
    return shape_.kind == Kind::kFan ? shape_.apex : kNone;
  }

  /// The same for most fans, whose triangles all begin with the apex and go round; kNone for others. All corners of a
  /// triangle are apexes, and both ends of a quad's diagonal.
  Index plainFanApex(Index face) const {
    const Index degree = mesh_.polygons.face_degrees[face], first = polygons_.firstCorner(face);
    if (!mesh_.ring_owners.empty() || degree < 3 || mesh_.triangulation.counts[face] != degree - 2) return kNone;
    const Index* triangle = &mesh_.triangulation.corners[starts_[face]];
    const Index apex = triangle[0] - first;
    if (apex >= degree) return kNone;
    for (Index i = 1; i + 1 < degree; ++i, triangle += 3) {
      const bool next = triangle[0] == first + apex && triangle[1] == first + around(apex + i, degree) &&
                        triangle[2] == first + around(apex + i + 1, degree);
      if (!next) return kNone;
    }
    return degree == 3 ? 0 : degree == 4 ? apex & 1 : apex;
  }

  /// From one possible apex of a fan to the next: in a triangle all corners are, in a quad the diagonal's ends.
  static Index stepOf(Index degree) { return degree == 4 ? 2 : 1; }

  static Index around(Index local, Index degree) { return local < degree ? local : local - degree; }

  Starts startsOf(Index face, Index apex) const {
    Starts starts;
    if (apex == kNone) return starts;
    const Index degree = mesh_.polygons.face_degrees[face];
    const Index* const ring = &wedges_[polygons_.firstCorner(face)];
    starts.count = degree == 3 ? 3 : degree == 4 ? 2 : 1;
    for (Index i = 0; i < starts.count; ++i) starts.wedges[i] = ring[around(apex + i * stepOf(degree), degree)];
    return starts;
  }

  void fan(Index face, Index apex, Index*& out) const {
    const Index degree = mesh_.polygons.face_degrees[face];
    const Index* const ring = &wedges_[polygons_.firstCorner(face)];
    for (Index i = 1; i + 1 < degree; ++i) {
      *out++ = ring[around(apex, degree)];
      *out++ = ring[around(apex + i, degree)];
      *out++ = ring[around(apex + i + 1, degree)];
    }
  }

  void list(Index face, Index*& out) const {
    for (Index i = 0; i < 3 * mesh_.triangulation.counts[face]; ++i) {
      *out++ = wedges_[mesh_.triangulation.corners[starts_[face] + i]];
    }
  }

  const ArraySource& mesh_;
  const PolygonTable polygons_;
  const Index* const wedges_;  ///< per corner
  const std::vector<Index> starts_;
  std::vector<Index> apexes_;  ///< of a group's faces
  StartChain chain_;
  Shape shape_;
  ShapeFinder finder_{shape_};
};

/// Elements of polygonLoops() that a polygon takes, with the separators behind each of its rings.
Index loopLength(const Polygon& polygon) { return polygon.corner_count + 1 + static_cast<Index>(polygon.holes.size()); }

}  // namespace

TriangleArray triangleIndices(const ArraySource& mesh) {
  const PolygonOrder order(mesh);
  TriangleWriter writer(mesh);
  TriangleArray array;
  array.values.resize(writer.size());
  Index* out = array.values.data();
  for (Index g = 0; g < mesh.group_count; ++g) {
    const auto faces =
        std::span(order.faces).subspan(order.group_starts[g], order.group_starts[g + 1] - order.group_starts[g]);
    array.group_starts.push_back(static_cast<Index>(out - array.values.data()));
    array.ngon_encoding.push_back(writer.write(faces, out));
  }
  array.values.resize(static_cast<size_t>(out - array.values.data()));
  array.group_starts.push_back(static_cast<Index>(array.values.size()));
  return array;
}

DerivedArray polygonIndexOffsets(const ArraySource& mesh) {
  const PolygonOrder order(mesh);
  DerivedArray array;
  Index offset = 0;
  forEachGroup(order, array, [&](Index face) {
    if (array.values.size() == array.group_starts.back()) offset = 0;
    array.values.push_back(offset);
    offset += 3 * mesh.triangleCount(face);
  });
  return array;
}

DerivedArray polygonLoops(const ArraySource& mesh) {
  const PolygonOrder order(mesh);
  const PolygonTable polygons(mesh.polygons.face_degrees, mesh.ring_owners);
  DerivedArray array;
  array.values.reserve(mesh.polygons.corners.size() + mesh.polygons.face_degrees.size());
  bool first_of_group = true;
  const auto append = [&](const Ring& ring) {
    if (!first_of_group) array.values.push_back(kNone);
    first_of_group = false;
    for (Index i = 0; i < ring.degree; ++i) array.values.push_back(mesh.wedgeOf(ring.first + i));
  };
  size_t group = 0;
  forEachGroup(order, array, [&](Index face) {
    if (group != array.group_starts.size()) first_of_group = true;
    group = array.group_starts.size();
    append(polygons[face].exterior);
    for (const Ring& hole : polygons[face].holes) append(hole);
  });
  return array;
}

DerivedArray polygonLoopOffsets(const ArraySource& mesh) {
  const PolygonOrder order(mesh);
  const PolygonTable polygons(mesh.polygons.face_degrees, mesh.ring_owners);
  DerivedArray array;
  Index offset = 0;
  forEachGroup(order, array, [&](Index face) {
    if (array.values.size() == array.group_starts.back()) offset = 0;
    array.values.push_back(offset);
    offset += loopLength(polygons[face]);
  });
  return array;
}

DerivedArray ringDegrees(const ArraySource& mesh) {
  const PolygonOrder order(mesh);
  const PolygonTable polygons(mesh.polygons.face_degrees, mesh.ring_owners);
  DerivedArray array;
  forEachGroup(order, array, [&](Index face) {
    const Polygon polygon = polygons[face];
    array.values.push_back(polygon.exterior.degree);
    for (const Ring& hole : polygon.holes) array.values.push_back(hole.degree);
  });
  return array;
}

DerivedArray weldedWedges(const ArraySource& mesh) {
  DerivedArray array{std::vector<Index>(mesh.wedge_count), {0, mesh.wedge_count}};
  std::iota(array.values.begin(), array.values.end(), 0u);
  std::vector<Index> first(mesh.polygons.vertex_count, kNone);
  for (Index corner = 0; corner < mesh.polygons.corners.size(); ++corner) {
    Index& wedge = first[mesh.polygons.corners[corner]];
    wedge = std::min(wedge, mesh.wedgeOf(corner));
  }
  for (Index corner = 0; corner < mesh.polygons.corners.size(); ++corner) {
    array.values[mesh.wedgeOf(corner)] = first[mesh.polygons.corners[corner]];
  }
  return array;
}

Result<std::vector<uint8_t>> packIndices(std::span<const Index> values, uint32_t stride) {
  if (stride != 1 && stride != 2 && stride != 4) return Error::kCountMismatch;
  const Index largest = kNone >> 8 * (4 - stride);
  std::vector<uint8_t> bytes;
  bytes.reserve(values.size() * stride);
  for (const Index value : values) {
    if (value >= largest && value != kNone) return Error::kTooLarge;
    for (uint32_t i = 0; i < stride; ++i) bytes.push_back(static_cast<uint8_t>(value >> 8 * i));
  }
  return bytes;
}

}  // namespace tutte
