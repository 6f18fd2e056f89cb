#pragma once
// An asset compressed and brought back.

#include "gltf_ext/asset.h"
#include "gltf_ext/compress.h"
#include "gltf_ext/json_access.h"
#include "tests/gltf/assets.h"

namespace tutte {

/// A primitive's JSON, to be looked at or changed.
Json& primitiveOf(Asset& asset, size_t mesh = 0, size_t primitive = 0);

/// Compresses without loss, checks the result and its way through GLB, and that the same scene comes back.
Asset roundTrip(const Asset& asset, CompressOptions options = lossless(), size_t payloads = 1);

}  // namespace tutte
