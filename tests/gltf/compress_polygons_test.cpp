// Triangles, fans and polygons of all shapes, compressed and back, and in which notation polygons come back.

#include <gtest/gtest.h>

#include "gltf_ext/compress.h"
#include "gltf_ext/extension.h"
#include "tests/gltf/assets.h"
#include "tests/gltf/compress_trip.h"

namespace tutte {
namespace {

TEST(Compress, TrianglesOfAllShapes) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    const Asset asset = triangleAsset(shape);
    if (fanIndices(shape.mesh).empty() || shape.mesh.vertex_count > 60000) continue;
    roundTrip(asset);
  }
}

TEST(Compress, FansOfAllShapes) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    if (fanIndices(shape.mesh).empty() || shape.mesh.vertex_count > 60000) continue;
    roundTrip(fanAsset(shape));
  }
}

TEST(Compress, PolygonsOfAllShapes) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    if (fanIndices(shape.mesh).empty() || shape.mesh.vertex_count > 60000) continue;
    CompressOptions options = lossless();
    options.polygons = PolygonOutput::kBoth;
    roundTrip(polygonAsset(shape), options);
  }
}

TEST(Compress, PolygonsWithHoles) {
  Asset compressed = roundTrip(holeAsset());
  EXPECT_EQ(primitiveOf(compressed)["extensions"]["EXT_mesh_polygon"]["count"], 2);
  CompressOptions options = lossless();
  options.polygons = PolygonOutput::kFb;
  compressed = roundTrip(holeAsset(), options);
  EXPECT_FALSE(extensionOf(primitiveOf(compressed), "FB_ngon_encoding")) << "holes cannot be fans";
  EXPECT_TRUE(extensionOf(primitiveOf(compressed), "EXT_mesh_polygon"));
}

TEST(Compress, PolygonNotationIsChosen) {
  CompressOptions options = lossless();
  options.polygons = PolygonOutput::kExt;
  Asset compressed = roundTrip(fanAsset(shapes::dodecahedron()), options);
  EXPECT_FALSE(extensionOf(primitiveOf(compressed), "FB_ngon_encoding"));
  EXPECT_TRUE(extensionOf(primitiveOf(compressed), "EXT_mesh_polygon"));
  EXPECT_FALSE(listsExtension(compressed.json, "extensionsUsed", "FB_ngon_encoding"));
  options.polygons = PolygonOutput::kFb;
  compressed = roundTrip(polygonAsset(shapes::cube()), options);
  EXPECT_TRUE(extensionOf(primitiveOf(compressed), "FB_ngon_encoding"));
  EXPECT_FALSE(listsExtension(compressed.json, "extensionsUsed", "EXT_mesh_polygon"));
}

TEST(Compress, UnmarkedFansGetTheirMark) {
  Asset asset = fanAsset(shapes::cube());
  primitiveOf(asset).erase("extensions");
  Asset compressed = roundTrip(asset);
  EXPECT_TRUE(extensionOf(primitiveOf(compressed), "FB_ngon_encoding"));
}

}  // namespace
}  // namespace tutte
