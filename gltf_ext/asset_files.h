#pragma once
// Assets from and to files.

#include <filesystem>
#include <span>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"

namespace tutte {

/// Reads a .glb or .gltf file with its external buffers and images, all of which must lie in the file's own folder
/// or below it. Otherwise as parseAsset(), with the file's name in the errors.
Outcome<Asset> loadAsset(const std::filesystem::path& path);

/// parseAsset() with external files below `folder`; none if that is empty.
Outcome<Asset> parseAsset(std::span<const uint8_t> bytes, const std::filesystem::path& folder);

/// Writes .glb, or .gltf with its buffer as `<stem>.bin` and its external images beside it; which one is told by the
/// extension of `path`. Fallback data is written as `<stem>.fallback.bin` in both cases. All files are written under
/// temporary names and renamed when they are complete. Errors: kUsage (another extension), kIo, and those of toGlb().
Outcome<Done> saveAsset(const Asset& asset, const std::filesystem::path& path);

}  // namespace tutte
