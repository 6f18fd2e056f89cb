#include "gltf_ext/asset_output.h"

#include <algorithm>
#include <string>

#include "gltf_ext/accessors.h"
#include "gltf_ext/buffers.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/glb.h"
#include "gltf_ext/json_access.h"
#include "gltf_ext/uri.h"

namespace tutte {
namespace {

/// What an image is by its first bytes; "" when unknown.
std::string mimeTypeOf(const Bytes& bytes) {
  const auto begins = [&](std::string_view magic, size_t at = 0) {
    return bytes.size() >= at + magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin() + at,
                      [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
  };
  if (begins("\x89PNG")) return "image/png";
  if (begins("\xFF\xD8\xFF")) return "image/jpeg";
  if (begins("RIFF") && begins("WEBP", 8)) return "image/webp";
  if (begins("\xABKTX 20")) return "image/ktx2";
  if (begins("DDS ")) return "image/vnd-ms.dds";
  if (begins("ftypavif", 4)) return "image/avif";
  return "";
}

/// The bytes behind an image's URI, if it was loaded or holds them itself; otherwise nothing.
Bytes imageBytes(const Asset& asset, const std::string& uri) {
  const auto file = asset.files.find(uri);
  if (file != asset.files.end()) return file->second;
  Outcome<Bytes> decoded = isDataUri(uri) ? decodeDataUri(uri, "/images") : Outcome<Bytes>(Bytes());
  return decoded ? *std::move(decoded) : Bytes();
}

/// Images that are at hand become buffer views. Ones of an unknown kind stay URIs, because glTF wants a type.
void embedImages(Asset& asset) {
  for (size_t i = 0; i < countOf(asset.json, "images"); ++i) {
    Json& image = asset.json["images"][i];
    const Bytes bytes = imageBytes(asset, stringMember(image, "uri"));
    const std::string type = mimeTypeOf(bytes);
    if (type.empty()) continue;
    image["bufferView"] = appendView(asset, bytes);
    image["mimeType"] = type;
    image.erase("uri");
  }
}

std::string dumpJson(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

Outcome<Asset> withOneBuffer(const Asset& asset, bool embed) {
  Asset copy = asset;
  if (embed) embedImages(copy);
  const auto merged = mergeBuffers(copy);
  if (!merged) return merged.error();
  for (size_t i = 0; i < copy.buffers.size(); ++i) {
    Json& buffer = copy.json["buffers"][i];
    // A placeholder has no data, and a loader without the extension must not look for any.
    buffer.erase("uri");
    if (!copy.buffers[i].empty()) buffer["byteLength"] = copy.buffers[i].size();
  }
  return copy;
}

bool isMain(const Asset& asset, size_t index) { return index == 0 && !isFallbackBuffer(asset.json["buffers"][0]); }

Outcome<Bytes> joinedGlb(const Asset& asset) {
  const bool has_main = !asset.buffers.empty() && isMain(asset, 0);
  return joinGlb(dumpJson(asset.json),
                 has_main ? std::span<const uint8_t>(asset.buffers[0]) : std::span<const uint8_t>());
}

Outcome<Bytes> toGlb(const Asset& asset) {
  return guarded<Bytes>([&]() -> Outcome<Bytes> {
    auto copy = withOneBuffer(asset, true);
    if (!copy) return copy.error();
    for (size_t i = 0; i < copy->buffers.size(); ++i) {
      if (copy->buffers[i].empty() || isMain(*copy, i)) continue;
      copy->json["buffers"][i]["uri"] = makeDataUri(copy->buffers[i]);
    }
    return joinedGlb(*copy);
  });
}

}  // namespace tutte
