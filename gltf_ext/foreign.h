#pragma once
// Meshes that other extensions have compressed.

#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"

namespace tutte {

/// Decodes what EXT_meshopt_compression, KHR_meshopt_compression and KHR_draco_mesh_compression have compressed, and
/// removes these extensions where nothing needs them any more. What cannot be decoded stays, with an entry in
/// `warnings` that says why. Errors: kInvalid for data that breaks these extensions' rules.
Outcome<Done> decodeForeign(Asset& asset, std::vector<Failure>& warnings);

/// The two parts of it.
Outcome<Done> decodeMeshopt(Asset& asset, std::vector<Failure>& warnings);
Outcome<Done> decodeDraco(Asset& asset, std::vector<Failure>& warnings);

}  // namespace tutte
