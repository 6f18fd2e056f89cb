#pragma once
// What is known around each site when its turn comes. It depends on the graph alone, not on values, so it is found for
// many sites in advance, by one text for all kinds of values.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "codec/value_graph.h"

namespace tutte::values {

/// Known sites.
struct Term {
  Index a, b, x, y;
};

struct Edge {
  Index from, to;
};

/// The surroundings of a site; all sites in them are known.
struct Surroundings {
  Index site;
  std::span<const Index> neighbours;
  std::span<const Term> scaled;  ///< predictions within large polygons: a + (b - x) * y / 4096
  std::span<const Term> within;  ///< in quads: a + b - (x + y) / 2, x and y being the same
  std::span<const Term> across;  ///< over edges of triangles: a + b - (x + y) / 2
  std::span<const Term> planes;  ///< of large polygons: a, b and x lie in them
  std::span<const Term> over;    ///< a + b - x; or, for y = 1, (3 a + b) / 2 - x
  std::span<const Term>
      straight;                 ///< 2 a - x, b being a; only where there are not two others of those from `scaled` on
  std::span<const Edge> edges;  ///< round faces of the site
};

/// Goes from site to site. The walk over the mesh has numbered its vertices as it met them, so that mostly a site's
/// surroundings have lower numbers on one side: their numbers are the order in which sites become known.
class SurroundingsFinder {
 public:
  /// Edges are listed only when they are wanted. Predictions from beyond the faces of a site are where it has no
  /// parallelogram, and with `far`, where it has one.
  SurroundingsFinder(const ValueGraph& graph, bool want_edges, bool far);

  /// The next site's, from 0 on; valid until the next call. There must be one. Known are the sites before it.
  const Surroundings& next() {
    if (at_ == count_) fill();
    return batch_[at_++];
  }

 private:
  static constexpr int kMostFar = 8;
  static constexpr size_t kBatch = 32;          // sites
  static constexpr size_t kBatchCorners = 192;  // their corners, but for those of the last one
  static constexpr size_t kCorners = ValueGraph::kMostCorners;

  template <class T, size_t kPerCorner>
  struct List {
    std::array<T, (kBatchCorners + kCorners) * kPerCorner + 1> items;
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

  /// The sites beside the one whose turn it is, fan by fan, and the face before each: between it and the side before.
  struct Sides {
    std::array<Index, 2 * kCorners> site;
    std::array<Index, 2 * kCorners> corner;  ///< of the face, at this side; kNone: a fan begins here
  };

  /// A fan of faces, which lie between sides. In all sets bit i is the side, or the face before the side, that comes i
  /// before the last.
  struct Fan {
    size_t last;
    size_t faces;
    uint64_t known;
    uint64_t large;  ///< faces of more than four corners

    size_t side(int bit) const { return last - static_cast<size_t>(bit); }
    uint64_t all() const { return (uint64_t{1} << faces) - 1; }
  };

  struct Lists {
    List<Index, 2> neighbours;
    List<Term, 1> within, across, planes;
    List<Term, 2> scaled, over, straight;
    List<Edge, 3> edges;
    Sides sides;
  };

  void fill();
  template <class Faces>
  size_t find(const Faces& faces, Surroundings& found);
  template <class Faces>
  size_t gather(const Faces& faces);
  template <class Faces>
  void beginFan(const Faces& faces, Index first, Index beyond, size_t begin, size_t last);
  template <class Faces>
  void visitFan(const Faces& faces, const Fan& fan);
  template <class Faces>
  void addAcross(const Faces& faces, size_t side);
  template <class Faces>
  void addWithin(const Faces& faces, size_t side);
  template <class Faces>
  void visitLarge(const Faces& faces, size_t side);
  template <class Faces>
  void addEdges(const Faces& faces, size_t side);
  template <class Faces>
  void lookOver(const Faces& faces, size_t end);
  template <class Faces>
  void lookStraight(const Faces& faces, size_t end);
  template <class Faces>
  void addStraight(const Faces& faces, Index a, Index beyond);
  void addEdge(Index from, Index to) { lists_->edges.add({from, to}, known(from) & known(to)); }

  bool known(Index site) const { return site < site_; }

  const ValueGraph& graph_;
  const bool want_edges_, far_;
  Index site_ = 0;  // whose turn it is
  std::unique_ptr<Lists> lists_;
  std::array<Surroundings, kBatch> batch_;
  size_t at_ = 0, count_ = 0;
};

}  // namespace tutte::values
