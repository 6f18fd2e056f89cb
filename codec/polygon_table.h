#pragma once
// Polygons with holes: which faces belong together, and how their corners are numbered.

#include <algorithm>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Corners of one face that follow each other in Polygons::corners.
struct Ring {
  Index first = 0;
  Index degree = 0;
  Index local = 0;  ///< the number that its first corner has within its polygon
};

/// A polygon with its holes. Its corners are numbered locally: the exterior ring's, then the interior rings' in face
/// order.
struct Polygon {
  Ring exterior;
  std::span<const Ring> holes;
  Index corner_count = 0;

  bool drawable() const { return corner_count >= 3; }

  /// The local number of a corner; kNone if it belongs to another polygon. O(log holes).
  Index localOf(Index corner) const {
    const auto after = std::ranges::upper_bound(holes, corner, {}, &Ring::first);
    const Ring& ring = after == holes.begin() || contains(exterior, corner) ? exterior : after[-1];
    return contains(ring, corner) ? ring.local + corner - ring.first : kNone;
  }

  /// All corners by local number.
  void listCorners(std::vector<Index>& corners) const {
    corners.clear();
    appendTo(corners, exterior);
    for (const Ring& hole : holes) appendTo(corners, hole);
  }

 private:
  static bool contains(const Ring& ring, Index corner) { return corner - ring.first < ring.degree; }
  static void appendTo(std::vector<Index>& corners, const Ring& ring) {
    for (Index i = 0; i < ring.degree; ++i) corners.push_back(ring.first + i);
  }
};

/// The polygons of a mesh by face. `ring_owners` is empty or valid (codec/face_groups.h), and both spans must outlive
/// it.
class PolygonTable {
 public:
  PolygonTable(std::span<const Index> degrees, std::span<const Index> ring_owners)
      : degrees_(degrees), owners_(ring_owners), firsts_(degrees.size()) {
    Index first = 0;
    for (size_t face = 0; face < degrees.size(); ++face) {
      firsts_[face] = first;
      first += degrees[face];
    }
    if (!owners_.empty()) gatherHoles();
  }

  Index size() const { return static_cast<Index>(degrees_.size()); }
  Index firstCorner(Index face) const { return firsts_[face]; }
  bool isHole(Index face) const { return !owners_.empty() && owners_[face] != kNone; }
  bool hasHoles(Index face) const { return !owners_.empty() && hole_starts_[face] != hole_starts_[face + 1]; }

  Polygon operator[](Index face) const {
    Polygon polygon;
    polygon.exterior = {firsts_[face], degrees_[face], 0};
    polygon.corner_count = degrees_[face];
    if (owners_.empty()) return polygon;
    polygon.holes = std::span(holes_).subspan(hole_starts_[face], hole_starts_[face + 1] - hole_starts_[face]);
    if (!polygon.holes.empty()) polygon.corner_count = polygon.holes.back().local + polygon.holes.back().degree;
    return polygon;
  }

 private:
  void gatherHoles() {
    hole_starts_.resize(degrees_.size() + 1);
    for (const Index owner : owners_) {
      if (owner != kNone) ++hole_starts_[owner + 1];
    }
    for (size_t face = 0; face < degrees_.size(); ++face) hole_starts_[face + 1] += hole_starts_[face];
    holes_.resize(hole_starts_.back());
    std::vector<Index> next(hole_starts_.begin(), hole_starts_.end() - 1);
    for (size_t face = 0; face < degrees_.size(); ++face) {
      const Index owner = owners_[face];
      if (owner == kNone) continue;
      const Index slot = next[owner]++;
      const Index local =
          slot == hole_starts_[owner] ? degrees_[owner] : holes_[slot - 1].local + holes_[slot - 1].degree;
      holes_[slot] = {firsts_[face], degrees_[face], local};
    }
  }

  std::span<const Index> degrees_, owners_;
  std::vector<Index> firsts_, hole_starts_;
  std::vector<Ring> holes_;
};

}  // namespace tutte
