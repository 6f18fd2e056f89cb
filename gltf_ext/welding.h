#pragma once
// Vertices in one place as one, and wedges that nothing tells apart as one.

#include <optional>
#include <set>
#include <string>

#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// The mesh's polygons over points: a point is all vertices with corners whose POSITION (attributes[0]) is equal to the
/// bit, or one vertex without corners; those come last. Nothing when every vertex would be a point of its own. O(n).
std::optional<Polygons> weldedPolygons(const PolygonMesh& mesh);

/// Joins the wedges of each vertex whose attributes are all equal to the bit. O(n).
void joinEqualWedges(PolygonMesh& mesh);

/// Takes away all attributes but POSITION and those named, also of morph targets, then joinEqualWedges(): what only
/// parted values that are gone is no seam any more. No names: the mesh stays as it is.
void keepAttributes(PolygonMesh& mesh, const std::set<std::string>& names);

}  // namespace tutte
