// Accessors: every way to store elements, and every way to lie about them.

#include "gltf_ext/accessors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf_ext/asset_rules.h"
#include "tests/gltf/assets.h"

namespace tutte {
namespace {

/// 48 bytes 0, 1, 2, ... in one view, and an accessor over them.
Asset counting(const Json& accessor, const Json& view = {{"byteOffset", 0}, {"byteLength", 48}}) {
  Asset asset = emptyAsset();
  asset.buffers.emplace_back(48);
  for (uint8_t i = 0; i < 48; ++i) asset.buffers[0][i] = i;
  asset.json["buffers"] = Json::array({{{"byteLength", 48}}});
  asset.json["bufferViews"] = Json::array({view});
  asset.json["bufferViews"][0]["buffer"] = 0;
  asset.json["accessors"] = Json::array({accessor});
  return asset;
}

Json accessor(uint64_t type, const char* kind, uint64_t count, uint64_t offset = 0) {
  return {{"bufferView", 0}, {"componentType", type}, {"type", kind}, {"count", count}, {"byteOffset", offset}};
}

TEST(Accessors, TightAndInterleaved) {
  EXPECT_EQ(*readAccessor(counting(accessor(5121, "VEC3", 2, 5)), 0), (Bytes{5, 6, 7, 8, 9, 10}));
  const Json strided = {{"byteOffset", 4}, {"byteLength", 44}, {"byteStride", 8}};
  EXPECT_EQ(*readAccessor(counting(accessor(5121, "VEC2", 3, 2), strided), 0), (Bytes{6, 7, 14, 15, 22, 23}));
  EXPECT_EQ(*readAccessor(counting(accessor(5123, "SCALAR", 2, 4), strided), 0), (Bytes{8, 9, 16, 17}));
}

TEST(Accessors, MatricesKeepTheirColumns) {
  EXPECT_EQ(readAccessor(counting(accessor(5121, "MAT2", 1)), 0)->size(), 8u);
  EXPECT_EQ(readAccessor(counting(accessor(5121, "MAT3", 1)), 0)->size(), 12u);
  EXPECT_EQ(readAccessor(counting(accessor(5123, "MAT3", 1)), 0)->size(), 24u);
}

TEST(Accessors, IndicesOfAllWidths) {
  EXPECT_EQ(*readIndices(counting(accessor(5121, "SCALAR", 3)), 0), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(*readIndices(counting(accessor(5123, "SCALAR", 2)), 0), (std::vector<Index>{0x100, 0x302}));
  EXPECT_EQ(*readIndices(counting(accessor(5125, "SCALAR", 1, 4)), 0), (std::vector<Index>{0x07060504}));
  for (const uint64_t type : {5120, 5122, 5126}) EXPECT_FALSE(readIndices(counting(accessor(type, "SCALAR", 3)), 0));
  EXPECT_FALSE(readIndices(counting(accessor(5123, "VEC2", 3)), 0));
}

TEST(Accessors, SparseValuesReplaceOthers) {
  Json sparse = accessor(5121, "SCALAR", 6);
  sparse["sparse"] = {{"count", 2},
                      {"indices", {{"bufferView", 0}, {"byteOffset", 1}, {"componentType", 5121}}},
                      {"values", {{"bufferView", 0}, {"byteOffset", 40}}}};
  EXPECT_EQ(*readAccessor(counting(sparse), 0), (Bytes{0, 40, 41, 3, 4, 5}));
  sparse.erase("bufferView");
  EXPECT_EQ(*readAccessor(counting(sparse), 0), (Bytes{0, 40, 41, 0, 0, 0}));

  for (const auto& [pointer, value] :
       std::vector<std::pair<std::string, Json>>{{"/sparse/count", 7},
                                                 {"/sparse/count", -1},
                                                 {"/sparse/indices/byteOffset", 47},
                                                 {"/sparse/indices/byteOffset", 5},  // 5, 6: beyond the six elements
                                                 {"/sparse/indices/componentType", 5126},
                                                 {"/sparse/indices/bufferView", 9},
                                                 {"/sparse/indices", nullptr},
                                                 {"/sparse/values", 3},
                                                 {"/sparse/values/byteOffset", 47},
                                                 {"/sparse/values/bufferView", -1}}) {
    Json damaged = sparse;
    damaged[Json::json_pointer(pointer)] = value;
    EXPECT_FALSE(readAccessor(counting(damaged), 0)) << pointer << value;
  }
}

TEST(Accessors, RefusesEveryRangeThatDoesNotFit) {
  const auto refused = [](const Json& object, const Json& view = {{"byteLength", 48}}) {
    const auto data = readAccessor(counting(object, view), 0);
    return !data && data.error().kind == FailureKind::kInvalid && !data.error().where.empty();
  };
  EXPECT_TRUE(refused(accessor(5121, "SCALAR", 49)));
  EXPECT_TRUE(refused(accessor(5121, "SCALAR", 0)));
  EXPECT_TRUE(refused(accessor(5126, "VEC3", 4, 1)));
  EXPECT_TRUE(refused(accessor(5121, "SCALAR", 1, 48)));
  EXPECT_TRUE(refused(accessor(5121, "SCALAR", 1, uint64_t{1} << 53)));
  EXPECT_TRUE(refused(accessor(5121, "SCALAR", std::numeric_limits<uint64_t>::max())));
  EXPECT_TRUE(refused(accessor(5126, "MAT4", 0xFFFFFFFFu)));
  EXPECT_TRUE(refused(accessor(5121, "VEC5", 1)));
  EXPECT_TRUE(refused(accessor(5121, "SCALAR", 1), {{"byteLength", 49}}));
  EXPECT_TRUE(refused(accessor(5121, "SCALAR", 1), {{"byteLength", 8}, {"byteOffset", 44}}));
  EXPECT_TRUE(refused(accessor(5121, "SCALAR", 1), {{"byteLength", 8}, {"byteOffset", 0xFFFFFFFFFFFFFFF8u}}));
  EXPECT_TRUE(refused(accessor(5126, "VEC3", 2), {{"byteLength", 48}, {"byteStride", 4}}));
  EXPECT_TRUE(refused(accessor(5126, "VEC3", 2), {{"byteLength", 48}, {"byteStride", uint64_t{1} << 52}}));
  EXPECT_TRUE(refused({{"bufferView", 1}, {"componentType", 5121}, {"type", "SCALAR"}, {"count", 1}}));
  EXPECT_TRUE(refused({{"bufferView", "a"}, {"componentType", 5121}, {"type", "SCALAR"}, {"count", 1}}));
  EXPECT_FALSE(readAccessor(counting(accessor(5130, "SCALAR", 1)), 0));
  EXPECT_FALSE(readAccessor(counting(accessor(5121, "SCALAR", 1)), 1));
}

TEST(Accessors, ZerosAreBounded) {
  Json zeros = accessor(5126, "VEC3", 5);
  zeros.erase("bufferView");
  EXPECT_EQ(*readAccessor(counting(zeros), 0), Bytes(60));
  zeros["count"] = 0xFFFFFFFFu;
  EXPECT_FALSE(readAccessor(counting(zeros), 0));
}

TEST(Accessors, Bounds) {
  const auto bounds = [](const std::vector<float>& values) {
    Asset asset = emptyAsset();
    return asset.json["accessors"][addFloats(asset, values, 2)];
  };
  const Json found = bounds({1, -2, 3, 4});
  EXPECT_EQ(found["min"], Json({1.0, -2.0}));
  EXPECT_EQ(found["max"], Json({3.0, 4.0}));
  EXPECT_FALSE(bounds({1, NAN, 3, 4}).contains("min"));
  Json integers = Json::object();
  setBounds(integers, Bytes{1, 255, 3, 4}, 2, ComponentType::kInt8);
  EXPECT_EQ(integers["min"], Json({1, -1}));
  EXPECT_TRUE(integers["min"][0].is_number_integer());
}

TEST(Accessors, PaddedElements) {
  EXPECT_EQ(padElements(Bytes{1, 2, 3, 4, 5, 6}, 3, 4), (Bytes{1, 2, 3, 0, 4, 5, 6, 0}));
}

TEST(AssetRules, ChecksTheWholeAsset) {
  const Asset good = triangleAsset(shapes::cube());
  EXPECT_TRUE(checkAsset(good));
  for (const auto& [pointer, value] :
       std::vector<std::pair<std::string, Json>>{{"/meshes/0/primitives/0/indices", 9},
                                                 {"/accessors/0/bufferView", 9},
                                                 {"/accessors/0/count", 9},
                                                 {"/bufferViews/1/byteLength", 99999},
                                                 {"/nodes/0/children", Json::array({0})},
                                                 {"/nodes/0/children", Json::array({7})}}) {
    Asset damaged = good;
    damaged.json[Json::json_pointer(pointer)] = value;
    EXPECT_FALSE(checkAsset(damaged)) << pointer;
  }
  Asset cycle = good;
  cycle.json["nodes"] = Json::array({Json::object(), {{"children", {2}}}, {{"children", {1}}}});
  const auto checked = checkAsset(cycle);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().where, "/nodes");
}

}  // namespace
}  // namespace tutte
