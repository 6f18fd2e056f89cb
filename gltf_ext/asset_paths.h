#pragma once
// Paths below an asset's folder.

#include <filesystem>
#include <string>
#include <string_view>

#include "gltf_ext/failure.h"

namespace tutte {

/// The relative path that a URI means, after percent-decoding. Refused (kInvalid at `where`): schemes, absolute paths,
/// drive letters, backslashes, control characters, and any step to a parent folder.
Outcome<std::filesystem::path> safeRelativePath(std::string_view uri, const std::string& where);

/// The same below `folder`, symbolic links resolved: one that leads outside is refused, too.
Outcome<std::filesystem::path> resolveInside(const std::filesystem::path& folder, std::string_view uri,
                                             const std::string& where);

}  // namespace tutte
