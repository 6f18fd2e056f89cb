#include "gltf_ext/asset_paths.h"

#include <algorithm>

#include "gltf_ext/json_access.h"
#include "gltf_ext/uri.h"

namespace tutte {
namespace {

bool beginsWith(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const auto mismatch = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return mismatch.first == folder.end();
}

}  // namespace

Outcome<std::filesystem::path> safeRelativePath(std::string_view uri, const std::string& where) {
  if (uri.empty()) return invalid(where, "the URI is empty");
  const auto decoded = percentDecode(uri);
  if (!decoded) return invalid(where, "the URI has an invalid percent escape");
  if (hasScheme(uri) || hasScheme(*decoded)) return invalid(where, "URIs with a scheme or a drive are not followed");
  for (const char c : *decoded) {
    if (c == '\\' || static_cast<uint8_t>(c) < 32)
      return invalid(where, "the URI has a backslash or a control character");
  }
  const std::filesystem::path path(*decoded);
  if (path.is_absolute() || path.has_root_path()) return invalid(where, "absolute paths are not followed");
  for (const auto& part : path) {
    if (part == "..") return invalid(where, "the URI leads out of the asset's folder");
  }
  return path;
}

Outcome<std::filesystem::path> resolveInside(const std::filesystem::path& folder, std::string_view uri,
                                             const std::string& where) {
  auto relative = safeRelativePath(uri, where);
  if (!relative) return relative.error();
  std::error_code error;
  const auto root = std::filesystem::weakly_canonical(std::filesystem::absolute(folder, error), error);
  if (error) return Failure{FailureKind::kIo, folder.string(), "the folder cannot be read"};
  const auto path = std::filesystem::weakly_canonical(root / *relative, error);
  if (error || !beginsWith(path, root)) return invalid(where, "the URI leads out of the asset's folder");
  return path;
}

}  // namespace tutte
