// An asset to files.

#include <algorithm>
#include <string>

#include "gltf_ext/accessors.h"
#include "gltf_ext/asset.h"
#include "gltf_ext/buffers.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/files.h"
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

/// The asset with one buffer, and fallback buffers behind it.
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

/// Gives buffers with data file names, except the BIN chunk of a GLB.
std::vector<NewFile> splitBuffers(Asset& asset, const std::filesystem::path& path, bool is_glb) {
  std::vector<NewFile> files;
  for (size_t i = 0; i < asset.buffers.size(); ++i) {
    if (asset.buffers[i].empty() || (is_glb && isMain(asset, i))) continue;
    const std::string number = i < 2 ? "" : std::to_string(i);
    const std::string name = path.stem().string() + (isMain(asset, i) ? ".bin" : ".fallback" + number + ".bin");
    asset.json["buffers"][i]["uri"] = percentEncode(name);
    files.push_back({path.parent_path() / name, asset.buffers[i]});
  }
  return files;
}

/// External images, where they are not already.
Outcome<Done> addImages(const Asset& asset, const std::filesystem::path& folder, std::vector<NewFile>& files) {
  for (const auto& [uri, bytes] : asset.files) {
    const auto relative = safeRelativePath(uri, "/images");
    if (!relative) return relative.error();
    const auto path = folder / *relative;
    const auto present = readFile(path);
    if (!present || *present != bytes) files.push_back({path, bytes});
  }
  return Done{};
}

Outcome<Done> saveGuarded(const Asset& asset, const std::filesystem::path& path) {
  const bool is_glb = path.extension() == ".glb";
  if (!is_glb && path.extension() != ".gltf") {
    return Failure{FailureKind::kUsage, path.string(), "the name must end with .glb or .gltf"};
  }
  auto copy = withOneBuffer(asset, is_glb);
  if (!copy) return copy.error();
  std::vector<NewFile> files = splitBuffers(*copy, path, is_glb);
  if (!is_glb) {
    const auto images = addImages(*copy, path.parent_path(), files);
    if (!images) return images;
    const std::string text = copy->json.dump(2, ' ', false, Json::error_handler_t::replace);
    files.push_back({path, Bytes(text.begin(), text.end())});
    return writeFiles(files);
  }
  auto glb = joinedGlb(*copy);
  if (!glb) return glb.error();
  files.push_back({path, *std::move(glb)});
  return writeFiles(files);
}

}  // namespace

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

Outcome<Done> saveAsset(const Asset& asset, const std::filesystem::path& path) {
  return guarded<Done>([&] { return saveGuarded(asset, path); });
}

}  // namespace tutte
