#pragma once
// The ways round the faces of a mesh, from corner to corner.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/triangulation.h"

namespace tutte {

/// The ways round the faces of a mesh that has nothing but triangles.
struct TriangleFaces {
  static constexpr bool kAllTriangles = true;

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
  static constexpr bool kAllTriangles = false;
  static constexpr uint32_t kMostDegree = 255;

  const uint32_t* shapes;

  Index degree(Index corner) const { return shapes[corner] & kMostDegree; }
  Index next(Index corner) const {
    return corner + static_cast<Index>(static_cast<int32_t>(shapes[corner] << 12) >> 20);
  }
  Index prev(Index corner) const { return corner + static_cast<Index>(static_cast<int32_t>(shapes[corner]) >> 20); }
};

inline constexpr Index kMostWays = 2048;  ///< corners of a face that there is a way round

/// The words of AnyFaces, for faces with `corner_count` corners in all. In larger faces than that, the first one's
/// predecessor and the last one's successor are these themselves. 4 bytes per corner.
inline std::vector<uint32_t> faceShapes(std::span<const Index> face_degrees, size_t corner_count) {
  constexpr auto shapeOf = [](Index back, Index forth, Index degree) {
    return back << 20 | (forth & 0xFFF) << 8 | std::min(degree, AnyFaces::kMostDegree);
  };
  constexpr std::array<uint32_t, 4> kQuad{shapeOf(3, 1, 4), shapeOf(~0u, 1, 4), shapeOf(~0u, 1, 4),
                                          shapeOf(~0u, ~2u, 4)};
  std::vector<uint32_t> shapes(corner_count);
  uint32_t* shape = shapes.data();
  for (const Index degree : face_degrees) {
    if (degree == 4) {
      shape = std::ranges::copy(kQuad, shape).out;
      continue;
    }
    if (degree == 0) continue;
    const Index wrap = degree <= kMostWays ? degree - 1 : 0;
    *shape++ = shapeOf(wrap, degree > 1, degree);
    for (Index i = 2; i < degree; ++i) *shape++ = shapeOf(~0u, 1, degree);
    if (degree > 1) *shape++ = shapeOf(~0u, 0u - wrap, degree);
  }
  return shapes;
}

/// The same, for faces of any size. 4 bytes per corner, where not all faces are triangles.
class FaceWays {
 public:
  explicit FaceWays(const Connectivity& mesh) {
    if (onlyTriangles(mesh.face_degrees)) return;
    shapes_ = faceShapes(mesh.face_degrees, mesh.umbrellas.size());
    Index first = 0;
    for (const Index degree : mesh.face_degrees) {
      if (degree > kMostWays) large_.push_back({first, first + degree - 1});
      first += degree;
    }
  }

  Index next(Index corner) const {
    if (!shapes_.data()) return TriangleFaces{}.next(corner);
    const Index next = AnyFaces{shapes_.data()}.next(corner);
    return next == corner ? acrossLarge(corner) : next;
  }

  Index prev(Index corner) const {
    if (!shapes_.data()) return TriangleFaces{}.prev(corner);
    const Index prev = AnyFaces{shapes_.data()}.prev(corner);
    return prev == corner ? acrossLarge(corner) : prev;
  }

  /// Per corner what AnyFaces needs; empty: all faces are triangles.
  std::span<const uint32_t> shapes() const { return shapes_; }
  bool hasLarge() const { return !large_.empty(); }

  /// At most 255.
  Index degree(Index corner) const { return !shapes_.data() ? 3 : AnyFaces{shapes_.data()}.degree(corner); }

 private:
  // From an end of a large face to the other.
  [[gnu::noinline]] Index acrossLarge(Index corner) const {
    const auto after = std::ranges::upper_bound(large_, corner, {}, &Ends::first);
    if (after == large_.begin()) return corner;
    const Ends& ends = after[-1];
    return corner == ends.first ? ends.last : corner == ends.last ? ends.first : corner;
  }

  struct Ends {
    Index first, last;
  };

  std::vector<uint32_t> shapes_;  // empty, and null: triangles
  std::vector<Ends> large_;
};

/// Per umbrella one of its corners: of one that forms a fan, that whose own edge is a boundary; of a cycle the lowest.
/// Umbrellas that have none of the corners given are left alone.
inline void findFirstCorners(std::span<const Index> twins, std::span<const Index> umbrellas,
                             std::vector<Index>& firsts) {
  Index open = 0;  // without decisions, so that compilers make vectors of it
  for (const Index twin : twins) open |= twin == kNone;
  for (Index c = static_cast<Index>(umbrellas.size()); c-- > 0;) firsts[umbrellas[c]] = c;
  for (Index c = 0; open != 0 && c < umbrellas.size(); ++c) {
    if (twins[c] == kNone) firsts[umbrellas[c]] = c;
  }
}

}  // namespace tutte
