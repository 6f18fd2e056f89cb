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

  static constexpr int kCorners = static_cast<int>(ValueGraph::kMostCorners);

  /// The sites beside the one whose turn it is, fan by fan, and the face before each: between it and the side before.
  struct Sides {
    template <class T>
    using PerSide = std::array<T, 2 * kCorners>;

    PerSide<Index> site, rank;
    PerSide<Index> corner;    ///< of the face, at this side; kNone: a fan begins here
    PerSide<Index> far;       ///< the corner before that one
    PerSide<Index> far_rank;  ///< its site's; only among other faces than triangles
  };

  /// A fan of faces, which lie between sides. In all sets bit i is the side, or the face before the side, that comes i
  /// before the last.
  struct Fan {
    size_t last;
    int faces;
    bool closed;  ///< the last side is the first one, too
    uint64_t known = 0, far_known = 0, triangles = 0, quads = 0;

    size_t side(int bit) const { return last - static_cast<size_t>(bit); }
    uint64_t all() const { return (uint64_t{1} << faces) - 1; }
    /// Sides; in a closed fan without the last, whose part in a set wrapped() adds to the first's.
    uint64_t unknown() const { return ~known & ((uint64_t{2} << faces) - 1 - closed); }
    uint64_t wrapped(uint64_t set) const { return set | (set & closed) << faces; }
  };

  struct Lists {
    List<Index, 2 * kCorners> neighbours;
    List<Term, kCorners> within, across, planes;
    List<Term, 2 * kCorners> scaled;
    List<Term, 3 * kCorners> edges;
    List<Term, kMostFar> over, straight;
    Sides sides;
  };

  void fill();
  template <class Faces>
  void find(const Faces& faces, Index site, Surroundings& found);
  template <class Faces>
  size_t gather(const Faces& faces, Index site);
  template <class Faces>
  void beginFan(const Faces& faces, Index first, Index beyond, size_t begin, size_t last);
  template <class Faces>
  void visitFan(const Faces& faces, const Fan& fan);
  template <class Faces>
  void addAcross(const Faces& faces, size_t side);
  template <class Faces>
  bool visitPolygon(const Faces& faces, size_t side);
  void urgeSides(const Fan& fan);
  void urgeSides(const Fan& fan, uint64_t far_first);
  template <class Faces>
  void addEdges(const Faces& faces, size_t side);
  template <class Faces>
  void lookFar(const Faces& faces, size_t end);
  void lookFar(Index a, Index c, Index beyond_a, Index beyond_c, Index degree);
  void addEdge(Index from, Index from_rank, Index to, Index to_rank) {
    lists_->edges.add({from_rank, to_rank, from, to}, SiteOrder::isRank(from_rank | to_rank));
  }

  const ValueGraph& graph_;
  const bool want_edges_;
  SiteOrder order_;
  std::unique_ptr<Lists> lists_;
  std::array<Surroundings, kBatch> batch_;
  int at_ = 0, count_ = 0;
};

}  // namespace tutte::values
