// Damaged compressed assets: an error or a valid asset, whatever the bytes are.

#include <gtest/gtest.h>

#include "gltf_ext/asset_rules.h"
#include "gltf_ext/decompress.h"
#include "gltf_ext/glb.h"
#include "tests/gltf/assets.h"

namespace tutte {
namespace {

Bytes compressedGlb() {
  auto compressed = compress(polygonAsset(shapes::prism(5)));
  EXPECT_TRUE(compressed) << why(compressed);
  return *toGlb(compressed->asset);
}

/// True when the bytes are refused. What is accepted must be valid.
bool refused(const Bytes& bytes) {
  const auto asset = parseAsset(bytes);
  if (!asset) return true;
  const auto plain = decompress(*asset);
  if (!plain) return true;
  EXPECT_TRUE(validate(*asset).empty());
  // The rest of the JSON may be wrong in ways that are not ours; nothing may crash on it.
  if (checkAsset(*plain)) assetToScene(*asset).ok();
  compress(*asset).ok();
  return false;
}

TEST(HostileGltf, EveryTruncationIsRefused) {
  const Bytes good = compressedGlb();
  ASSERT_FALSE(refused(good));
  for (size_t length = 0; length < good.size(); ++length) {
    EXPECT_TRUE(refused(Bytes(good.begin(), good.begin() + length))) << length;
  }
}

/// The payload's bytes are guarded by checksums: no flip goes unnoticed.
TEST(HostileGltf, EveryFlippedBitOfAPayloadIsRefused) {
  const Bytes good = compressedGlb();
  const auto chunks = splitGlb(good);
  const auto asset = parseAsset(good);
  ASSERT_TRUE(chunks && asset);
  const auto range = asset->json["bufferViews"][0]["extensions"]["TUTTE_mesh_compression"];
  const size_t begin = static_cast<size_t>(chunks->bin.data() - good.data()) + range.value("byteOffset", 0);
  for (size_t i = begin; i < begin + range["byteLength"].get<size_t>(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      Bytes damaged = good;
      damaged[i] = static_cast<uint8_t>(damaged[i] ^ 1 << bit);
      EXPECT_TRUE(refused(damaged)) << i - begin << " bit " << bit;
    }
  }
}

TEST(HostileGltf, ChangedJsonGivesAnAnswer) {
  const Bytes good = compressedGlb();
  const auto chunks = splitGlb(good);
  ASSERT_TRUE(chunks);
  const size_t begin = static_cast<size_t>(reinterpret_cast<const uint8_t*>(chunks->json.data()) - good.data());
  shapes::Random random(7);
  const std::string alphabet = "0123456789-\"{}[],:eE. aTx";
  for (int round = 0; round < 6000; ++round) {
    Bytes damaged = good;
    for (Index change = 0; change <= random.below(3); ++change) {
      const size_t at = begin + random.below(static_cast<Index>(chunks->json.size()));
      damaged[at] = static_cast<uint8_t>(alphabet[random.below(static_cast<Index>(alphabet.size()))]);
    }
    refused(damaged);
  }
}

/// Every value of the JSON becomes something else, one at a time.
TEST(HostileGltf, ReplacedValuesGiveAnAnswer) {
  const auto asset = parseAsset(compressedGlb());
  ASSERT_TRUE(asset);
  const Json flat = asset->json.flatten();
  const Json values[] = {
      nullptr,          true,      -1, 0, 3, 1e300, 4294967295u, 9007199254740992u, "x", Json::array(), Json::object(),
      Json::array({0}), {{"a", 0}}};
  for (const auto& [pointer, old] : flat.items()) {
    for (const Json& value : values) {
      Asset damaged = *asset;
      damaged.json[Json::json_pointer(pointer)] = value;
      const auto glb = joinGlb(damaged.json.dump(), damaged.buffers[0]);
      ASSERT_TRUE(glb);
      refused(*glb);
      toGlb(damaged).ok();
    }
  }
}

/// Sixteen payload-less claims of 4 billion vertices must cost neither time nor memory.
TEST(HostileGltf, ClaimsCostNothing) {
  const auto asset = parseAsset(compressedGlb());
  ASSERT_TRUE(asset);
  Asset damaged = *asset;
  for (Json& view : damaged.json["bufferViews"]) {
    Json& object = view["extensions"]["TUTTE_mesh_compression"];
    object["count"] = 4294967295u;
    view["byteLength"] = 4294967295u * object["byteStride"].get<uint64_t>();
  }
  damaged.json["buffers"][1]["byteLength"] = uint64_t{1} << 50;
  uint64_t offset = 0;
  for (Json& view : damaged.json["bufferViews"]) {
    view["byteOffset"] = offset;
    offset += (view["byteLength"].get<uint64_t>() + 3) / 4 * 4;
  }
  for (Json& accessor : damaged.json["accessors"]) accessor["count"] = 4294967295u;
  const auto plain = decompress(damaged);
  ASSERT_FALSE(plain);
  EXPECT_EQ(plain.error().where.find("/buffers/0"), 0u) << why(plain);
}

}  // namespace
}  // namespace tutte
