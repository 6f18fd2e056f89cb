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

/// The surroundings of a site; all sites in them are known. The lists of a batch of sites lie one after the other.
class Surroundings {
 public:
  /// Where a site's lists begin, which is where those of the site before it end.
  struct Begins {
    Index* neighbours;
    Term *scaled, *within, *across, *planes, *over, *straight;
    Edge* edges;
  };

  Surroundings(Index site, const Begins* begins) : site_(site), begins_(begins) {}

  Index site() const { return site_; }
  std::span<const Index> neighbours() const { return list(&Begins::neighbours); }
  /// Predictions within large polygons: a + (b - x) * y / 4096.
  std::span<const Term> scaled() const { return list(&Begins::scaled); }
  /// In quads: a + b - x.
  std::span<const Term> within() const { return list(&Begins::within); }
  /// Over edges of triangles: a + b - (x + y) / 2.
  std::span<const Term> across() const { return list(&Begins::across); }
  /// Of large polygons: a, b and x lie in them.
  std::span<const Term> planes() const { return list(&Begins::planes); }
  /// Over edges of other faces: a + b - x.
  std::span<const Term> over() const { return list(&Begins::over); }
  /// a + b - x, b being a; only where there are not two others of those from `scaled` on.
  std::span<const Term> straight() const { return list(&Begins::straight); }
  /// Round faces of the site, four at most.
  std::span<const Edge> edges() const { return list(&Begins::edges); }

 private:
  template <class T>
  std::span<const T> list(T* Begins::*begin) const {
    return {begins_[0].*begin, begins_[1].*begin};
  }

  Index site_;
  const Begins* begins_;
};

/// Goes from site to site. The walk over the mesh has numbered its vertices as it met them, so that mostly a site's
/// surroundings have lower numbers on one side: their numbers are the order in which sites become known.
class SurroundingsFinder {
 public:
  /// Which lists are wanted, besides the neighbours.
  struct Wanted {
    bool edges = false;
    bool predictions = true;  ///< all others
    bool beside = false;      ///< what is far lies only beside faces that have one known side
    bool far = true;  ///< those from beyond the faces of a site, not just where it has no parallelogram, but also
                      ///< where it has one
  };

  SurroundingsFinder(const ValueGraph& graph, const Wanted& wanted);

  /// The next site's, from 0 on; valid until the next call. There must be one. Known are the sites before it.
  Surroundings next() {
    if (at_ == count_) fill();
    const Index site = site_ - static_cast<Index>(count_ - at_);
    return {site, &begins_[at_++]};
  }

 private:
  static constexpr int kMostFar = 4, kMostEdges = 4;
  static constexpr size_t kBatch = 16;         // sites
  static constexpr size_t kBatchCorners = 64;  // their corners, but for those of the last one
  static constexpr size_t kCorners = ValueGraph::kMostCorners;

  template <class T, size_t kPerCorner>
  using List = std::array<T, (kBatchCorners + kCorners) * kPerCorner + 1>;

  /// The sites beside the one whose turn it is, fan by fan, and the face before each: between it and the side before.
  struct Sides {
    std::array<Index, 2 * kCorners> site;
    std::array<Index, 2 * kCorners> corner;  ///< of the face, at this side; kNone: a fan begins here
  };

  /// A fan of faces, which lie between sides. In sets bit i is the side, or the face before the side, that comes i
  /// before the last.
  struct Fan {
    size_t last;
    size_t faces;
    uint64_t known;  ///< sides

    size_t side(int bit) const { return last - static_cast<size_t>(bit); }
    uint64_t all() const { return (uint64_t{1} << faces) - 1; }
    /// Faces both of whose sides are known, or one.
    uint64_t both() const { return known & known >> 1; }
    uint64_t either() const { return (known | known >> 1) & all(); }
    /// Just one of whose sides is known.
    uint64_t one() const { return (known ^ known >> 1) & all(); }
  };

  struct Lists {
    List<Index, 2> neighbours;
    List<Term, 1> within, across, planes;
    List<Term, 2> scaled, over, straight;
    List<Edge, 3> edges;
    Sides sides;
    std::array<Fan, kCorners> fans;
  };

  void fill();
  template <class Faces>
  size_t find(const Faces& faces);
  template <class Faces>
  size_t gather(const Faces& faces, size_t& fans);
  template <class Faces>
  void beginFan(const Faces& faces, Index first, Index beyond, size_t begin, size_t last);
  template <class Faces>
  void visitFan(const Faces& faces, const Fan& fan, bool quads);
  template <class Faces>
  void addAcross(const Faces& faces, size_t side);
  template <class Faces>
  void addWithin(const Faces& faces, size_t side);
  template <class Faces>
  void visitLarge(const Faces& faces, size_t side);
  template <class Faces>
  void addEdges(const Faces& faces, size_t side);
  template <class Faces>
  void lookOver(const Faces& faces, std::span<const Fan> fans);
  template <class Faces>
  void lookStraight(const Faces& faces, std::span<const Fan> fans);
  template <class Faces>
  void addStraight(const Faces& faces, Index a, Index beyond);
  void addEdge(Index from, Index to) { add(ends_.edges, {from, to}, known(from) & known(to)); }

  /// Nothing is decided, since nobody could foresee it: the list grows by 0 or 1.
  template <class T>
  static void add(T*& end, const T& item, bool really) {
    *end = item;
    end += really;
  }

  bool known(Index site) const { return site < site_; }

  const ValueGraph& graph_;
  const Wanted wanted_;
  Index site_ = 0;  // whose turn it is
  std::unique_ptr<Lists> lists_;
  Surroundings::Begins ends_;
  std::array<Surroundings::Begins, kBatch + 1> begins_;
  size_t at_ = 0, count_ = 0;
};

}  // namespace tutte::values
