#pragma once
// What the ways to write an asset share.

#include <cstddef>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"

namespace tutte {

/// The asset with one buffer, and fallback buffers behind it, all without a URI. `embed`: images at hand go into the
/// buffer, too.
Outcome<Asset> withOneBuffer(const Asset& asset, bool embed);

/// True of the buffer that becomes the BIN chunk, or the .bin file.
bool isMain(const Asset& asset, size_t index);

/// The GLB of what withOneBuffer() made.
Outcome<Bytes> joinedGlb(const Asset& asset);

}  // namespace tutte
