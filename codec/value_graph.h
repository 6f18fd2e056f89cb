#pragma once
// Where values sit on a mesh. Corners that share a value form a *site*: a vertex for positions; for an attribute with
// seams, the corners of a vertex between two seams.

#include <array>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// The sites of one attribute over a mesh, as predictors see them. 16 bytes per corner, and 4 for the way back.
class ValueGraph {
 public:
  /// `site_of` gives a number below `site_count` for every corner. O(corners).
  template <class SiteOf>
  ValueGraph(const Connectivity& mesh, Index site_count, SiteOf site_of) : site_count_(site_count) {
    addCorners(mesh);
    for (Index c = 0; c < corners_.size(); ++c) corners_[c].site = site_of(c);
    if (site_count != mesh.umbrella_count || !mesh.vertices.empty()) dropSeamTwins();
    addCornersOfSites();
  }

  Index siteCount() const { return site_count_; }
  Index cornerCount() const { return static_cast<Index>(corners_.size()); }

  Index site(Index corner) const { return corners_[corner].site; }
  /// As Connectivity::twins, but kNone where the far side has other sites.
  Index twin(Index corner) const { return corners_[corner].twin; }
  Index faceBegin(Index corner) const { return corners_[corner].begin; }
  Index faceEnd(Index corner) const { return corners_[corner].end; }
  Index degree(Index corner) const { return corners_[corner].end - corners_[corner].begin; }
  Index next(Index corner) const { return corner + 1 == corners_[corner].end ? corners_[corner].begin : corner + 1; }
  Index prev(Index corner) const { return corner == corners_[corner].begin ? corners_[corner].end - 1 : corner - 1; }

  /// All corners of a site but those of faces of degree below 3.
  std::span<const Index> cornersOf(Index site) const {
    return {around_.data() + first_[site], first_[site + 1] - first_[site]};
  }

 private:
  struct Corner {
    Index site, twin;
    Index begin, end;  // of the face
  };

  void addCorners(const Connectivity& mesh);
  void dropSeamTwins();
  void addCornersOfSites();

  Index site_count_;
  std::vector<Corner> corners_;
  std::vector<Index> first_;  // the corners of site s are around_[first_[s]] ... around_[first_[s + 1] - 1]
  std::vector<Index> around_;
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

/// The order in which values are coded: always one of the sites with the most known surroundings, so that most values
/// are predicted by several parallelograms. A function of the graph alone. O(corners) in all.
class SiteOrder {
 public:
  explicit SiteOrder(const ValueGraph& graph);

  /// The next site, which counts as known from now on. To be called once per site.
  Index next();

 private:
  static constexpr int kLevels = 6;

  bool isKnown(Index corner) const { return score_[graph_.site(corner)] == kKnown; }
  void reveal(Index corner);
  void revealPolygon(Index corner, Index known, Index degree);
  void add(Index corner, Index amount);
  void raise(Index corner, Index least);
  void setScore(Index site, Index score);
  Index pop();

  static constexpr Index kKnown = kNone;

  const ValueGraph& graph_;
  std::array<std::vector<Index>, kLevels> stacks_;  // by urgency
  int top_ = -1;                                    // no higher stack has anything
  Index seed_ = 0;
  std::vector<Index> score_;  // per site
  std::vector<Index> known_;  // per face, at its first corner: how many of its corners are known
};

/// The same order, which may be walked more than once; made as far as it is asked for.
class SiteSequence {
 public:
  explicit SiteSequence(const ValueGraph& graph) : order_(graph) { sites_.reserve(graph.siteCount()); }

  /// The i-th site, i below the number of sites; i rises by one from call to call, or goes back.
  Index operator[](size_t i) {
    if (i == sites_.size()) sites_.push_back(order_.next());
    return sites_[i];
  }

 private:
  SiteOrder order_;
  std::vector<Index> sites_;
};

}  // namespace tutte
