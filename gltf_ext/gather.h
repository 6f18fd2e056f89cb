#pragma once
// Faces and attributes over glTF vertices to a mesh over welded vertices.

#include <span>
#include <vector>

#include "gltf_ext/failure.h"
#include "gltf_ext/polygon_mesh.h"
#include "gltf_ext/polygons.h"

namespace tutte {

/// Makes one mesh of several primitives' faces over the same attributes (attributes[0] is POSITION). Each element of
/// `groups` becomes a face group. Used wedges are welded into one vertex where their positions are equal to the bit;
/// unused ones become isolated vertices and move to the end. O(n).
PolygonMesh weldMesh(std::vector<PrimitiveFaces> groups, std::vector<Attribute> attributes, Index wedge_count);

}  // namespace tutte
