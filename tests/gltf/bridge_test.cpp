// Compressed files in a tinygltf model.

#include <gtest/gtest.h>

#include <cstring>

#include "gltf_ext/asset_files.h"
#include "gltf_ext/tinygltf_bridge.h"

#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "gltf_ext/accessors.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/files.h"
#include "gltf_ext/glb.h"
#include "tests/gltf/assets.h"
#include "tests/tools/scratch.h"

namespace tutte {
namespace {

/// A white pixel.
const Bytes kPixel = {0x89, 'P',  'N',  'G',  0x0D, 0x0A, 0x1A, 0x0A, 0,    0,    0,    0x0D, 'I',  'H',
                      'D',  'R',  0,    0,    0,    1,    0,    0,    0,    1,    8,    6,    0,    0,
                      0,    0x1F, 0x15, 0xC4, 0x89, 0,    0,    0,    0x0D, 'I',  'D',  'A',  'T',  0x78,
                      0x9C, 0x63, 0xF8, 0xFF, 0xFF, 0xFF, 0x7F, 0,    0x09, 0xFB, 0x03, 0xFD, 0x05, 0x43,
                      0x45, 0xCA, 0,    0,    0,    0,    'I',  'E',  'N',  'D',  0xAE, 0x42, 0x60, 0x82};

Asset compressedCube() {
  Asset asset = triangleAsset(shapes::cube());
  asset.json["images"] = Json::array({{{"bufferView", appendView(asset, kPixel)}, {"mimeType", "image/png"}},
                                      {{"bufferView", appendView(asset, {1, 2, 3})}, {"mimeType", "image/png"}}});
  auto compressed = compress(asset, lossless());
  EXPECT_TRUE(compressed) << why(compressed);
  return std::move(compressed->asset);
}

void expectCube(const tinygltf::Model& model) {
  ASSERT_EQ(model.meshes.size(), 1u);
  const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  EXPECT_EQ(model.accessors[primitive.indices].count, 36u);
  const tinygltf::Accessor& accessor = model.accessors[primitive.attributes.at("POSITION")];
  EXPECT_EQ(accessor.count, 8u);
  const tinygltf::BufferView& view = model.bufferViews[accessor.bufferView];
  const tinygltf::Buffer& buffer = model.buffers[view.buffer];
  ASSERT_LE(view.byteOffset + view.byteLength, buffer.data.size());
  float sum = 0;
  for (size_t i = 0; i < 24; ++i) {
    float value;
    std::memcpy(&value, buffer.data.data() + view.byteOffset + 4 * i, 4);
    sum += value * value;
  }
  float expected = 0;
  for (const auto& position : shapes::cube().positions) {
    for (const float value : position) expected += value * value;
  }
  EXPECT_EQ(sum, expected);
  for (const std::string& name : model.extensionsUsed) EXPECT_NE(name, kExtensionName);
}

TEST(TinygltfBridge, LoadsFromMemory) {
  tinygltf::Model model;
  const auto loaded = loadModel(*toGlb(compressedCube()), model);
  ASSERT_TRUE(loaded) << why(loaded);
  expectCube(model);
  ASSERT_EQ(model.images.size(), 2u);
  EXPECT_EQ(model.images[0].width, 1);
  EXPECT_FALSE(model.images[0].as_is);
  EXPECT_TRUE(model.images[1].as_is) << "what cannot be decoded is kept";
  EXPECT_EQ(model.images[1].image, (Bytes{1, 2, 3}));
}

TEST(TinygltfBridge, LoadsFilesOfBothKinds) {
  const Scratch folder;
  for (const char* name : {"a.glb", "a.gltf"}) {
    ASSERT_TRUE(saveAsset(compressedCube(), folder.path() / name));
    tinygltf::Model model;
    const auto loaded = loadModel(folder.path() / name, model);
    ASSERT_TRUE(loaded) << why(loaded);
    expectCube(model);
  }
  tinygltf::Model model;
  EXPECT_EQ(loadModel(folder.path() / "none.glb", model).error().kind, FailureKind::kIo);
}

TEST(TinygltfBridge, ExternalImagesComeAlongButNothingElse) {
  const Scratch folder;
  Asset asset = triangleAsset(shapes::cube());
  asset.json["images"] = Json::array({{{"uri", "pixel.png"}}, {{"uri", "missing.png"}}});
  ASSERT_TRUE(writeFile(folder.path() / "pixel.png", kPixel));
  ASSERT_TRUE(saveAsset(compress(asset)->asset, folder.path() / "a.gltf"));
  tinygltf::Model model;
  const auto loaded = loadModel(folder.path() / "a.gltf", model);
  ASSERT_TRUE(loaded) << why(loaded);
  EXPECT_EQ(model.images[0].width, 1);
  EXPECT_TRUE(model.images[1].image.empty());
}

TEST(TinygltfBridge, HostileAssetsAreRefusedFirst) {
  for (const auto& [pointer, value] :
       std::vector<std::pair<std::string, Json>>{{"/bufferViews/1/byteOffset", 0xFFFFFFFFFFFFFFF8u},
                                                 {"/bufferViews/1/byteLength", 1u << 30},
                                                 {"/accessors/0/count", 1u << 30},
                                                 {"/accessors/0/byteOffset", 1u << 30},
                                                 {"/accessors/0/bufferView", 77},
                                                 {"/meshes/0/primitives/0/indices", 77},
                                                 {"/nodes/0/children", Json::array({0})},
                                                 {"/nodes/0/children", Json::array({99})},
                                                 {"/images/0/bufferView", 77}}) {
    Asset damaged = compressedCube();
    damaged.json[Json::json_pointer(pointer)] = value;
    // Not through toGlb(), which refuses some of them itself.
    const auto glb = joinGlb(damaged.json.dump(), damaged.buffers[0]);
    ASSERT_TRUE(glb);
    tinygltf::Model model;
    EXPECT_FALSE(loadModel(*glb, model)) << pointer;
  }
}

}  // namespace
}  // namespace tutte
