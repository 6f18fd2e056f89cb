#include "tests/gltf/compress_trip.h"

#include <gtest/gtest.h>

#include "gltf_ext/decompress.h"
#include "gltf_ext/extension.h"

namespace tutte {

Json& primitiveOf(Asset& asset, size_t mesh, size_t primitive) {
  return asset.json["meshes"][mesh]["primitives"][primitive];
}

Asset roundTrip(const Asset& asset, CompressOptions options, size_t payloads) {
  auto compressed = compress(asset, options);
  EXPECT_TRUE(compressed) << why(compressed);
  if (!compressed) return emptyAsset();
  EXPECT_EQ(compressed->report.payloads.size(), payloads);
  for (const Failure& failure : validate(compressed->asset)) ADD_FAILURE() << failure.where << ": " << failure.what;
  const auto glb = toGlb(compressed->asset);
  EXPECT_TRUE(glb) << why(glb);
  const auto loaded = parseAsset(*glb);
  EXPECT_TRUE(loaded) << why(loaded);
  const auto plain = decompress(*loaded);
  EXPECT_TRUE(plain) << why(plain);
  expectSameScene(asset, *loaded);
  expectSameScene(asset, *plain);
  return std::move(compressed->asset);
}

}  // namespace tutte
