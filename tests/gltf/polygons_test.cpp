// Faces of primitives: triangle modes, fans, and polygons with holes.

#include "gltf_ext/polygons.h"

#include <gtest/gtest.h>

#include "tests/gltf/assets.h"

namespace tutte {
namespace {

using Indices = std::vector<Index>;

TEST(Triangles, StripsAlternate) {
  EXPECT_EQ(triangleList(kModeStrip, Indices{0, 1, 2, 3, 4}), (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
}

TEST(Triangles, StripsDropWhatJoinsThem) {
  EXPECT_EQ(triangleList(kModeStrip, Indices{0, 1, 2, 2, 3, 3, 4, 5}), (Indices{0, 1, 2, 3, 5, 4}));
}

TEST(Triangles, Fans) { EXPECT_EQ(triangleList(kModeFan, Indices{0, 1, 2, 3}), (Indices{0, 1, 2, 0, 2, 3})); }

TEST(Triangles, ListsKeepDegenerateOnesAndIgnoreTheRest) {
  EXPECT_EQ(triangleList(kModeTriangles, Indices{0, 0, 1, 2, 3, 4, 5}), (Indices{0, 0, 1, 2, 3, 4}));
  EXPECT_TRUE(triangleList(kModeStrip, Indices{0, 1}).empty());
}

TEST(Fans, BecomePolygons) {
  const PrimitiveFaces faces = facesOfFans(Indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 0, 3, 7});
  EXPECT_EQ(faces.degrees, (Indices{4, 3, 3}));
  EXPECT_EQ(faces.corners, (Indices{0, 1, 2, 3, 4, 5, 6, 0, 3, 7}));
  EXPECT_EQ(faces.triangulation.counts, (Indices{2, 1, 1}));
  EXPECT_EQ(faces.triangulation.corners, (Indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(Fans, WithTheSameApexButNoCommonEdgeAreTwoPolygons) {
  EXPECT_EQ(facesOfFans(Indices{0, 1, 2, 0, 3, 4}).degrees, (Indices{3, 3}));
}

TEST(Polygons, WithHoles) {
  const Asset asset = holeAsset();
  const auto faces = readFaces(asset, asset.json["meshes"][0]["primitives"][0], 10, false, "");
  ASSERT_TRUE(faces) << why(faces);
  EXPECT_EQ(faces->degrees, (Indices{4, 4, 4}));
  EXPECT_EQ(faces->ring_owners, (Indices{kNone, 0, kNone}));
  EXPECT_EQ(faces->triangulation.counts, (Indices{8, 0, 2}));
}

TEST(Polygons, SeparatorsBetweenPolygonsMayLackOrEndTheArray) {
  const Indices triangles = {0, 1, 2, 1, 3, 2};
  for (const PolygonArrays& arrays : {PolygonArrays{{0, 3}, {0, 1, 2, 1, 3, 2}, {0, 3}},
                                      PolygonArrays{{0, 3}, {0, 1, 2, kNone, 1, 3, 2, kNone}, {0, 4}}}) {
    const auto faces = facesOfPolygons(triangles, arrays, "");
    ASSERT_TRUE(faces) << why(faces);
    EXPECT_EQ(faces->degrees, (Indices{3, 3}));
  }
}

TEST(Polygons, WrongArraysAreRefused) {
  const Indices triangles = {0, 1, 2, 1, 3, 2};
  const Indices loops = {0, 1, 2, kNone, 1, 3, 2};
  ASSERT_TRUE(facesOfPolygons(triangles, {{0, 3}, loops, {0, 4}}, ""));
  const PolygonArrays wrong[] = {
      {{}, {}, {}},                                 // no polygon
      {{0, 3}, loops, {0}},                         // lengths differ
      {{3, 3}, loops, {0, 4}},                      // does not begin at 0
      {{0, 3}, loops, {1, 4}},                      //
      {{0, 2}, loops, {0, 4}},                      // not at a triangle
      {{0, 9}, loops, {0, 4}},                      // behind the end
      {{0, 3}, loops, {0, 99}},                     //
      {{0, 3}, loops, {0, 0xFFFFFFFF}},             //
      {{0, 3, 3}, loops, {0, 4, 7}},                // a polygon without a ring
      {{0, 6, 3}, loops, {0, 4, 5}},                // offsets fall
      {{0, 3}, {0, 1, 2, kNone, 1, 3, 4}, {0, 4}},  // a triangle uses another vertex
      {{0, 0}, loops, {0, 4}},                      // all triangles belong to the second
  };
  for (const PolygonArrays& arrays : wrong) {
    const auto faces = facesOfPolygons(triangles, arrays, "/here");
    ASSERT_FALSE(faces);
    EXPECT_EQ(faces.error().where.find("/here"), 0u);
  }
}

TEST(Polygons, ManySmallOnesAfterALargeOneTakeNoLonger) {
  Indices loops, loop_offsets = {0}, index_offsets = {0}, triangles;
  const Index large = 200'000;
  for (Index i = 0; i < large; ++i) loops.push_back(i);
  for (Index i = 1; i + 1 < large; ++i) triangles.insert(triangles.end(), {0, i, i + 1});
  for (Index i = 0; i < 100'000; ++i) {
    loop_offsets.push_back(static_cast<Index>(loops.size()));
    index_offsets.push_back(static_cast<Index>(triangles.size()));
    for (Index k = 0; k < 3; ++k) loops.push_back(i + k);
    for (Index k = 0; k < 3; ++k) triangles.push_back(i + k);
  }
  const auto faces = facesOfPolygons(triangles, {index_offsets, loops, loop_offsets}, "");
  ASSERT_TRUE(faces) << why(faces);
  EXPECT_EQ(faces->degrees.size(), 100'001u);
}

TEST(Faces, IndicesOutOfRangeAreRefused) {
  Asset asset = triangleAsset(shapes::cube());
  const Json& primitive = asset.json["meshes"][0]["primitives"][0];
  EXPECT_TRUE(readFaces(asset, primitive, 8, false, ""));
  const auto faces = readFaces(asset, primitive, 7, false, "/p");
  ASSERT_FALSE(faces);
  EXPECT_EQ(faces.error().where, "/p/indices");
}

TEST(Faces, WithoutIndices) {
  Asset asset = emptyAsset();
  const auto faces = readFaces(asset, Json::object(), 7, false, "");
  ASSERT_TRUE(faces);
  EXPECT_EQ(faces->degrees, (Indices{3, 3}));
}

TEST(Faces, UnmarkedFans) {
  Asset asset = fanAsset(shapes::cube());
  EXPECT_FALSE(usesUnmarkedFans(asset.json));
  asset.json["meshes"][0]["primitives"][0].erase("extensions");
  EXPECT_TRUE(usesUnmarkedFans(asset.json));
  const auto faces = readFaces(asset, asset.json["meshes"][0]["primitives"][0], 8, true, "");
  ASSERT_TRUE(faces);
  EXPECT_EQ(faces->degrees, Indices(6, 4));
}

}  // namespace
}  // namespace tutte
