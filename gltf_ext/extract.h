#pragma once
// A part of a mesh as a mesh.

#include <span>

#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// The faces of the given groups, which get the numbers 0, 1, ... in this order. Vertices and wedges that only other
/// groups use are left out; those that no group uses stay with a mesh that keeps all groups, which is returned as it
/// is. The mesh must be consistent, with a triangulation. O(n).
PolygonMesh extractGroups(const PolygonMesh& mesh, std::span<const Index> groups);

}  // namespace tutte
