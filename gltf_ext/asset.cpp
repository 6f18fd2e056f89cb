#include "gltf_ext/asset.h"

#include <algorithm>

#include "gltf_ext/extension.h"
#include "gltf_ext/glb.h"
#include "gltf_ext/json_access.h"
#include "gltf_ext/uri.h"

namespace tutte {
namespace {

/// All bytes of one asset together: so that many buffers naming one big file cannot fill the memory.
constexpr uint64_t kMaxAssetBytes = uint64_t{1} << 32;

/// Loads what the JSON refers to.
class Loader {
 public:
  Loader(Asset& asset, FileSource* files) : asset_(asset), files_(files) {}

  Outcome<Done> buffers(Bytes bin, bool is_glb) {
    const size_t count = countOf(asset_.json, "buffers");
    asset_.buffers.resize(count);
    for (size_t i = 0; i < count; ++i) {
      const auto buffer = elementOf(asset_.json, "buffers", i);
      if (!buffer) return buffer.error();
      const bool is_bin = is_glb && i == 0 && !member(**buffer, "uri");
      if (is_bin) asset_.buffers[0] = std::move(bin);
      const auto loaded = is_bin ? Outcome<Done>(Done{}) : external(**buffer, i);
      if (!loaded) return loaded.error();
      const auto fits = fit(**buffer, i, is_bin);
      if (!fits) return fits.error();
    }
    return Done{};
  }

  /// Images that are not there stay as URIs: a viewer reports them, we need not.
  Outcome<Done> images() {
    for (size_t i = 0; files_ && i < countOf(asset_.json, "images"); ++i) {
      const auto image = elementOf(asset_.json, "images", i);
      if (!image) return image.error();
      const std::string uri = stringMember(**image, "uri");
      if (uri.empty() || hasScheme(uri) || asset_.files.count(uri)) continue;
      auto bytes = read(uri, pointerTo("images", i) + "/uri");
      if (bytes) {
        asset_.files[uri] = *std::move(bytes);
      } else if (bytes.error().kind != FailureKind::kIo) {
        return bytes.error();
      }
    }
    return Done{};
  }

 private:
  Outcome<Bytes> read(const std::string& uri, const std::string& where) {
    auto bytes = files_->read(uri, kMaxAssetBytes - loaded_, where);
    if (bytes) loaded_ += bytes->size();
    return bytes;
  }

  Outcome<Done> external(const Json& buffer, size_t index) {
    const std::string uri = stringMember(buffer, "uri");
    const std::string where = pointerTo("buffers", index) + "/uri";
    if (!member(buffer, "uri")) return Done{};
    const bool is_data = isDataUri(uri);
    if (!is_data && !files_) return unsupported(where, "external buffers need a folder: load the asset from a file");
    auto bytes = is_data ? decodeDataUri(uri, where) : read(uri, where);
    if (!bytes && bytes.error().kind == FailureKind::kIo && isFallbackBuffer(buffer)) return Done{};
    if (!bytes) return bytes.error();
    asset_.buffers[index] = *std::move(bytes);
    return Done{};
  }

  /// Cuts padding off and refuses buffers that are too short. Placeholders have no bytes at all.
  Outcome<Done> fit(const Json& json, size_t index, bool is_bin) {
    const std::string where = pointerTo("buffers", index);
    const auto length = integerMember(json, "byteLength", where);
    if (!length) return length.error();
    Bytes& bytes = asset_.buffers[index];
    if (bytes.empty() && !is_bin) return Done{};
    if (bytes.size() < *length) return invalid(where, "the buffer's data is shorter than its byteLength");
    bytes.resize(*length);
    return Done{};
  }

  Asset& asset_;
  FileSource* const files_;
  uint64_t loaded_ = 0;
};

Outcome<Done> checkVersion(const Json& json) {
  const Json* asset = objectMember(json, "asset");
  if (!asset) return invalid("/asset", "the property 'asset' is missing: this is not glTF 2.0");
  const Json* minimum = member(*asset, "minVersion");
  const std::string version = stringMember(*asset, minimum ? "minVersion" : "version");
  if (!version.starts_with("2.")) return unsupported("/asset/version", "only glTF 2.x is supported");
  return Done{};
}

Outcome<Asset> assemble(std::string_view text, Bytes bin, bool is_glb, FileSource* files) {
  auto json = parseJson(text, "");
  if (!json) return json.error();
  Asset asset{*std::move(json), {}, {}};
  const auto version = checkVersion(asset.json);
  if (!version) return version.error();
  Loader loader(asset, files);
  const auto buffers = loader.buffers(std::move(bin), is_glb);
  if (!buffers) return buffers.error();
  const auto images = loader.images();
  if (!images) return images.error();
  return asset;
}

}  // namespace

Outcome<Asset> parseAsset(std::span<const uint8_t> bytes, FileSource* files) {
  return guarded<Asset>([&]() -> Outcome<Asset> {
    if (!isGlb(bytes)) {
      const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      if (text.find('{') == text.npos)
        return invalid("", "this is no glTF: neither a GLB, which begins with the letters glTF, nor JSON");
      return assemble(text, {}, false, files);
    }
    const auto glb = splitGlb(bytes);
    if (!glb) return glb.error();
    return assemble(glb->json, Bytes(glb->bin.begin(), glb->bin.end()), true, files);
  });
}

}  // namespace tutte
