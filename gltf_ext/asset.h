#pragma once
// A glTF asset in memory: its JSON and the bytes that belong to it.

#include <cstdint>
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

/// Where the external buffers and images of an asset come from.
class FileSource {
 public:
  virtual ~FileSource() = default;

  /// The bytes that a URI without a scheme names, at most so many. Errors: kIo, and kInvalid at `where`.
  virtual Outcome<Bytes> read(const std::string& uri, uint64_t most, const std::string& where) = 0;
};

/// A .glb or .gltf file's bytes as an asset. URIs with a scheme (https:) are never followed; images may have one,
/// buffers may not. Without a source of files, external buffers are an error, and external images stay URIs.
///
/// The bytes may be anything: nesting depth, chunk and buffer lengths are checked before they are used.
/// Errors: kIo, kInvalid and kUnsupported (with a JSON pointer).
Outcome<Asset> parseAsset(std::span<const uint8_t> bytes, FileSource* files = nullptr);

/// The asset as one GLB. Buffers with bytes are merged into the BIN chunk, except those marked as fallback, which
/// become data URIs; external images that were loaded are embedded.
Outcome<Bytes> toGlb(const Asset& asset);

}  // namespace tutte
