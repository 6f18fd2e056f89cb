// Plain to compressed and back: what must survive, what must go, and what must be left alone.

#include "gltf_ext/compress.h"

#include <gtest/gtest.h>

#include "gltf_ext/accessors.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/polygons.h"
#include "tests/gltf/assets.h"
#include "tests/gltf/compress_trip.h"

namespace tutte {
namespace {

TEST(Compress, SharedVerticesBecomeOnePayload) {
  Asset asset = triangleAsset(shapes::quadGrid(6, 6));
  const std::vector<Index> all = fanIndices(shapes::quadGrid(6, 6).mesh);
  const std::vector<Index> front(all.begin(), all.begin() + 60), back(all.begin() + 60, all.end());
  const Json attributes = primitiveOf(asset)["attributes"];
  asset.json["materials"] = Json::array({{{"name", "a"}}, {{"name", "b"}}});
  asset.json["meshes"][0]["primitives"] =
      Json::array({{{"attributes", attributes}, {"indices", addShorts(asset, front)}, {"material", 0}},
                   {{"attributes", attributes}, {"indices", addShorts(asset, back)}, {"material", 1}}});
  addMesh(asset, {{"attributes", attributes}, {"indices", addShorts(asset, {0, 1, 2})}});
  Asset compressed = roundTrip(asset);
  EXPECT_EQ(primitiveOf(compressed)["attributes"], primitiveOf(compressed, 1)["attributes"]);
  EXPECT_EQ(primitiveOf(compressed, 0, 1)["material"], 1);
}

TEST(Compress, TheSameIndicesAreOneGroup) {
  Asset asset = triangleAsset(shapes::cube());
  asset.json["materials"] = Json::array({{{"name", "a"}}});
  Json again = primitiveOf(asset);
  again["material"] = 0;
  addMesh(asset, again);
  const Asset compressed = roundTrip(asset);
  EXPECT_EQ(compressed.json["bufferViews"].size(), 2u);
}

TEST(Compress, AccessorsThatOthersUseStayReadable) {
  Asset asset = triangleAsset(shapes::cube());
  const uint64_t positions = primitiveOf(asset)["attributes"]["POSITION"].get<uint64_t>();
  addMesh(asset, {{"attributes", {{"POSITION", positions}}}, {"mode", 0}});
  const auto before = readAccessor(asset, positions);
  Asset compressed = roundTrip(asset);
  const auto after = readAccessor(compressed, primitiveOf(compressed, 1)["attributes"]["POSITION"].get<uint64_t>());
  ASSERT_TRUE(after) << why(after);
  EXPECT_EQ(*before, *after);
}

TEST(Compress, OldBytesAreGone) {
  const shapes::Shape shape = shapes::quadTorus(40, 40);
  const Asset asset = triangleAsset(shape);
  const auto compressed = compress(asset);
  ASSERT_TRUE(compressed) << why(compressed);
  EXPECT_LT(compressed->asset.buffers[0].size(), 8000u);
  EXPECT_EQ(compressed->asset.json["accessors"].size(), asset.json["accessors"].size());
  EXPECT_EQ(compressed->asset.json["bufferViews"].size(), asset.json["bufferViews"].size());
}

TEST(Compress, UnusedVerticesStay) {
  Asset asset = triangleAsset(shapes::cube());
  primitiveOf(asset)["indices"] = addShorts(asset, {7, 3, 5});
  Asset compressed = roundTrip(asset);
  EXPECT_EQ(compressed.json["accessors"][primitiveOf(compressed)["attributes"]["POSITION"].get<size_t>()]["count"], 8);
}

/// A cube with one wedge per corner: 24 glTF vertices at 8 places.
Asset facetedCube() {
  const shapes::Shape cube = shapes::cube();
  Asset asset = emptyAsset();
  std::vector<float> positions, normals, texcoords, colors;
  std::vector<Index> indices;
  for (Index face = 0; face < 6; ++face) {
    for (Index k = 0; k < 4; ++k) {
      for (const float value : cube.positions[cube.mesh.corners[4 * face + k]]) positions.push_back(value);
      for (Index axis = 0; axis < 3; ++axis) normals.push_back(axis == face / 2 ? (face % 2 ? 1.f : -1.f) : 0.f);
      texcoords.insert(texcoords.end(), {k % 2 ? 1.f : 0.f, k / 2 ? 1.f : 0.f});
      colors.insert(colors.end(), {0.1f * static_cast<float>(face), 0.5f, 1.f, 1.f});
    }
    for (const Index k : {0, 1, 2, 0, 2, 3}) indices.push_back(4 * face + k);
  }
  const Json attributes = {{"POSITION", addFloats(asset, positions, 3)},
                           {"NORMAL", addFloats(asset, normals, 3)},
                           {"TEXCOORD_0", addFloats(asset, texcoords, 2)},
                           {"COLOR_0", addFloats(asset, colors, 4)}};
  addMesh(asset, {{"attributes", attributes}, {"indices", addShorts(asset, indices)}});
  return asset;
}

TEST(Compress, SeamsAreNotCuts) {
  auto compressed = compress(facetedCube(), lossless());
  ASSERT_TRUE(compressed) << why(compressed);
  ASSERT_EQ(compressed->report.payloads.size(), 1u);
  EXPECT_EQ(compressed->report.payloads[0].vertices, 8u);
  EXPECT_EQ(compressed->report.payloads[0].wedges, 24u);
  roundTrip(facetedCube());
}

TEST(Compress, AttributesCanBeLeftOut) {
  CompressOptions options = lossless();
  options.attributes = {"NORMAL"};
  const auto compressed = compress(facetedCube(), options);
  ASSERT_TRUE(compressed) << why(compressed);
  const Json& attributes = compressed->asset.json["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(attributes.size(), 2u);
  EXPECT_TRUE(attributes.contains("NORMAL"));
  EXPECT_EQ(compressed->asset.json["accessors"].size(), 3u);
}

TEST(Compress, MorphTargetsAreAttributes) {
  Asset asset = facetedCube();
  const auto deltas = [&](float scale) {
    std::vector<float> values(72);
    for (size_t i = 0; i < values.size(); ++i) values[i] = scale * static_cast<float>(i % 5);
    return addFloats(asset, values, 3);
  };
  const uint64_t first = deltas(0.5f), second = deltas(0.25f);
  primitiveOf(asset)["targets"] = Json::array({{{"POSITION", first}, {"NORMAL", second}}, {{"POSITION", second}}});
  asset.json["meshes"][0]["weights"] = {0.5, 0.25};
  Asset compressed = roundTrip(asset);
  const Json& targets = primitiveOf(compressed)["targets"];
  EXPECT_EQ(targets[0]["NORMAL"], targets[1]["POSITION"]) << "a shared accessor is stored once";
  EXPECT_EQ(compressed.json["meshes"][0]["weights"], asset.json["meshes"][0]["weights"]);
}

TEST(Compress, SparseAccessorsBecomeDense) {
  Asset asset = triangleAsset(shapes::cube());
  const uint64_t places = addShorts(asset, {1, 6}), values = addFloats(asset, {9, 8, 7, 6, 5, 4}, 3);
  const uint64_t positions = primitiveOf(asset)["attributes"]["POSITION"].get<uint64_t>();
  Json& accessor = asset.json["accessors"][positions];
  accessor["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", asset.json["accessors"][places]["bufferView"]}, {"componentType", 5123}}},
      {"values", {{"bufferView", asset.json["accessors"][values]["bufferView"]}}}};
  accessor["max"] = {9, 8, 7};
  Asset compressed = roundTrip(asset);
  const Json& found = compressed.json["accessors"][primitiveOf(compressed)["attributes"]["POSITION"].get<size_t>()];
  EXPECT_FALSE(found.contains("sparse"));
  EXPECT_EQ(found["max"], Json({9.0, 8.0, 7.0}));
}

TEST(Compress, StripsFansAndUnindexedBecomeTriangles) {
  for (const uint64_t mode : {kModeStrip, kModeFan}) {
    Asset asset = triangleAsset(shapes::disc(12));
    primitiveOf(asset)["mode"] = mode;
    primitiveOf(asset)["indices"] = addShorts(asset, {0, 1, 2, 3, 3, 4, 5, 6});
    Asset compressed = roundTrip(asset);
    EXPECT_FALSE(primitiveOf(compressed).contains("mode"));
    primitiveOf(asset).erase("indices");
    roundTrip(asset);
  }
}

TEST(Compress, NarrowAttributesArePaddedAndExact) {
  Asset asset = triangleAsset(shapes::cube());
  Bytes colors(8 * 4), ids(8 * 4);
  for (size_t i = 0; i < 8; ++i) {
    for (size_t k = 0; k < 3; ++k) colors[4 * i + k] = static_cast<uint8_t>(37 * i + k);
    ids[4 * i] = static_cast<uint8_t>(i);
  }
  const uint64_t color = addRawAccessor(asset, colors, ComponentType::kUint8, "VEC3", 8, {{"byteStride", 4}});
  asset.json["accessors"][color]["normalized"] = true;
  asset.json["accessors"][color]["name"] = "paint";
  primitiveOf(asset)["attributes"]["COLOR_0"] = color;
  primitiveOf(asset)["attributes"]["_ID"] =
      addRawAccessor(asset, ids, ComponentType::kUint16, "SCALAR", 8, {{"byteStride", 4}});
  Asset compressed = roundTrip(asset);
  const Json& found = compressed.json["accessors"][primitiveOf(compressed)["attributes"]["COLOR_0"].get<size_t>()];
  EXPECT_EQ(found["componentType"], 5121);
  EXPECT_EQ(found["normalized"], true);
  EXPECT_EQ(found["name"], "paint");
}

TEST(Compress, PointsAndLinesAreLeftAlone) {
  for (uint64_t mode = 0; mode < 4; ++mode) {
    Asset asset = triangleAsset(shapes::cube());
    primitiveOf(asset)["mode"] = mode;
    const auto compressed = compress(asset);
    ASSERT_TRUE(compressed) << why(compressed);
    EXPECT_EQ(compressed->asset.json["meshes"], asset.json["meshes"]);
    EXPECT_EQ(compressed->report.warnings.size(), 1u);
    EXPECT_FALSE(listsExtension(compressed->asset.json, "extensionsUsed", kExtensionName));
  }
}

TEST(Compress, WhatRefersToOrderIsLeftAloneByName) {
  const std::vector<std::pair<std::string, Json>> extensions = {
      {"CESIUM_primitive_outline", {{"indices", 1}}},
      {"EXT_mesh_features", {{"featureIds", Json::array({{{"featureCount", 8}}})}}},
      {"VENDOR_face_colors", {{"colors", 1}}}};
  for (const auto& [name, value] : extensions) {
    Asset asset = triangleAsset(shapes::cube());
    primitiveOf(asset)["extensions"][name] = value;
    const auto compressed = compress(asset);
    ASSERT_TRUE(compressed) << why(compressed);
    EXPECT_TRUE(compressed->report.payloads.empty());
    ASSERT_EQ(compressed->report.warnings.size(), 1u);
    EXPECT_NE(compressed->report.warnings[0].what.find(name), std::string::npos);
    expectSameScene(asset, compressed->asset);
  }
  Asset features = triangleAsset(shapes::cube());
  primitiveOf(features)["attributes"]["_FEATURE_ID_0"] = addFloats(features, {0, 1, 2, 3, 4, 5, 6, 7}, 1);
  primitiveOf(features)["extensions"]["EXT_mesh_features"] = {
      {"featureIds", Json::array({{{"featureCount", 8}, {"attribute", 0}}})}};
  roundTrip(features);
}

TEST(Compress, UnknownExtensionsAndExtrasSurvive) {
  Asset asset = triangleAsset(shapes::cube());
  const uint64_t meant = addShorts(asset, {1, 2, 3});
  asset.json["extensions"]["VENDOR_thing"] = {{"accessor", meant}};
  asset.json["extensionsUsed"] = {"VENDOR_thing"};
  asset.json["extras"] = {{"a", {1, 2, 3}}};
  asset.json["nodes"][0]["extras"] = "text";
  const Asset compressed = roundTrip(asset);
  EXPECT_EQ(compressed.json["extras"], asset.json["extras"]);
  EXPECT_EQ(compressed.json["nodes"], asset.json["nodes"]);
  const auto data = readIndices(compressed, meant);
  ASSERT_TRUE(data) << why(data);
  EXPECT_EQ(*data, (std::vector<Index>{1, 2, 3}));
}

TEST(Compress, CompressedInputIsCompressedAgain) {
  const Asset once = roundTrip(fanAsset(shapes::dodecahedron()));
  const auto twice = compress(once, lossless());
  ASSERT_TRUE(twice) << why(twice);
  expectSameScene(once, twice->asset);
  EXPECT_EQ(once.buffers[0].size(), twice->asset.buffers[0].size());
}

TEST(Compress, FallbackIsReadableWithoutUs) {
  CompressOptions options = lossless();
  options.fallback = true;
  Asset compressed = roundTrip(facetedCube(), options);
  for (size_t i = 0; i < compressed.json["bufferViews"].size(); ++i) {
    eraseExtension(compressed.json["bufferViews"][i], kExtensionName);
  }
  eraseExtension(compressed.json["buffers"][1], kExtensionName);
  expectSameScene(facetedCube(), compressed);
}

TEST(Compress, BrokenPrimitivesAreNamed) {
  for (const auto& [pointer, value] :
       std::vector<std::pair<std::string, Json>>{{"/meshes/0/primitives/0/indices", 77},
                                                 {"/meshes/0/primitives/0/indices", 0},
                                                 {"/meshes/0/primitives/0/mode", 9},
                                                 {"/meshes/0/primitives/0/attributes/POSITION", -1},
                                                 {"/meshes/0/primitives/0/attributes/NORMAL", 1},
                                                 {"/meshes/0/primitives/0/attributes", 3},
                                                 {"/meshes/0/primitives", nullptr},
                                                 {"/meshes/0", 1},
                                                 {"/accessors/0/type", "VEC4"},
                                                 {"/accessors/0/count", 7},
                                                 {"/accessors/0/count", 4000000000u}}) {
    Asset damaged = triangleAsset(shapes::cube());
    damaged.json[Json::json_pointer(pointer)] = value;
    const auto compressed = compress(damaged);
    EXPECT_TRUE(!compressed || !compressed->report.warnings.empty()) << pointer << value;
    EXPECT_TRUE(compressed || compressed.error().where.find('/') != std::string::npos) << why(compressed);
  }
}

}  // namespace
}  // namespace tutte
