#pragma once
// Coding a mesh as its dual: faces become vertices and vertices become faces (section 2.3 of the paper). A mesh whose
// valences are more regular than its degrees takes fewer bytes one way round, others the other way.

#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"
#include "codec/topology.h"

namespace tutte {

/// A topology that is another one's dual, and how it relates to it.
struct DualTopology {
  Topology topology;                  ///< faces: the primal umbrellas; umbrellas: the primal faces, dummies marked
  std::vector<Index> primal_umbrella; ///< per dual face
  std::vector<Index> primal_corner;   ///< per dual corner
};

/// The dual. O(n).
DualTopology dualOf(const Topology& primal);

/// What remains of a walk over a dual when it is turned back into the mesh.
struct PrimalMesh {
  Connectivity connectivity;
  std::vector<Index> dual_corner;     ///< per corner: the dual's
  std::vector<uint8_t> on_boundary;   ///< per umbrella: a dummy face touches it
};

/// Turns a walked dual back. `dummies` names the dual umbrellas that are dummy faces. Faces come in the order of the
/// dual's umbrellas, each from the corner that the dual has first; umbrellas are numbered like the dual's faces.
/// O(n). kMalformed: a face of degree below 3, an umbrella with two dummy faces or none but those.
Result<PrimalMesh> primalOf(const Connectivity& dual, const std::vector<Index>& dummies, const Limits& limits);

}  // namespace tutte
