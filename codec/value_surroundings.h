#pragma once
// What is known around each site when its turn comes. It depends on the graph alone, not on values, so it is found for
// many sites in advance, by one text for all kinds of values.

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "codec/value_graph.h"
#include "codec/value_order.h"

namespace tutte::values {

/// Known sites, by rank: how many were known before them.
struct Term {
  Index a, b, x, y;
};

/// The surroundings of a site.
struct Surroundings {
  Index site;
  std::span<const Index> neighbours;  ///< ranks
  std::span<const Term> scaled;       ///< predictions within large polygons: a + (b - x) * y / 4096
  std::span<const Term> within;       ///< in quads: a + b - (x + y) / 2, x and y being the same
  std::span<const Term> across;       ///< over edges of triangles: a + b - (x + y) / 2
  std::span<const Term> planes;       ///< of large polygons: a, b and x lie in them
  std::span<const Term> over;         ///< a + b - x; or, for y = 1, (3 a + b) / 2 - x
  std::span<const Term> straight;     ///< 2 a - x, b being a
  std::span<const Term> edges;        ///< from a to b, round faces of the site; x and y are these two as site numbers
};

/// Goes from site to site in the order of SiteOrder.
class SurroundingsFinder {
 public:
  /// Edges are listed only when they are wanted.
  SurroundingsFinder(const ValueGraph& graph, bool want_edges);

  /// The next site's; valid until the next call. There must be one.
  const Surroundings& next() {
    if (at_ == count_) fill();
    return batch_[at_++];
  }

  /// Per site: its rank, if that is below the number of calls so far, the last one not counted; else it is unknown.
  std::span<const Index> ranks() const { return order_.ranks(); }

 private:
  static constexpr int kBatch = 32;
  static constexpr int kMostFar = 8;

  template <class T, int kPerSite>
  struct List {
    std::array<T, kBatch * kPerSite + 1> items;
    T *begin, *end;

    void restart() { begin = end = items.data(); }
    /// Nothing is decided, since nobody could foresee it: the list grows by 0 or 1.
    void add(const T& item, bool really) {
      *end = item;
      end += really;
    }
    int size() const { return static_cast<int>(end - begin); }
    /// What was added since the last call.
    std::span<const T> take() {
      const std::span<const T> taken(begin, end);
      begin = end;
      return taken;
    }
  };

  /// A site beside the one whose turn it is, and how much more urgent it becomes.
  struct Side {
    Index site, rank, urgency;

    bool known() const { return SiteOrder::isRank(rank); }
  };

  static constexpr int kCorners = CornerList::kMost;
  struct Lists {
    List<Index, 2 * kCorners> neighbours;
    List<Term, kCorners> within, across, planes;
    List<Term, 2 * kCorners> scaled;
    List<Term, 3 * kCorners> edges;
    List<Term, kMostFar> over, straight;
  };

  void fill();
  template <class Faces>
  void find(const Faces& faces, Index site, Surroundings& found);
  template <class Faces>
  void visitFan(const Faces& faces, std::span<const Index> fan, bool closed);
  template <class Faces>
  void visitTriangle(const Faces& faces, Index corner, Side& a, Side& b);
  void visitQuad(const AnyFaces& faces, Index corner, Side& a, Side& b);
  void visitPolygon(const AnyFaces& faces, Index corner, Side& a, Side& b);
  template <class Faces>
  void addEdges(const Faces& faces, Index corner, Index a, Index b);
  void lookFar(const AnyFaces& faces, Index corner);
  void lookFar(Index a, Index c, Index beyond_a, Index beyond_c, Index degree);

  void addEdge(Index p, Index q) {
    const Index from = order_.rank(p), to = order_.rank(q);
    lists_->edges.add({from, to, p, q}, SiteOrder::isRank(from) & SiteOrder::isRank(to));
  }

  const ValueGraph& graph_;
  const bool want_edges_;
  SiteOrder order_;
  Urgencies urgencies_;
  std::unique_ptr<Lists> lists_;
  std::array<Surroundings, kBatch> batch_;
  int at_ = 0, count_ = 0;
};

}  // namespace tutte::values
