#pragma once
// The vertices of a PLY file, and which attributes their properties are.

#include <string>
#include <vector>

#include "tools/indexed_mesh.h"
#include "tools/ply_header.h"

namespace tutte {

struct PlyVertices {
  std::vector<PlyProperty> properties;
  std::vector<std::vector<float>> columns;  ///< per property: a value per vertex; of a list: nothing
};

/// Gives the mesh, whose vertices are counted, the attributes that the properties' names stand for; others become
/// attributes of their own, and lists are warned about. There are positions afterwards, 0 where the file has none.
void addVertexAttributes(const PlyVertices& vertices, IndexedMesh& mesh, std::vector<std::string>& warnings);

}  // namespace tutte
