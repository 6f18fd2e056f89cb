#include "tools/import.h"

#include <string_view>

#include "gltf_ext/files.h"
#include "tools/text.h"

namespace tutte {
namespace {

/// The first word that is no comment, to tell formats whose files have no fixed first bytes.
std::string_view firstWord(std::span<const uint8_t> bytes) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (!text.starts_with('#')) return text.substr(0, text.find_first_of(" \t\r\n"));
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

Outcome<Imported> readAs(FileFormat format, std::span<const uint8_t> bytes, const std::filesystem::path& path) {
  switch (format) {
    case FileFormat::kObj: return importObj(bytes, path.parent_path());
    case FileFormat::kPly: return importPly(bytes);
    case FileFormat::kOff: return importOff(bytes);
    default: return importAssimp(path);
  }
}

}  // namespace

FileFormat formatOf(const std::filesystem::path& path, std::span<const uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string extension = lowerCase(path.extension().string());
  if (text.starts_with("glTF") || extension == ".glb" || extension == ".gltf") return FileFormat::kGltf;
  if (text.starts_with("ply\n") || text.starts_with("ply\r") || extension == ".ply") return FileFormat::kPly;
  if (extension == ".obj" || extension == ".smf") return FileFormat::kObj;
  if (extension == ".off") {
    const std::string_view word = firstWord(bytes.first(std::min<size_t>(bytes.size(), 1 << 16)));
    return word == "v" ? FileFormat::kObj : FileFormat::kOff;  // found in the wild
  }
  return FileFormat::kOther;
}

Outcome<Imported> importScene(const std::filesystem::path& path) {
  const Outcome<Bytes> bytes = readFile(path);
  if (!bytes) return bytes.error();
  Outcome<Imported> imported = readAs(formatOf(path, *bytes), *bytes, path);
  if (!imported) {
    Failure failure = imported.error();
    failure.where = path.string() + (failure.where.empty() ? "" : ": " + failure.where);
    return failure;
  }
  for (SceneMesh& mesh : imported->scene.meshes) {
    if (mesh.name.empty()) mesh.name = path.stem().string();
  }
  return imported;
}

}  // namespace tutte
