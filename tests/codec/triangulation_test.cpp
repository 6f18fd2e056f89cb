// Triangles of polygons: any come back, usual ones cost nothing, damaged bytes stay within their polygon.

#include "codec/triangulation.h"

#include <gtest/gtest.h>

#include "tests/codec/overlays.h"

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;
using overlays::Style;

constexpr Style kStyles[] = {Style::kFirstFans, Style::kFans, Style::kTrees, Style::kParallel, Style::kLists};

Index triangleCount(const Triangulation& t) { return static_cast<Index>(t.corners.size() / 3); }

void expectRoundTrip(const Connectivity& mesh, const std::vector<Index>& owners, const Triangulation& triangles) {
  const auto bytes = encodeTriangulation(mesh, owners, triangles);
  ASSERT_TRUE(bytes.ok()) << describe(bytes.error());
  if (!*bytes) {
    const Triangulation fans = fanTriangulation({mesh.face_degrees, {}, 0}, owners);
    EXPECT_EQ(overlays::normalised(triangles), overlays::normalised(fans));
    return;
  }
  const Result<Triangulation> decoded = decodeTriangulation(mesh, owners, **bytes, triangleCount(triangles));
  ASSERT_TRUE(decoded.ok()) << describe(decoded.error());
  EXPECT_EQ(overlays::normalised(*decoded), overlays::normalised(triangles));
  if (triangleCount(triangles) == 0) return;
  EXPECT_EQ(decodeTriangulation(mesh, owners, **bytes, triangleCount(triangles) - 1).error(), Error::kLimitExceeded);
}

TEST(Triangulation, AnyTrianglesComeBack) {
  for (const overlays::Base& base : overlays::bases()) {
    SCOPED_TRACE(base.name);
    for (const Style style : kStyles) {
      expectRoundTrip(base.mesh, {}, overlays::triangles(base.mesh, {}, style, 3));
      const std::vector<Index> owners = overlays::randomRings(static_cast<Index>(base.mesh.face_degrees.size()), 4, 9);
      expectRoundTrip(base.mesh, owners, overlays::triangles(base.mesh, owners, style, 4));
    }
  }
}

TEST(Triangulation, FansFromTheFirstCornerAreNotStored) {
  for (const overlays::Base& base : overlays::bases()) {
    const auto bytes = encodeTriangulation(base.mesh, {}, overlays::triangles(base.mesh, {}, Style::kFirstFans, 0));
    ASSERT_TRUE(bytes.ok());
    EXPECT_FALSE(bytes->has_value()) << base.name;
  }
}

TEST(Triangulation, ParallelDiagonalsOfAGridCostNextToNothing) {
  const shapes::Shape grid = shapes::quadGrid(60, 60);
  const Encoded encoded = *encode(grid.mesh);
  Triangulation triangles;
  for (Index face = 0; face < 3600; ++face) {
    const Index first = 4 * face;
    Index start = 0;
    while (encoded.corner_order[first + start] % 4 != 0) ++start;
    const auto corner = [&](Index i) { return first + (start + i) % 4; };
    for (const Index c : {corner(0), corner(1), corner(2), corner(0), corner(2), corner(3)})
      triangles.corners.push_back(c);
    triangles.counts.push_back(2);
  }
  const auto bytes = encodeTriangulation(encoded.connectivity, {}, triangles);
  ASSERT_TRUE(bytes.ok());
  EXPECT_LE(bytes->value_or(Bytes{}).size(), 40u);
  expectRoundTrip(encoded.connectivity, {}, triangles);
}

TEST(Triangulation, RefusesTrianglesThatAreNotThePolygons) {
  const Connectivity mesh = encode(shapes::cube().mesh)->connectivity;
  Triangulation triangles = fanTriangulation({mesh.face_degrees, {}, 0}, {});
  triangles.corners[0] = 4;
  EXPECT_EQ(encodeTriangulation(mesh, {}, triangles).error(), Error::kIndexOutOfRange);
  triangles.corners.pop_back();
  EXPECT_EQ(encodeTriangulation(mesh, {}, triangles).error(), Error::kCountMismatch);
  triangles = fanTriangulation({mesh.face_degrees, {}, 0}, {});
  EXPECT_EQ(encodeTriangulation(mesh, std::vector<Index>{1, kNone, kNone, kNone, kNone, kNone}, triangles).error(),
            Error::kMalformed);
}

void expectHarmless(const Connectivity& mesh, const std::vector<Index>& owners, const Bytes& bytes, Index limit) {
  const Result<Triangulation> decoded = decodeTriangulation(mesh, owners, bytes, limit);
  if (!decoded) return;
  ASSERT_EQ(decoded->counts.size(), mesh.face_degrees.size());
  std::vector<Index> polygon_of;
  for (Index face = 0; face < mesh.face_degrees.size(); ++face) {
    polygon_of.insert(polygon_of.end(), mesh.face_degrees[face], owners[face] == kNone ? face : owners[face]);
  }
  size_t at = 0;
  for (Index face = 0; face < decoded->counts.size(); ++face) {
    for (Index i = 0; i < 3 * decoded->counts[face]; ++i) ASSERT_EQ(polygon_of.at(decoded->corners.at(at++)), face);
  }
  ASSERT_EQ(at, decoded->corners.size());
  ASSERT_LE(triangleCount(*decoded), limit);
}

TEST(Triangulation, DamagedBytesAreHarmless) {
  for (const overlays::Base& base : overlays::bases()) {
    if (base.mesh.umbrellas.size() > 200) continue;
    const std::vector<Index> owners = overlays::randomRings(static_cast<Index>(base.mesh.face_degrees.size()), 6, 2);
    for (const Style style : {Style::kFans, Style::kTrees, Style::kLists}) {
      const Triangulation triangles = overlays::triangles(base.mesh, owners, style, 8);
      const auto encoded = encodeTriangulation(base.mesh, owners, triangles);
      ASSERT_TRUE(encoded.ok());
      Bytes bytes = encoded->value_or(Bytes{});
      for (size_t size = 0; size < bytes.size(); ++size) {
        const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        expectHarmless(base.mesh, owners, cut, triangleCount(triangles));
      }
      for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
        expectHarmless(base.mesh, owners, bytes, triangleCount(triangles));
        bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
      }
    }
  }
}

}  // namespace
}  // namespace tutte
