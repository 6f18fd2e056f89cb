#pragma once
// What every PolygonMesh must obey, whoever made it.

#include "gltf_ext/failure.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// The first rule that the mesh breaks, if any: array sizes that contradict each other, indices out of range, rings
/// that own rings or have another group than their polygon, attributes of the wrong length or without POSITION in
/// front. O(size). That wedges belong to one vertex each, and share its position, pack() finds out by itself.
Outcome<Done> checkMesh(const PolygonMesh& mesh);

}  // namespace tutte
