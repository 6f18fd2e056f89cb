#pragma once
// The payloads of an asset, for the commands that look into them.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codec/payload.h"
#include "gltf_ext/asset.h"
#include "gltf_ext/attributes.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/pack.h"

namespace tutte {

struct PayloadBytes {
  PayloadRange range;
  std::span<const uint8_t> bytes;  ///< inside the asset
  PayloadView view;                ///< inside the asset, too
};

/// All payloads with valid headers and checksums, in order of their place. Errors: as decompress(); kUnsupported when
/// the asset has none.
Outcome<std::vector<PayloadBytes>> payloadsOf(const Asset& asset);

/// What each attribute of a payload takes of its section ATTRIBUTES; decodes the payload for it. Empty without one.
Outcome<std::vector<AttributeSize>> attributeSizesOf(const PayloadView& payload);

/// Per attribute name: how far a component may be from the original in any payload, as their codings say; 0 without
/// loss. Nothing when the asset has no payload that can be read.
std::optional<std::map<std::string, double>> codedBounds(const Asset& asset);

}  // namespace tutte
