#pragma once
// The payloads of an asset, for the commands that look into them.

#include <span>
#include <vector>

#include "codec/payload.h"
#include "gltf_ext/asset.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/failure.h"

namespace tutte {

struct PayloadBytes {
  PayloadRange range;
  std::span<const uint8_t> bytes;  ///< inside the asset
  PayloadView view;                ///< inside the asset, too
};

/// All payloads with valid headers and checksums, in order of their place. Errors: as decompress(); kUnsupported when
/// the asset has none.
Outcome<std::vector<PayloadBytes>> payloadsOf(const Asset& asset);

}  // namespace tutte
