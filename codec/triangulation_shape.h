#pragma once
// What kinds of triangulation a polygon can have, seen from the coder.

#include <algorithm>
#include <array>
#include <vector>

#include "codec/polygon_table.h"

namespace tutte {

using Triangle = std::array<Index, 3>;  ///< local corners

/// How the triangles of one polygon are told.
enum class Kind : uint8_t {
  kFan,   ///< all triangles start at one corner
  kTree,  ///< a triangulation by diagonals that do not cross
  kList,  ///< any triangles
};

struct Shape {
  Kind kind = Kind::kFan;
  Index apex = 0;                   ///< of a fan
  std::vector<Triangle> triangles;  ///< tree: smallest corner first, in the order of the tree; list: as given
};

/// Visits the intervals of a triangulation by diagonals: [0, degree - 1] first; `apexOf(i, j)` names the third corner
/// of the triangle on the side i-j, or kNone to stop. Then the part before the apex, then the part after it.
template <class ApexOf>
bool walkTree(Index degree, std::vector<std::array<Index, 2>>& stack, ApexOf&& apexOf) {
  stack.assign(1, {0, degree - 1});
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const Index apex = apexOf(i, j);
    if (apex == kNone) return false;
    if (j - apex > 1) stack.push_back({apex, j});
    if (apex - i > 1) stack.push_back({i, apex});
  }
  return true;
}

/// Finds out, per polygon, what kind of triangulation was given.
class ShapeFinder {
 public:
  explicit ShapeFinder(Shape& shape) : shape_(shape) {}

  void classify(const Polygon& polygon) {
    shape_.kind = Kind::kList;
    const Index degree = polygon.exterior.degree;
    if (!polygon.holes.empty() || degree < 3 || shape_.triangles.size() != degree - 2) return;
    sorted_ = shape_.triangles;
    for (Triangle& t : sorted_) std::ranges::rotate(t, std::ranges::min_element(t));
    // Smallest corner first, larger spans first: that is the order in which the tree is walked. By a heap, which takes
    // the least code; a tree has no two triangles with the same span.
    const auto before = [](const Triangle& a, const Triangle& b) { return a[0] != b[0] ? a[0] < b[0] : a[2] > b[2]; };
    std::ranges::make_heap(sorted_, before);
    std::ranges::sort_heap(sorted_, before);
    if (!isTree(degree)) return;
    shape_.apex = fanApex(degree);
    shape_.kind = shape_.apex == kNone ? Kind::kTree : Kind::kFan;
    shape_.triangles.swap(sorted_);
  }

 private:
  bool isTree(Index degree) {
    size_t next = 0;
    return walkTree(degree, stack_, [&](Index i, Index j) {
      const Triangle& t = sorted_[next++];
      return t[0] == i && t[2] == j && t[1] > i && t[1] < j ? t[1] : kNone;
    });
  }

  /// The first corner that all triangles share.
  Index fanApex(Index degree) {
    uses_.assign(degree, 0);
    for (const Triangle& t : sorted_) {
      for (const Index corner : t) ++uses_[corner];
    }
    const auto apex = std::ranges::find(uses_, degree - 2);
    return apex == uses_.end() ? kNone : static_cast<Index>(apex - uses_.begin());
  }

  Shape& shape_;
  std::vector<Triangle> sorted_;
  std::vector<std::array<Index, 2>> stack_;
  std::vector<Index> uses_;
};

}  // namespace tutte
