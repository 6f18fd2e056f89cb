// Input that meshoptimizer or Draco has compressed.

#include "gltf_ext/foreign.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "gltf_ext/accessors.h"
#include "gltf_ext/buffers.h"
#include "gltf_ext/extension.h"
#include "tests/gltf/assets.h"

namespace tutte {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";

Json& viewOf(Asset& asset, uint64_t accessor) {
  return asset.json["bufferViews"][asset.json["accessors"][accessor]["bufferView"].get<size_t>()];
}

/// Moves a view's data into meshopt's form and the view into a placeholder.
void packView(Asset& asset, Json& view, const char* mode, uint64_t stride, Bytes packed) {
  const uint64_t length = view["byteLength"].get<uint64_t>(), size = packed.size();
  const uint64_t stream = appendElement(asset.json, "buffers", {{"byteLength", size}});
  asset.buffers.push_back(std::move(packed));
  const uint64_t old = view["buffer"].get<uint64_t>();
  asset.buffers[old].clear();
  asset.json["buffers"][old]["extensions"][kMeshopt]["fallback"] = true;
  view["extensions"][kMeshopt] = {{"buffer", stream}, {"byteOffset", 0},      {"byteLength", size},
                                  {"mode", mode},     {"byteStride", stride}, {"count", length / stride}};
}

Asset meshoptAsset(const shapes::Shape& shape) {
  Asset asset = triangleAsset(shape);
  const Json primitive = asset.json["meshes"][0]["primitives"][0];
  Json& positions = viewOf(asset, primitive["attributes"]["POSITION"].get<uint64_t>());
  Json& indices = viewOf(asset, primitive["indices"].get<uint64_t>());
  const Bytes vertices = asset.buffers[positions["buffer"].get<size_t>()];
  Bytes packed(meshopt_encodeVertexBufferBound(vertices.size() / 12, 12));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), vertices.data(), vertices.size() / 12, 12));
  packView(asset, positions, "ATTRIBUTES", 12, packed);
  const std::vector<Index> corners = fanIndices(shape.mesh);
  packed.resize(meshopt_encodeIndexSequenceBound(corners.size(), shape.mesh.vertex_count));
  packed.resize(meshopt_encodeIndexSequence(packed.data(), packed.size(), corners.data(), corners.size()));
  packView(asset, indices, "INDICES", 2, packed);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) addExtension(asset.json, list, kMeshopt);
  return asset;
}

TEST(Meshopt, IsDecodedAndCompressedAgain) {
  const shapes::Shape shape = shapes::triangleTorus(12, 9);
  const Asset asset = meshoptAsset(shape);
  expectSameScene(triangleAsset(shape), asset);
  const auto compressed = compress(asset, lossless());
  ASSERT_TRUE(compressed) << why(compressed);
  EXPECT_EQ(compressed->report.payloads.size(), 1u);
  EXPECT_FALSE(listsExtension(compressed->asset.json, "extensionsUsed", kMeshopt));
  EXPECT_EQ(compressed->asset.json.dump().find(kMeshopt), std::string::npos);
  expectSameScene(asset, compressed->asset);
}

TEST(Meshopt, DamageAndLies) {
  const Asset good = meshoptAsset(shapes::triangleTorus(6, 6));
  const std::string object = std::string("/bufferViews/0/extensions/") + kMeshopt;
  for (const auto& [pointer, value] : std::vector<std::pair<std::string, Json>>{{"/count", 0xFFFFFFFFu},
                                                                                {"/count", 0},
                                                                                {"/byteStride", 0},
                                                                                {"/byteStride", 1024},
                                                                                {"/byteOffset", 1u << 30},
                                                                                {"/byteLength", 1u << 30},
                                                                                {"/buffer", 99},
                                                                                {"/mode", "UNKNOWN"},
                                                                                {"/filter", "UNKNOWN"},
                                                                                {"/filter", "QUATERNION"}}) {
    Asset damaged = good;
    damaged.json[Json::json_pointer(object + pointer)] = value;
    const auto compressed = compress(damaged);
    EXPECT_TRUE(!compressed || !compressed->report.warnings.empty()) << pointer << value;
  }
  for (size_t i = 0; i < good.buffers[2].size(); i += 3) {
    Asset damaged = good;
    damaged.buffers[2][i] ^= 0x55;
    compress(damaged).ok();  // any answer, but an answer
  }
}

Asset dracoAsset(const shapes::Shape& shape) {
  Asset asset = triangleAsset(shape);
  const std::vector<Index> corners = fanIndices(shape.mesh);
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(corners.size() / 3));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (size_t i = 0; i < corners.size(); i += 3) {
    const auto at = [&](size_t k) { return shape.positions[corners[i + k]].data(); };
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<uint32_t>(i / 3)), at(0), at(1), at(2));
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 20);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  Json& primitive = asset.json["meshes"][0]["primitives"][0];
  const uint32_t unique_id = mesh->attribute(position)->unique_id();
  primitive["extensions"][kDraco] = {
      {"bufferView", appendView(asset, Bytes(buffer.data(), buffer.data() + buffer.size()))},
      {"attributes", {{"POSITION", unique_id}}}};
  for (Json& accessor : asset.json["accessors"]) accessor.erase("bufferView");
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) addExtension(asset.json, list, kDraco);
  return asset;
}

TEST(Draco, IsDecodedAndCompressedAgain) {
  const shapes::Shape shape = shapes::triangleTorus(12, 9);
  const Asset asset = dracoAsset(shape);
  const auto scene = assetToScene(asset);
  ASSERT_TRUE(scene) << why(scene);
  EXPECT_EQ(scene->meshes[0].mesh.polygons.vertex_count, shape.mesh.vertex_count);
  EXPECT_EQ(scene->meshes[0].mesh.polygons.face_degrees.size(), shape.mesh.face_degrees.size());
  const auto compressed = compress(asset, lossless());
  ASSERT_TRUE(compressed) << why(compressed);
  EXPECT_EQ(compressed->report.payloads.size(), 1u);
  EXPECT_EQ(compressed->asset.json.dump().find(kDraco), std::string::npos);
  expectSameScene(asset, compressed->asset);
}

TEST(Draco, DamageAndLies) {
  const Asset good = dracoAsset(shapes::triangleTorus(6, 6));
  const size_t data = good.buffers.size() - 1;
  for (size_t i = 0; i < good.buffers[data].size(); i += 5) {
    Asset damaged = good;
    damaged.buffers[data][i] ^= 0x11;
    compress(damaged).ok();  // any answer, but an answer
  }
  Asset bomb = good;
  bomb.buffers[data] = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF, 0x7F};
  bomb.json["bufferViews"].back()["byteLength"] = bomb.buffers[data].size();
  bomb.json["buffers"].back()["byteLength"] = bomb.buffers[data].size();
  const auto compressed = compress(bomb);
  ASSERT_TRUE(compressed) << why(compressed);
  EXPECT_FALSE(compressed->report.warnings.empty());
}

}  // namespace
}  // namespace tutte
