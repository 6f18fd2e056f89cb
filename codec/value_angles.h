#pragma once
// The shapes of triangles, as the valences of their vertices let expect them: where meshes were made of triangles as
// even as they could be, the angles round a vertex are alike.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/made_table.h"
#include "codec/value_graph.h"

namespace tutte::values {

/// Valences are told apart from 3 to 10.
inline constexpr int kLeastValence = 3, kLargestValence = 10;

/// A triangle's shape as seen from one of its sides.
struct TriangleShape {
  int32_t foot;      ///< of the height: how far from the side's first end, in 1/4096 of the side
  int32_t flatness;  ///< side by height, in 1/65536; below 2^20
};

/// Of a triangle whose side goes from a vertex of valence l to one of valence r, the third vertex having valence o: its
/// angles are as 1 / l, 1 / r and 1 / o. Of a share x of the half turn, (1 - 2 x) / (x (1 - x)) stands for the
/// cotangent, which it is but for a factor and little more.
constexpr TriangleShape shapeOf(int64_t l, int64_t r, int64_t o) {
  const int64_t all = l * r + l * o + r * o;
  const auto cotangent = [&](int64_t share) { return (all - 2 * share) * all * 65536 / (share * (all - share)); };
  const int64_t first = cotangent(r * o), flatness = first + cotangent(l * o);
  return {static_cast<int32_t>(first * 4096 / flatness), static_cast<int32_t>(flatness)};
}

/// How the third corner of a triangle lies when it is predicted from the two others, a and b, and from x, the third
/// corner of the triangle beyond their side: at a + b - x, moved by these parts of a - x and b - x, in 1/256.
struct Shift {
  int16_t a, b;
};

/// Between two triangles with a side in common: the corner of `wanted` is predicted. Both below 2^10 in size.
constexpr Shift shiftBetween(const TriangleShape& known, const TriangleShape& wanted) {
  const auto heights = static_cast<int32_t>((int64_t{known.flatness} * 4096 + wanted.flatness / 2) / wanted.flatness);
  const int32_t along = heights * known.foot >> 12;
  return {static_cast<int16_t>((heights - along - wanted.foot) >> 4),
          static_cast<int16_t>((wanted.foot + along - 4096) >> 4)};
}

/// What the valences of all four corners let expect.
class Shifts {
 public:
  /// Valences less kLeastValence, up to kLargestValence; x and the predicted corner are `beyond` and `here`. No shift
  /// where a and b have equal valences, and the two others, too.
  static Shift of(uint32_t a, uint32_t b, uint32_t beyond, uint32_t here) {
    return kShifts[((a * kCount + b) * kCount + beyond) * kCount + here];
  }

 private:
  static constexpr size_t kCount = kLargestValence - kLeastValence + 1;

  static TUTTE_TABLE std::array<Shift, kCount* kCount* kCount* kCount> kShifts = madeTable([] {
    std::array<Shift, kCount * kCount * kCount * kCount> table{};
    Shift* shift = table.data();
    for (int l = kLeastValence; l <= kLargestValence; ++l) {
      for (int r = kLeastValence; r <= kLargestValence; ++r) {
        std::array<TriangleShape, kCount> shapes{};
        for (size_t o = 0; o < kCount; ++o) shapes[o] = shapeOf(l, r, static_cast<int>(o) + kLeastValence);
        for (const TriangleShape& known : shapes) {
          for (const TriangleShape& wanted : shapes) *shift++ = shiftBetween(known, wanted);
        }
      }
    }
    return table;
  });
};

/// The valence of each site, less kLeastValence: its corners, or twice as many where its first fan is open, within the
/// limits. O(corners).
inline std::vector<uint8_t> siteValences(const ValueGraph& graph) {
  std::vector<uint8_t> valences(graph.siteCount());
  graph.withFaces([&](const auto& faces) {
    for (Index corner = 0, count = graph.cornerCount(); corner < count; ++corner) {
      if (faces.degree(corner) < 3) continue;
      uint8_t& valence = valences[graph.site(corner)];
      valence = static_cast<uint8_t>(valence + (valence < kLargestValence));
    }
  });
  for (Index site = 0; site < graph.siteCount(); ++site) {
    const int ends = graph.isOpen(site) ? 2 : 1;
    const int valence = std::clamp(valences[site] * ends, kLeastValence, kLargestValence);
    valences[site] = static_cast<uint8_t>(valence - kLeastValence);
  }
  return valences;
}

}  // namespace tutte::values
