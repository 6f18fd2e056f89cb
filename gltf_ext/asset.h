#pragma once
// A glTF asset in memory: its JSON and the bytes that belong to it.

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "gltf_ext/failure.h"

namespace tutte {

/// Bytes of a file, a buffer or a payload.
using Bytes = std::vector<uint8_t>;

/// A glTF 2.0 asset. `buffers[i]` holds the bytes of `json["buffers"][i]`; a buffer without `uri` that is not the
/// BIN chunk (a placeholder) has none. URIs of loaded buffers are kept in the JSON until it is saved.
struct Asset {
  nlohmann::json json;
  std::vector<Bytes> buffers;
  std::map<std::string, Bytes> files;  ///< external images by their URI, as written in the JSON
};

/// Reads a .glb or .gltf file with its external buffers and images, all of which must lie in the file's own folder
/// or below it. URIs with a scheme (https:) are never followed; images may have one, buffers may not.
///
/// The file may hold anything: nesting depth, chunk and buffer lengths are checked before they are used.
/// Errors: kIo (with the file's name), kInvalid and kUnsupported (with a JSON pointer).
Outcome<Asset> loadAsset(const std::filesystem::path& path);

/// The same from memory. Without a folder, external buffers are an error, and external images stay URIs.
Outcome<Asset> parseAsset(std::span<const uint8_t> bytes, const std::filesystem::path& folder = {});

/// The asset as one GLB. Buffers with bytes are merged into the BIN chunk, except those marked as fallback, which
/// become data URIs; external images that were loaded are embedded.
Outcome<Bytes> toGlb(const Asset& asset);

/// Writes .glb, or .gltf with its buffer as `<stem>.bin` and its external images beside it; which one is told by the
/// extension of `path`. Fallback data is written as `<stem>.fallback.bin` in both cases. All files are written under
/// temporary names and renamed when they are complete. Errors: kUsage (another extension), kIo, and those of toGlb().
Outcome<Done> saveAsset(const Asset& asset, const std::filesystem::path& path);

}  // namespace tutte
