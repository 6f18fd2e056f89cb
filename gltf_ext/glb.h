#pragma once
// The GLB container: a header, a JSON chunk, and perhaps a BIN chunk.

#include <cstdint>
#include <span>
#include <string_view>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"

namespace tutte {

/// The chunks of a GLB, inside the bytes they were found in.
struct GlbChunks {
  std::string_view json;
  std::span<const uint8_t> bin;  ///< empty when there is none
};

/// True when the bytes begin with GLB's magic.
bool isGlb(std::span<const uint8_t> bytes);

/// Finds the chunks; unknown ones are skipped. Any bytes may be passed. Errors: kInvalid, kUnsupported (version 1).
Outcome<GlbChunks> splitGlb(std::span<const uint8_t> bytes);

/// Chunks to GLB. Errors: kUnsupported beyond 4 GiB.
Outcome<Bytes> joinGlb(std::string_view json, std::span<const uint8_t> bin);

}  // namespace tutte
