#pragma once
// Meshes as exchange formats hold them, on their way to a PolygonMesh.

#include <string>
#include <vector>

#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// Polygons whose corners index a list of vertices and, separately, lists of texture coordinates, normals ...
struct IndexedMesh {
  /// Values with indices of their own.
  struct CornerAttribute {
    Attribute values;
    std::vector<Index> indices;  ///< per corner; kNone where the file gives no value
  };

  Index vertex_count = 0;
  std::vector<Index> face_degrees;
  std::vector<Index> corners;  ///< below vertex_count
  std::vector<Index> groups;   ///< per face; empty: all 0
  Index group_count = 1;
  std::vector<Attribute> vertex_attributes;
  std::vector<CornerAttribute> corner_attributes;
};

/// The same mesh with wedges: one for every combination of indices that a corner uses. Vertices and faces keep their
/// order, but isolated vertices go to the end. Wedges are ordered by vertex.
///
/// Normals are brought to unit length as glTF demands. Where some corners lack a value that others have, normals are
/// computed from the faces and everything else is zero; `warnings` says so. O(n log n).
PolygonMesh buildMesh(IndexedMesh mesh, std::vector<std::string>& warnings);

/// Joins vertices with positions equal to the bit and wedges with all values equal to the bit, for formats that give
/// every corner a vertex of its own. `mesh.wedges` must be empty (each vertex its own wedge). O(n log n).
PolygonMesh weld(PolygonMesh mesh, std::vector<std::string>& warnings);

}  // namespace tutte
