#include "gltf_ext/asset_files.h"

#include <string>
#include <vector>

#include "gltf_ext/asset_output.h"
#include "gltf_ext/asset_paths.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/files.h"
#include "gltf_ext/json_access.h"
#include "gltf_ext/uri.h"

namespace tutte {
namespace {

/// A folder, and what is below it.
class Folder : public FileSource {
 public:
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {}

  Outcome<Bytes> read(const std::string& uri, uint64_t most, const std::string& where) override {
    const auto path = resolveInside(path_, uri, where);
    if (!path) return path.error();
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(*path, error);
    if (!error && size > most) return invalid(where, "the asset has more than 4 GiB of data");
    return readFile(*path);
  }

 private:
  std::filesystem::path path_;
};

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

Outcome<Asset> loadAsset(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  auto asset = parseAsset(*bytes, folder);
  if (asset) return asset;
  Failure failure = asset.error();
  if (failure.kind != FailureKind::kIo)
    failure.where = path.string() + (failure.where.empty() ? "" : " ") + failure.where;
  return failure;
}

Outcome<Asset> parseAsset(std::span<const uint8_t> bytes, const std::filesystem::path& folder) {
  Folder files(folder);
  return parseAsset(bytes, folder.empty() ? nullptr : &files);
}

Outcome<Done> saveAsset(const Asset& asset, const std::filesystem::path& path) {
  return guarded<Done>([&] { return saveGuarded(asset, path); });
}

}  // namespace tutte
