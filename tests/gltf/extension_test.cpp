// The extension's JSON objects, and every rule between them and the rest of the asset.

#include "gltf_ext/extension.h"

#include <gtest/gtest.h>

#include "gltf_ext/decompress.h"
#include "tests/gltf/assets.h"

namespace tutte {
namespace {

const std::string kExtension = std::string("/extensions/") + kExtensionName;

Asset compressedAsset(bool fallback = false) {
  CompressOptions options = lossless();
  options.fallback = fallback;
  auto compressed = compress(polygonAsset(shapes::prism(6)), options);
  EXPECT_TRUE(compressed) << why(compressed);
  return std::move(compressed->asset);
}

TEST(ExtensionObjects, SurviveJson) {
  for (int mode = 0; mode < kModeCount; ++mode) {
    CompressedView view{{1, 8, 100}, 4, 7, static_cast<Mode>(mode), 0};
    if (view.mode == Mode::kAttribute) view.attribute = 3;
    const auto parsed = parseCompressedView(toJson(view), "");
    ASSERT_TRUE(parsed) << why(parsed);
    EXPECT_EQ(*parsed, view);
  }
}

TEST(ExtensionObjects, EveryPropertyIsChecked) {
  const Json good = toJson({{1, 8, 100}, 4, 7, Mode::kAttribute, 0});
  ASSERT_TRUE(parseCompressedView(good, ""));
  for (const char* key : {"buffer", "byteLength", "byteStride", "count", "mode", "attribute"}) {
    Json damaged = good;
    damaged.erase(key);
    EXPECT_FALSE(parseCompressedView(damaged, "")) << key;
  }
  for (const char* key : {"buffer", "byteOffset", "byteLength", "byteStride", "count", "mode", "attribute"}) {
    for (const Json& value : {Json(-1), Json(1.5), Json("x"), Json(nullptr), Json::array(), Json(1e300)}) {
      Json damaged = good;
      damaged[key] = value;
      EXPECT_FALSE(parseCompressedView(damaged, "")) << key << value;
    }
  }
  for (const char* key : {"byteLength", "byteStride", "count"}) {
    Json damaged = good;
    damaged[key] = 0;
    EXPECT_FALSE(parseCompressedView(damaged, "")) << key;
  }
  for (const uint64_t stride : {1, 2, 6, 20}) {
    Json damaged = good;
    damaged["byteStride"] = stride;
    EXPECT_FALSE(parseCompressedView(damaged, "")) << stride;
  }
  Json unknown = good;
  unknown["mode"] = "SPLINES";
  EXPECT_EQ(parseCompressedView(unknown, "").error().kind, FailureKind::kUnsupported);
  Json triangles = good;
  triangles["mode"] = "TRIANGLES";
  EXPECT_FALSE(parseCompressedView(triangles, "")) << "attribute with another mode";
  triangles.erase("attribute");
  EXPECT_TRUE(parseCompressedView(triangles, ""));
  triangles["byteStride"] = 8;
  EXPECT_FALSE(parseCompressedView(triangles, ""));
}

TEST(ExtensionRules, WhatWeWriteObeysThem) {
  for (const bool fallback : {false, true}) {
    const Asset asset = compressedAsset(fallback);
    for (const Failure& failure : validate(asset)) ADD_FAILURE() << failure.where << ": " << failure.what;
    EXPECT_EQ(listsExtension(asset.json, "extensionsRequired", kExtensionName), !fallback);
    EXPECT_EQ(asset.buffers[1].empty(), !fallback);
  }
}

/// Each change breaks one rule; all are found, with a place, and nothing is decoded.
TEST(ExtensionRules, EachIsEnforced) {
  const Asset good = compressedAsset();
  const Json view = good.json["bufferViews"][0];
  const uint64_t payload_bytes = good.buffers[0].size(), length = view["byteLength"].get<uint64_t>();
  const std::string object = "/bufferViews/0" + kExtension;
  Json marked = {{"fallback", true}};
  const std::vector<std::pair<std::string, Json>> changes = {
      {object + "/buffer", 9},
      {object + "/buffer", 1},
      {object + "/byteOffset", payload_bytes},
      {object + "/byteOffset", 4},
      {object + "/byteOffset", (uint64_t{1} << 53) - 4},
      {object + "/byteLength", payload_bytes + 1},
      {object + "/byteLength", payload_bytes - 20},  // overlaps the payload that the other views name
      {object + "/count", 1},
      {object + "/count", 0xFFFFFFFFu},
      {object + "/byteStride", 4},
      {object + "/mode", "POLYGON_LOOPS"},
      {object + "/mode", 3},
      {object, nullptr},
      {"/bufferViews/0/byteLength", length - 2},
      {"/bufferViews/0/byteLength", length + 2},
      {"/bufferViews/0/byteLength", nullptr},
      {"/bufferViews/0/byteOffset", 2},
      {"/bufferViews/0/byteOffset", uint64_t{1} << 40},
      {"/bufferViews/0/byteOffset", (uint64_t{1} << 53) - 4},
      {"/bufferViews/0/byteOffset", view.value("byteOffset", 0) + 4},  // overlaps the next view
      {"/bufferViews/0/byteStride", 8},
      {"/bufferViews/0/buffer", 0},
      {"/bufferViews/0/buffer", 7},
      {"/buffers/1" + kExtension + "/fallback", false},
      {"/buffers/1" + kExtension, nullptr},
      {"/buffers/1/byteLength", 8},
      {"/buffers/0/extensions", Json{{kExtensionName, marked}}},
      {"/extensionsUsed", Json::array()},
      {"/extensionsRequired", Json::array({"OTHER"})}};
  for (const auto& [pointer, value] : changes) {
    Asset damaged = good;
    damaged.json[Json::json_pointer(pointer)] = value;
    const std::vector<Failure> failures = checkExtension(damaged);
    EXPECT_FALSE(validate(damaged).empty()) << pointer << " " << value;
    for (const Failure& failure : failures) EXPECT_EQ(failure.where.find('/'), 0u) << failure.what;
    EXPECT_FALSE(decompress(damaged)) << pointer << " " << value;
  }
}

TEST(ExtensionRules, AnArrayIsNamedOnce) {
  Asset asset = compressedAsset();
  Json twin = asset.json["bufferViews"][0];
  twin["byteOffset"] = 4096;
  asset.json["buffers"][1]["byteLength"] = 65536;
  asset.json["bufferViews"].push_back(twin);
  EXPECT_FALSE(decompress(asset));
}

TEST(ExtensionRules, OrdinaryViewsStayOutOfPlaceholders) {
  Asset asset = compressedAsset();
  asset.json["buffers"][1]["byteLength"] = 65536;
  asset.json["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 32768}, {"byteLength", 4}});
  EXPECT_EQ(checkExtension(asset).size(), 1u);
}

TEST(ExtensionRules, FallbackBytesMustBeTheDecodedOnes) {
  Asset asset = compressedAsset(true);
  ASSERT_TRUE(validate(asset).empty());
  asset.buffers[1][1] ^= 1;
  const std::vector<Failure> failures = validate(asset);
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_EQ(failures[0].where.find("/bufferViews/"), 0u);
}

TEST(ExtensionRules, CountsMustBeWhatThePayloadHolds) {
  const Asset good = compressedAsset();
  for (size_t i = 0; i < good.json["bufferViews"].size(); ++i) {
    for (const int change : {-1, 1}) {
      Asset damaged = good;
      Json& view = damaged.json["bufferViews"][i];
      Json& object = view["extensions"][kExtensionName];
      object["count"] = object["count"].get<int>() + change;
      view["byteLength"] = object["count"].get<uint64_t>() * object["byteStride"].get<uint64_t>();
      view["byteOffset"] = 4096 + 1024 * i;
      damaged.json["buffers"][1]["byteLength"] = 65536;
      ASSERT_TRUE(checkExtension(damaged).empty());
      EXPECT_FALSE(decompress(damaged)) << object["mode"];
    }
  }
}

TEST(ExtensionRules, AllModesDecode) {
  Asset asset = compressedAsset();
  const Json first = asset.json["bufferViews"][0];
  asset.json["buffers"][1]["byteLength"] = 65536;
  const auto add = [&](Mode mode, uint64_t count) {
    CompressedView object = *parseCompressedView(first["extensions"][kExtensionName], "");
    object.mode = mode;
    object.count = count;
    object.byte_stride = 1;
    asset.json["bufferViews"].push_back({{"buffer", 1},
                                         {"byteOffset", 4096 * (1 + static_cast<int>(mode))},
                                         {"byteLength", count},
                                         {"extensions", {{kExtensionName, toJson(object)}}}});
    return asset.json["bufferViews"].size() - 1;
  };
  const size_t degrees = add(Mode::kDegrees, 8), weld = add(Mode::kWeld, 12);
  const auto plain = decompress(asset);
  ASSERT_TRUE(plain) << why(plain);
  const auto bytes = [&](size_t view) {
    const Json& object = plain->json["bufferViews"][view];
    const auto begin = plain->buffers[0].begin() + object.value("byteOffset", 0);
    return Bytes(begin, begin + object["byteLength"].get<int>());
  };
  Bytes found = bytes(degrees);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (Bytes{4, 4, 4, 4, 4, 4, 6, 6}));
  EXPECT_EQ(bytes(weld), (Bytes{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
}

}  // namespace
}  // namespace tutte
