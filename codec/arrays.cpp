#include "codec/arrays.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

#include "codec/polygon_table.h"
#include "codec/start_chain.h"

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
      const Starts starts = startsOf(faces[i], apexes_[i]);
      if (starts.count() == 0)
        list(faces[i], out);
      else
        fan(faces[i], starts.corner(chain_.chosen(i)), out);
    }
    return ngons;
  }

 private:
  /// The first corner that all triangles of the face share; kNone if they are no fan.
  Index fanApex(Index face) {
    if (mesh_.triangulation.counts.empty()) return 0;
    const Index degree = mesh_.polygons.face_degrees[face], first = polygons_.firstCorner(face);
    if (degree < 3 || mesh_.triangulation.counts[face] != degree - 2 || polygons_.hasHoles(face)) return kNone;
    const Index* const triangles = &mesh_.triangulation.corners[starts_[face]];
    Index found = kNone;
    for (int i = 0; i < 3; ++i) {
      const Index apex = triangles[i] - first;
      if (apex < std::min(degree, found) && isFan(triangles, first, degree, apex)) found = apex;
    }
    return found;
  }

  /// Whether triangles, one for each but two of a face's corners, are those of the fan round `apex`: each in any order
  /// that goes round, once.
  bool isFan(const Index* triangles, Index first, Index degree, Index apex) {
    seen_.assign(degree, 0);
    for (Index i = 1; i + 1 < degree; ++i, triangles += 3) {
      const int turn = triangles[0] == first + apex ? 0 : triangles[1] == first + apex ? 1 : 2;
      const Index next = triangles[kTurned[turn]] - first, last = triangles[kTurned[turn + 1]] - first;
      const Index steps = next - apex + (next < apex ? degree : 0);
      if (triangles[turn] != first + apex || next >= degree || steps == 0 || steps + 1 >= degree) return false;
      if (last != (next + 1 < degree ? next + 1 : 0) || seen_[next] != 0) return false;
      seen_[next] = 1;
    }
    return true;
  }

  Starts startsOf(Index face, Index apex) const {
    if (apex == kNone) return {};
    return {&wedges_[polygons_.firstCorner(face)], mesh_.polygons.face_degrees[face], apex};
  }

  void fan(Index face, Index apex, Index*& out) const {
    const Index degree = mesh_.polygons.face_degrees[face];
    const Index* const ring = &wedges_[polygons_.firstCorner(face)];
    Index at = apex;
    const auto next = [&] { return at = at + 1 < degree ? at + 1 : 0; };
    Index before = ring[next()];
    for (Index i = 2; i < degree; ++i) {
      *out++ = ring[apex];
      *out++ = before;
      *out++ = before = ring[next()];
    }
  }

  void list(Index face, Index*& out) const {
    for (Index i = 0; i < 3 * mesh_.triangulation.counts[face]; ++i) {
      *out++ = wedges_[mesh_.triangulation.corners[starts_[face] + i]];
    }
  }

  static constexpr int kTurned[] = {1, 2, 0, 1};

  const ArraySource& mesh_;
  const PolygonTable polygons_;
  const Index* const wedges_;  ///< per corner
  const std::vector<Index> starts_;
  std::vector<Index> apexes_;  ///< of a group's faces
  StartChain chain_;
  std::vector<uint8_t> seen_;  ///< per corner of a face
};

/// The faces themselves as triangles, in one group. Nothing when some triangle starts with an edge of no length: with
/// all others, StartChain takes the first corner whose wedge is not that of the next start, from the last one back.
std::optional<TriangleArray> trianglesThemselves(const ArraySource& mesh) {
  const std::span<const Index> wedges = mesh.wedges.empty() ? mesh.polygons.corners : mesh.wedges;
  TriangleArray array;
  array.values.resize(wedges.size());
  Index after = kNone;
  for (size_t first = wedges.size(); first > 0;) {
    first -= 3;
    const Index a = wedges[first], b = wedges[first + 1], c = wedges[first + 2];
    if (a == b) return std::nullopt;
    Index* const out = &array.values[first];
    const bool turned = a == after;
    out[0] = turned ? b : a;
    out[1] = turned ? c : b;
    out[2] = turned ? a : c;
    after = out[0];
  }
  array.group_starts = {0, static_cast<Index>(wedges.size())};
  array.ngon_encoding = {1};
  return array;
}

/// What there is of each polygon in an array.
enum class Listed { kIndexOffsets, kLoops, kLoopOffsets, kDegrees };

/// Appends what there is of one polygon after the other.
class Lister {
 public:
  Lister(const ArraySource& mesh, Listed what, std::vector<Index>& out)
      : mesh_(mesh), polygons_(mesh.polygons.face_degrees, mesh.ring_owners), what_(what), out_(out) {
    out.reserve(mesh.polygons.face_degrees.size() + (what == Listed::kLoops ? mesh.polygons.corners.size() : 0));
  }

  void beginGroup() {
    offset_ = 0;
    first_ = true;
  }

  void polygon(Index face) {
    const Polygon polygon = polygons_[face];
    if (what_ == Listed::kIndexOffsets || what_ == Listed::kLoopOffsets) {
      out_.push_back(offset_);
      // A separator follows each ring.
      offset_ += what_ == Listed::kIndexOffsets ? 3 * mesh_.triangleCount(face)
                                                : polygon.corner_count + 1 + static_cast<Index>(polygon.holes.size());
      return;
    }
    ring(polygon.exterior);
    for (const Ring& hole : polygon.holes) ring(hole);
  }

 private:
  void ring(const Ring& ring) {
    if (what_ == Listed::kDegrees) return out_.push_back(ring.degree);
    if (!first_) out_.push_back(kNone);
    first_ = false;
    for (Index i = 0; i < ring.degree; ++i) out_.push_back(mesh_.wedgeOf(ring.first + i));
  }

  const ArraySource& mesh_;
  const PolygonTable polygons_;
  const Listed what_;
  std::vector<Index>& out_;
  Index offset_ = 0;    // of the group's next polygon
  bool first_ = false;  // ring of the group
};

DerivedArray listed(const ArraySource& mesh, Listed what) {
  const PolygonOrder order(mesh);
  DerivedArray array;
  Lister lister(mesh, what, array.values);
  for (size_t g = 0; g + 1 < order.group_starts.size(); ++g) {
    array.group_starts.push_back(static_cast<Index>(array.values.size()));
    lister.beginGroup();
    for (Index i = order.group_starts[g]; i < order.group_starts[g + 1]; ++i) lister.polygon(order.faces[i]);
  }
  array.group_starts.push_back(static_cast<Index>(array.values.size()));
  return array;
}

}  // namespace

TriangleArray triangleIndices(const ArraySource& mesh) {
  const bool one_group = mesh.group_count == 1 && mesh.groups.empty() && mesh.ring_owners.empty();
  if (one_group && mesh.triangulation.counts.empty()) {
    if (auto array = trianglesThemselves(mesh)) return *std::move(array);
  }
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

DerivedArray polygonIndexOffsets(const ArraySource& mesh) { return listed(mesh, Listed::kIndexOffsets); }
DerivedArray polygonLoops(const ArraySource& mesh) { return listed(mesh, Listed::kLoops); }
DerivedArray polygonLoopOffsets(const ArraySource& mesh) { return listed(mesh, Listed::kLoopOffsets); }
DerivedArray ringDegrees(const ArraySource& mesh) { return listed(mesh, Listed::kDegrees); }

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
