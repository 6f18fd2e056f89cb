// Assets in and out: containers, URIs, buffers, images; and files that lie.

#include "gltf_ext/asset.h"

#include <gtest/gtest.h>

#include "gltf_ext/accessors.h"
#include "gltf_ext/asset_files.h"
#include "gltf_ext/asset_paths.h"
#include "gltf_ext/buffers.h"
#include "gltf_ext/files.h"
#include "gltf_ext/glb.h"
#include "gltf_ext/references.h"
#include "gltf_ext/uri.h"
#include "tests/gltf/assets.h"
#include "tests/tools/scratch.h"

namespace tutte {
namespace {

Bytes bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

Outcome<Asset> parseText(const std::string& text) { return parseAsset(bytesOf(text)); }

const Bytes kPng = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 1, 2, 3};

TEST(Asset, WhatIsNoGltfSaysSo) {
  const auto asset = parseText("solid cube");
  ASSERT_FALSE(asset);
  EXPECT_EQ(asset.error().kind, FailureKind::kInvalid);
  EXPECT_NE(asset.error().what.find("neither a GLB"), std::string::npos) << asset.error().what;
}

TEST(Uri, PercentDecoding) {
  EXPECT_EQ(percentDecode("a%20b%2Fc"), "a b/c");
  EXPECT_EQ(percentDecode("a%2"), std::nullopt);
  EXPECT_EQ(percentDecode("a%zz"), std::nullopt);
  EXPECT_EQ(percentEncode("a b/ä"), "a%20b/%C3%A4");
}

TEST(Uri, DataUris) {
  for (size_t length = 0; length < 8; ++length) {
    Bytes bytes;
    for (size_t i = 0; i < length; ++i) bytes.push_back(static_cast<uint8_t>(251 + i));
    const auto back = decodeDataUri(makeDataUri(bytes), "");
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, bytes);
  }
  EXPECT_EQ(*decodeDataUri("data:,a%41", ""), bytesOf("aA"));
  for (const char* bad : {"data:;base64,A", "data:;base64,A*==", "data:abc", "nodata,x", "data:,%4"}) {
    EXPECT_FALSE(decodeDataUri(bad, "")) << bad;
  }
}

TEST(Uri, OnlyPathsBelowTheFolder) {
  for (const char* good : {"a.bin", "b/c.bin", "./a.bin", "a%20b.bin", "..a", "a..b/c"}) {
    EXPECT_TRUE(safeRelativePath(good, "")) << good;
  }
  for (const char* bad : {"", "/etc/passwd", "../a", "a/../../b", "%2e%2e/a", "..%2Fa", "a\\b", "..\\a", "C:/a",
                          "c%3A/a", "file:///a", "https://host/a", "//host/a", "a%00b", "a%0Ab", "%2Fetc/passwd"}) {
    EXPECT_FALSE(safeRelativePath(bad, "")) << bad;
  }
}

TEST(Uri, SymbolicLinksStayInside) {
  const Scratch folder;
  std::filesystem::create_directories(folder.path() / "inside");
  ASSERT_TRUE(writeFile(folder.path() / "secret.bin", {1}));
  std::filesystem::create_symlink(folder.path() / "secret.bin", folder.path() / "inside/link.bin");
  EXPECT_FALSE(resolveInside(folder.path() / "inside", "link.bin", ""));
  EXPECT_TRUE(resolveInside(folder.path(), "inside/link.bin", ""));
}

TEST(Asset, RefusesWhatIsNotGltf) {
  for (const char* bad :
       {"", "x", "[]", "{}", "{\"asset\":{}}", "{\"asset\":{\"version\":\"1.0\"}}", "{\"asset\":{\"version\":2}}",
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[3]}", "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{}]}",
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":-1}]}",
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":9,\"uri\":\"data:,abc\"}]}",
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":9,\"uri\":\"a.bin\"}]}"}) {
    EXPECT_FALSE(parseText(bad)) << bad;
  }
  EXPECT_TRUE(parseText("{\"asset\":{\"version\":\"2.0\"}}"));
  EXPECT_TRUE(parseText("{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":3,\"uri\":\"data:,abc\"}]}"));
}

TEST(Asset, RefusesDeepJson) {
  for (const char open : {'[', '{'}) {
    std::string text = "{\"asset\":{\"version\":\"2.0\"},\"extras\":";
    for (int i = 0; i < 1'000'000; ++i) text += open == '[' ? "[" : "{\"a\":";
    const auto asset = parseText(text);
    ASSERT_FALSE(asset);
    EXPECT_NE(asset.error().what.find("nested"), std::string::npos);
  }
  std::string brackets = "{\"asset\":{\"version\":\"2.0\"},\"extras\":\"" + std::string(1000, '[') + "\\\"[\"}";
  EXPECT_TRUE(parseText(brackets));
}

TEST(Asset, GlbChunks) {
  const std::string json = "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":3}]}";
  const auto glb = joinGlb(json, Bytes{1, 2, 3});
  ASSERT_TRUE(glb);
  const auto asset = parseAsset(*glb);
  ASSERT_TRUE(asset) << why(asset);
  EXPECT_EQ(asset->buffers[0], (Bytes{1, 2, 3}));
  for (size_t length = 0; length < glb->size(); ++length) {
    const Bytes prefix(glb->begin(), glb->begin() + length);
    EXPECT_FALSE(parseAsset(prefix)) << length;
  }
  for (const size_t field : {size_t{8}, size_t{12}, 20 + (json.size() + 3) / 4 * 4}) {
    for (const uint8_t high : {uint8_t{0x7F}, uint8_t{0xFF}}) {
      Bytes damaged = *glb;
      damaged[field + 3] = high;
      EXPECT_FALSE(parseAsset(damaged)) << field;
    }
  }
}

TEST(Asset, PlaceholdersHaveNoBytesAndBinIsNotCopiedIntoThem) {
  const std::string json =
      "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":3},{\"byteLength\":1000000000000}]}";
  const auto asset = parseAsset(*joinGlb(json, Bytes{1, 2, 3}));
  ASSERT_TRUE(asset) << why(asset);
  EXPECT_TRUE(asset->buffers[1].empty());
}

TEST(Asset, NoFileOutsideTheFolderIsOpened) {
  const Scratch folder;
  const auto inner = folder.path() / "asset";
  ASSERT_TRUE(writeFile(folder.path() / "secret.bin", {1, 2, 3}));
  for (const char* uri : {"../secret.bin", "%2e%2e/secret.bin", "x/../../secret.bin"}) {
    const Json json = {{"asset", {{"version", "2.0"}}}, {"buffers", Json::array({{{"byteLength", 3}, {"uri", uri}}})}};
    ASSERT_TRUE(writeFile(inner / "a.gltf", bytesOf(json.dump())));
    const auto asset = loadAsset(inner / "a.gltf");
    ASSERT_FALSE(asset) << uri;
    EXPECT_NE(asset.error().where.find("/buffers/0/uri"), std::string::npos);
    const Json images = {{"asset", {{"version", "2.0"}}}, {"images", Json::array({{{"uri", uri}}})}};
    ASSERT_TRUE(writeFile(inner / "b.gltf", bytesOf(images.dump())));
    EXPECT_FALSE(loadAsset(inner / "b.gltf")) << uri;
  }
}

TEST(Asset, MissingFilesAreIoErrors) {
  const Scratch folder;
  EXPECT_EQ(loadAsset(folder.path() / "none.glb").error().kind, FailureKind::kIo);
  const Json json = {{"asset", {{"version", "2.0"}}},
                     {"buffers", Json::array({{{"byteLength", 3}, {"uri", "none.bin"}}})}};
  ASSERT_TRUE(writeFile(folder.path() / "a.gltf", bytesOf(json.dump())));
  const auto asset = loadAsset(folder.path() / "a.gltf");
  ASSERT_FALSE(asset);
  EXPECT_EQ(asset.error().kind, FailureKind::kIo);
}

/// An asset with an external and an embedded image, saved in both formats and read again.
TEST(Asset, ImagesSurviveBothFormats) {
  const Scratch folder;
  Asset asset = triangleAsset(shapes::cube());
  asset.json["images"] = Json::array({{{"uri", "sub%20folder/a.png"}}, {{"uri", "https://example.com/b.png"}}});
  ASSERT_TRUE(writeFile(folder.path() / "in/sub folder/a.png", kPng));
  const auto saved = saveAsset(asset, folder.path() / "in/a.gltf");
  ASSERT_TRUE(saved) << why(saved);
  const auto loaded = loadAsset(folder.path() / "in/a.gltf");
  ASSERT_TRUE(loaded) << why(loaded);
  EXPECT_EQ(loaded->files.at("sub%20folder/a.png"), kPng);

  ASSERT_TRUE(saveAsset(*loaded, folder.path() / "out/b.glb"));
  const auto glb = loadAsset(folder.path() / "out/b.glb");
  ASSERT_TRUE(glb) << why(glb);
  const Json& image = glb->json["images"][0];
  EXPECT_EQ(image["mimeType"], "image/png");
  const auto embedded = viewBytes(*glb, image["bufferView"].get<uint64_t>());
  ASSERT_TRUE(embedded);
  EXPECT_EQ(Bytes(embedded->begin(), embedded->end()), kPng);
  EXPECT_EQ(glb->json["images"][1]["uri"], "https://example.com/b.png");

  ASSERT_TRUE(saveAsset(*loaded, folder.path() / "other/c.gltf"));
  EXPECT_EQ(*readFile(folder.path() / "other/sub folder/a.png"), kPng);
  expectSameScene(asset, *loadAsset(folder.path() / "other/c.gltf"));
  expectSameScene(asset, *glb);
}

TEST(Asset, SavingLeavesNoTemporaryFiles) {
  const Scratch folder;
  ASSERT_TRUE(saveAsset(triangleAsset(shapes::cube()), folder.path() / "a b.gltf"));
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"a b.bin", "a b.gltf"}));
  EXPECT_TRUE(loadAsset(folder.path() / "a b.gltf"));
  EXPECT_EQ(saveAsset(emptyAsset(), folder.path() / "a.txt").error().kind, FailureKind::kUsage);
  EXPECT_EQ(saveAsset(emptyAsset(), "/proc/none/a.glb").error().kind, FailureKind::kIo);
}

TEST(Buffers, MergingKeepsNamedBytesOnly) {
  Asset asset = emptyAsset();
  asset.json["buffers"] = Json::array({{{"byteLength", 20}}, {{"byteLength", 8}}, {{"byteLength", 4}}});
  asset.buffers = {Bytes(20), Bytes(8, 7), Bytes(4, 9)};
  for (size_t i = 0; i < 20; ++i) asset.buffers[0][i] = static_cast<uint8_t>(i);
  asset.json["bufferViews"] = Json::array({{{"buffer", 0}, {"byteOffset", 12}, {"byteLength", 4}},
                                           {{"buffer", 0}, {"byteOffset", 14}, {"byteLength", 4}},
                                           {{"buffer", 1}, {"byteLength", 5}}});
  ASSERT_TRUE(mergeBuffers(asset));
  ASSERT_EQ(asset.buffers.size(), 1u);
  EXPECT_LE(asset.buffers[0].size(), 24u);
  const auto first = viewBytes(asset, 0), second = viewBytes(asset, 1), third = viewBytes(asset, 2);
  EXPECT_EQ(Bytes(first->begin(), first->end()), (Bytes{12, 13, 14, 15}));
  EXPECT_EQ(Bytes(second->begin(), second->end()), (Bytes{14, 15, 16, 17}));
  EXPECT_EQ(Bytes(third->begin(), third->end()), Bytes(5, 7));
  asset.json["bufferViews"][0]["byteLength"] = uint64_t{1} << 53;
  EXPECT_FALSE(mergeBuffers(asset));
}

TEST(References, UnknownExtensionsKeepTheirNumbers) {
  Asset asset = triangleAsset(shapes::cube());
  const uint64_t spare = addShorts(asset, {1, 2, 3}), meant = addShorts(asset, {4, 5, 6});
  asset.json["extensions"]["VENDOR_unknown"] = {{"something", meant}};
  removeUnusedAccessors(asset, {spare, meant});
  ASSERT_EQ(countOf(asset.json, "accessors"), 4u);
  EXPECT_TRUE(asset.json["accessors"][meant].contains("bufferView"));
  EXPECT_FALSE(asset.json["accessors"][spare].contains("bufferView"));
  asset.json.erase("extensions");
  removeUnusedAccessors(asset, {spare, meant});
  EXPECT_EQ(countOf(asset.json, "accessors"), 2u);
}

}  // namespace
}  // namespace tutte
