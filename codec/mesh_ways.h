#pragma once
// The ways round the faces of a mesh and to the corners of its umbrellas, for all who walk over one mesh.

#include <vector>

#include "codec/face_ways.h"
#include "codec/mesh.h"

namespace tutte {

/// 4 bytes per umbrella, and what FaceWays takes. Does not refer to the mesh.
struct MeshWays {
  FaceWays faces;
  std::vector<Index> firsts;  ///< per umbrella, as findFirstCorners() says

  explicit MeshWays(const Connectivity& mesh) : faces(mesh), firsts(mesh.umbrella_count, kNone) {
    findFirstCorners(mesh.twins, mesh.umbrellas, firsts);
  }
};

}  // namespace tutte
