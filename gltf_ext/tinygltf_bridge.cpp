// The only file that knows tinygltf. Its macros must be those of the library's build: the defaults, without own JSON.
#include "gltf_ext/tinygltf_bridge.h"

#include <limits>
#include <string>

#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "gltf_ext/asset.h"
#include "gltf_ext/asset_files.h"
#include "gltf_ext/asset_rules.h"
#include "gltf_ext/decompress.h"
#include "gltf_ext/json_access.h"

namespace tutte {
namespace {

bool keepUndecodable(tinygltf::Image* image, int index, std::string* error, std::string* warning, int width, int height,
                     const unsigned char* bytes, int size, void* user_data) {
  std::string ignored;
  if (tinygltf::LoadImageData(image, index, &ignored, warning, width, height, bytes, size, user_data)) return true;
  static_cast<void>(error);
  image->as_is = true;
  image->image.assign(bytes, bytes + size);
  return true;
}

/// tinygltf would follow what is left of external URIs: it must not.
tinygltf::FsCallbacks closedFileSystem() {
  return {[](const std::string&, void*) { return false; }, [](const std::string& path, void*) { return path; },
          [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; },
          [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }, nullptr};
}

Outcome<Done> convert(const Asset& asset, tinygltf::Model& model) {
  const auto plain = decompress(asset);
  if (!plain) return plain.error();
  const auto checked = checkAsset(*plain);
  if (!checked) return checked;
  const auto glb = toGlb(*plain);
  if (!glb) return glb.error();
  if (glb->size() > std::numeric_limits<int>::max()) return unsupported("", "tinygltf cannot load more than 2 GiB");
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keepUndecodable, nullptr);
  loader.SetFsCallbacks(closedFileSystem());
  std::string error, warning;
  const auto size = static_cast<unsigned>(glb->size());
  if (!loader.LoadBinaryFromMemory(&model, &error, &warning, glb->data(), size)) {
    return invalid("", "tinygltf refuses the asset: " + error);
  }
  return Done{};
}

}  // namespace

Outcome<Done> loadModel(const std::filesystem::path& path, tinygltf::Model& model) {
  return guarded<Done>([&]() -> Outcome<Done> {
    const auto asset = loadAsset(path);
    if (!asset) return asset.error();
    return convert(*asset, model);
  });
}

Outcome<Done> loadModel(std::span<const uint8_t> bytes, tinygltf::Model& model, const std::filesystem::path& folder) {
  return guarded<Done>([&]() -> Outcome<Done> {
    const auto asset = parseAsset(bytes, folder);
    if (!asset) return asset.error();
    return convert(*asset, model);
  });
}

}  // namespace tutte
