#pragma once
// Where values sit on a mesh. Corners that share a value form a *site*: a vertex for positions; for an attribute with
// seams, the corners of a vertex between two seams.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// The ways round the faces of a mesh that has nothing but triangles.
struct TriangleFaces {
  static constexpr bool kAllTriangles = true, kListed = false;

  Index degree(Index) const { return 3; }
  // Sums, because compilers make decisions of comparisons, and which corner it is nobody foresees.
  Index next(Index corner) const { return corner + 1 - 3 * isFirst(corner + 1); }
  Index prev(Index corner) const { return corner - 1 + 3 * isFirst(corner); }

 private:
  // By the inverse of 3: it turns multiples of 3 into the lowest third of all numbers, and no others.
  static Index isFirst(Index corner) { return corner * 0xAAAAAAABu <= 0x55555555u; }
};

/// The same for any faces, from a word per corner: 12 bits the way to the corner before it, 12 bits to the one after
/// it, 8 bits the degree.
struct AnyFaces {
  static constexpr bool kAllTriangles = false, kListed = false;
  static constexpr uint32_t kMostDegree = 255;

  const uint32_t* shapes;

  Index degree(Index corner) const { return shapes[corner] & kMostDegree; }
  Index next(Index corner) const {
    return corner + static_cast<Index>(static_cast<int32_t>(shapes[corner] << 12) >> 20);
  }
  Index prev(Index corner) const { return corner + static_cast<Index>(static_cast<int32_t>(shapes[corner]) >> 20); }
};

/// The sites of one attribute over a mesh, as predictors see them. 4 bytes per site, and 4 more per corner each: where
/// not all faces are triangles, where seams part faces, and twice where the sites are not the umbrellas.
///
/// In a face of more than 2048 corners, the first one's predecessor and the last one's successor are these themselves.
class ValueGraph {
 public:
  /// The sites are the umbrellas, and behind them those that no corner uses. The mesh must stay as and where it is.
  /// O(corners), as the other one.
  ValueGraph(const Connectivity& mesh, Index site_count);
  /// `sites` gives a number below `site_count` for every corner.
  ValueGraph(const Connectivity& mesh, std::vector<Index> sites, Index site_count);
  ValueGraph(ValueGraph&&) = default;

  static constexpr Index kMostCorners = 60;  ///< of a site; further ones are not looked at

  Index siteCount() const { return site_count_; }
  Index cornerCount() const { return static_cast<Index>(sites_.size()); }

  /// The mesh's.
  std::span<const ComponentCopy> copies() const { return copies_; }

  Index site(Index corner) const { return sites_[corner]; }
  /// As Connectivity::twins, but kNone where the far side has other sites.
  Index twin(Index corner) const { return twins_[corner]; }
  /// The degree of its face, at most 255.
  Index degree(Index corner) const { return shapes_.empty() ? 3 : any().degree(corner); }
  Index next(Index corner) const { return shapes_.empty() ? TriangleFaces{}.next(corner) : any().next(corner); }
  Index prev(Index corner) const { return shapes_.empty() ? TriangleFaces{}.prev(corner) : any().prev(corner); }

  /// Calls visit(faces) with what goRound() asks for: for those who go round many of them.
  template <class Visit>
  void withFaces(Visit visit) const {
    if (!fans_.empty()) return visit(ListedFaces{*this});
    shapes_.empty() ? visit(TriangleFaces{}) : visit(any());
  }

  /// Goes round a site: calls step(corner, prev) for each corner, prev being the one before it in its face, and
  /// end(first, beyond) after each fan: corners that share edges, each with the one before it the edge to its own
  /// `next`; in a closed fan, the first with the last, too. `first` is the fan's first corner, and `beyond` the twin of
  /// the last `prev`, which is `first` in a closed fan. An open fan begins where an edge has no twin, a closed one with
  /// its lowest corner; open fans come first. At most 60 corners in all; those of faces of degree below 3 do not count.
  template <class Faces, class Step, class End>
  [[gnu::always_inline]] void goRound(const Faces& faces, Index site, Step step, End end) const {
    if constexpr (Faces::kListed) return goRoundList(site, step, end);
    const Index first = starts_[site];
    if (first == kNone) return;
    Index corner = first, rest = kMostCorners;
    do {
      const Index prev = faces.prev(corner);
      step(corner, prev);
      corner = twins_[prev];
    } while (corner != kNone && corner != first && --rest > 0);
    end(first, corner);
  }

  /// A fan of the site is open.
  bool isOpen(Index site) const {
    const Index first = firstCorner(site);
    return first != kNone && twins_[first] == kNone;
  }

  /// The corners of a site.
  struct CornerList {
    std::array<Index, kMostCorners> corners;
    Index count = 0;

    const Index* begin() const { return corners.data(); }
    const Index* end() const { return corners.data() + count; }
  };

  /// All of them.
  CornerList corners(Index site) const;

 private:
  // Where not every site is one fan, so that fans are listed; few meshes are worth code of their own.
  struct ListedFaces {
    static constexpr bool kAllTriangles = false, kListed = true;

    const ValueGraph& graph;

    Index degree(Index corner) const { return graph.degree(corner); }
    Index next(Index corner) const { return graph.next(corner); }
    Index prev(Index corner) const { return graph.prev(corner); }
  };

  static constexpr Index kLast = 1u << 31;  // marks the last corner of a fan

  AnyFaces any() const { return {shapes_.data()}; }
  bool listShapes(std::span<const Index> face_degrees);
  void findFirsts();
  void listFans();
  void dropSeamTwins();

  Index firstCorner(Index site) const {
    if (fans_.empty()) return starts_[site];
    return starts_[site] < starts_[site + 1] ? fans_[starts_[site]] & ~kLast : kNone;
  }

  template <class Step, class End>
  [[gnu::always_inline]] void goRoundList(Index site, Step step, End end) const {
    Index first = kNone;
    for (Index at = starts_[site], rest = kMostCorners; at < starts_[site + 1] && rest > 0; ++at, --rest) {
      const Index corner = fans_[at] & ~kLast, before = prev(corner);
      if (first == kNone) first = corner;
      step(corner, before);
      if (corner == fans_[at] && rest > 1) continue;
      end(first, twins_[before]);
      first = kNone;
    }
  }

  Index site_count_;
  std::vector<Index> own_sites_, own_twins_;  // empty: the mesh's
  std::span<const Index> sites_, twins_;      // per corner
  std::span<const ComponentCopy> copies_;
  std::vector<uint32_t> shapes_;  // per corner; empty: all triangles
  std::vector<Index> starts_;     // per site where its fans begin in `fans_`, and where all end
  std::vector<Index> fans_;       // site by site; empty: sites have one fan each, and `starts_` its first corner
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
