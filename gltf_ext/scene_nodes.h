#pragma once
// The node tree of an asset.

#include <map>
#include <vector>

#include "gltf_ext/failure.h"
#include "gltf_ext/json_access.h"
#include "gltf_ext/scene.h"

namespace tutte {

/// Fills scene.nodes. `meshes_of` lists the scene's meshes for each glTF mesh. Any JSON may be passed. Errors: kInvalid
/// for children that do not exist, nodes with two parents and cycles.
Outcome<Done> readNodes(const Json& json, const std::map<size_t, std::vector<Index>>& meshes_of, Scene& scene);

}  // namespace tutte
