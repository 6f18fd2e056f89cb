#pragma once
// Where values sit on a mesh. Corners that share a value form a *site*: a vertex for positions; for an attribute with
// seams, the corners of a vertex between two seams.

#include <memory>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// The sites of one attribute over a mesh, as predictors see them. 16 bytes per corner: what is asked for together lies
/// together.
///
/// In a face of more than 2047 corners, the first one's predecessor and the last one's successor are these themselves.
class ValueGraph {
 public:
  /// `sites` gives a number below `site_count` for every corner. O(corners).
  ValueGraph(const Connectivity& mesh, std::span<const Index> sites, Index site_count);

  Index siteCount() const { return static_cast<Index>(first_.size()); }
  Index cornerCount() const { return corner_count_; }

  Index site(Index corner) const { return corners_[corner].site; }
  /// As Connectivity::twins, but kNone where the far side has other sites.
  Index twin(Index corner) const { return corners_[corner].twin; }
  /// The degree of its face, at most 255.
  Index degree(Index corner) const { return corners_[corner].shape & kMostDegree; }
  Index next(Index corner) const {
    return corner + static_cast<Index>(static_cast<int32_t>(corners_[corner].shape << 12) >> 20);
  }
  Index prev(Index corner) const {
    return corner + static_cast<Index>(static_cast<int32_t>(corners_[corner].shape) >> 20);
  }

  /// Calls visit(corner) for the first 64 corners of a site, ascending; those of faces of degree below 3 do not count.
  template <class Visit>
  [[gnu::always_inline]] void forCorners(Index site, Visit visit) const {
    int rest = kMostCorners;
    for (Index corner = first_[site]; corner != kNone && rest > 0; corner = corners_[corner].following, --rest) {
      visit(corner);
    }
  }

  static constexpr int kMostCorners = 64;

 private:
  static constexpr uint32_t kMostDegree = 255;
  static constexpr Index kMostStep = 2047;

  struct Corner {
    Index site, twin;
    uint32_t shape;   // 12 bits the way to the corner before it, 12 bits to the one after it, 8 bits the degree
    Index following;  // the next corner of the site
  };

  void addCorners(const Connectivity& mesh, std::span<const Index> sites);
  void dropSeamTwins();
  void linkCorners();

  Index corner_count_;
  std::unique_ptr<Corner[]> corners_;
  std::vector<Index> first_;  // per site its first corner
};

/// The site of each wedge, numbered by the smallest wedge.
struct WedgeSites {
  std::vector<Index> site_of;
  Index count = 0;
};

/// Joins wedges that no seam parts: those of two faces that meet in an edge which is no seam. `wedges` are per corner,
/// below `wedge_count`; `seams` is per corner, 1 where the edge to the next corner is a seam, or empty. O(corners).
WedgeSites joinWedges(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count,
                      std::span<const uint8_t> seams);

/// Joins all wedges of a vertex. O(corners).
WedgeSites joinVertices(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count);

}  // namespace tutte
