// Triangles that are shaped as the valences of their vertices let expect.

#include "codec/value_angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "codec/bytes.h"
#include "codec/values.h"
#include "tests/codec/vertex_sites.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using values::Shift;

constexpr uint32_t kLeast = values::kLeastValence, kLargest = values::kLargestValence;

Shift shiftOf(uint32_t a, uint32_t b, uint32_t x, uint32_t v) {
  return values::Shifts::of(a - kLeast, b - kLeast, x - kLeast, v - kLeast);
}

TEST(ValueAngles, EqualValencesMakeParallelograms) {
  for (uint32_t side = kLeast; side <= kLargest; ++side) {
    for (uint32_t third = kLeast; third <= kLargest; ++third) {
      const Shift shift = shiftOf(side, side, third, third);
      EXPECT_EQ(shift.a, 0);
      EXPECT_EQ(shift.b, 0);
    }
  }
}

TEST(ValueAngles, CornersOfManyTrianglesArePointed) {
  const Shift pointed = shiftOf(6, 6, 6, 8), blunt = shiftOf(6, 6, 6, 4);
  EXPECT_GT(pointed.a + pointed.b, 0) << "farther away than a + b - x";
  EXPECT_LT(blunt.a + blunt.b, 0);
}

/// The angle at the end of the side with fewer triangles is larger, so that what lies beyond is nearer to that end.
TEST(ValueAngles, SidesLean) {
  const Shift shift = shiftOf(4, 8, 6, 6);
  EXPECT_GT(shift.a, 0);
  EXPECT_LT(shift.b, 0);
}

/// Predictions stay far inside 32 bits, whatever the bytes say.
TEST(ValueAngles, ShiftsAreBounded) {
  const auto each = [](auto visit) {
    for (uint32_t v = kLeast; v <= kLargest; ++v) visit(v);
  };
  each([&](uint32_t a) {
    each([&](uint32_t b) {
      each([&](uint32_t x) {
        each([&](uint32_t v) {
          const Shift shift = shiftOf(a, b, x, v);
          EXPECT_LT((std::abs(int64_t{shift.a}) + std::abs(int64_t{shift.b})) << 20, int64_t{1} << 31);
        });
      });
    });
  });
}

std::vector<uint8_t> valencesOf(const shapes::Shape& shape) {
  const VertexSites sites(shape.mesh);
  std::vector<uint8_t> valences = values::siteValences(sites.graph);
  for (uint8_t& valence : valences) valence = static_cast<uint8_t>(valence + kLeast);
  std::ranges::sort(valences);
  return valences;
}

TEST(ValueAngles, ValencesOfSites) {
  EXPECT_EQ(valencesOf(shapes::icosahedron()), std::vector<uint8_t>(12, 5));
  EXPECT_EQ(valencesOf(shapes::triangleTorus(9, 7)), std::vector<uint8_t>(63, 6));
  // Where the surface ends, as if it went on at the other side.
  EXPECT_EQ(valencesOf(shapes::triangleGrid(1, 1)), (std::vector<uint8_t>{3, 3, 4, 4}));
  // Limits.
  EXPECT_EQ(valencesOf(shapes::fan(30, true)).back(), 10);
}

constexpr Index kSide = 40;

/// A grid of squares, each cut in one of the two ways.
Polygons randomlyCutGrid() {
  shapes::Random random(5);
  Polygons mesh;
  mesh.vertex_count = kSide * kSide;
  for (Index y = 0; y + 1 < kSide; ++y) {
    for (Index x = 0; x + 1 < kSide; ++x) {
      const Index a = y * kSide + x, b = a + 1, c = b + kSide, d = a + kSide;
      const bool turned = random.below(2) != 0;
      const auto faces = turned ? std::array{a, b, d, b, c, d} : std::array{a, b, c, a, c, d};
      mesh.corners.insert(mesh.corners.end(), faces.begin(), faces.end());
      mesh.face_degrees.insert(mesh.face_degrees.end(), 2, 3);
    }
  }
  return mesh;
}

/// Where each vertex lies: in the middle between its neighbours, but for those at the border of the square.
std::vector<std::array<int64_t, 2>> relaxed(const Polygons& mesh) {
  std::vector<std::array<int64_t, 2>> places;
  for (Index v = 0; v < mesh.vertex_count; ++v) places.push_back({v % kSide * 100'000, v / kSide * 100'000});
  for (int round = 0; round < 60; ++round) {
    std::vector<std::array<int64_t, 3>> sums(places.size());
    for (size_t c = 0; c < mesh.corners.size(); ++c) {
      const Index here = mesh.corners[c], next = mesh.corners[c % 3 == 2 ? c - 2 : c + 1];
      for (size_t i = 0; i < 2; ++i) sums[here][i] += places[next][i];
      ++sums[here][2];
    }
    for (Index v = 0; v < mesh.vertex_count; ++v) {
      const Index x = v % kSide, y = v / kSide;
      if (std::min(x, y) == 0 || std::max(x, y) == kSide - 1) continue;
      places[v] = {sums[v][0] / sums[v][2], sums[v][1] / sums[v][2]};
    }
  }
  return places;
}

TEST(ValueAngles, EvenMeshesTakeFewerBytes) {
  const Polygons mesh = randomlyCutGrid();
  const auto places = relaxed(mesh);
  const VertexSites sites(mesh);
  std::vector<int32_t> values;
  for (const Index v : sites.vertex_order) {
    for (const int64_t place : places[v]) values.push_back(static_cast<int32_t>(place / 1000));
    values.push_back(0);
  }
  const auto bytesOf = [&](ValueKind kind) {
    const ValueFormat format{3, 4095, ValueProfile::kDefault, kind};
    ByteWriter out;
    EXPECT_TRUE(encodeValues({sites.graph, {}}, format, values, out));
    const auto decoded = decodeValues({sites.graph, {}}, format, out.bytes());
    EXPECT_TRUE(decoded && *decoded == values);
    return out.bytes().size();
  };
  EXPECT_LT(bytesOf(ValueKind::kAngular), bytesOf(ValueKind::kPoints) * 9 / 10);
}

}  // namespace
}  // namespace tutte
