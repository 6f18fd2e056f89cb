#pragma once
// The buffers of an asset as a whole: bytes that nobody needs go, the rest moves together.

#include <set>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"

namespace tutte {

/// Shortens those of the given buffer views that only accessors use to the bytes that these use.
void trimViews(Asset& asset, const std::set<uint64_t>& views);

/// Merges all buffers that have data and are no fallback into one, which becomes the first; only bytes that a buffer
/// view, or a compression extension of one, names are kept, in their order and at their offsets modulo 8. Other
/// buffers stay behind it, except those that nothing names. Errors: kInvalid for ranges outside their buffer.
Outcome<Done> mergeBuffers(Asset& asset);

}  // namespace tutte
