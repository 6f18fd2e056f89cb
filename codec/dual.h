#pragma once
// Coding a mesh as its dual: faces become vertices and vertices become faces (section 2.3 of the paper). A mesh whose
// valences are more regular than its degrees takes fewer bytes one way round, others the other way.

#include <vector>

#include "codec/mesh.h"
#include "codec/topology.h"

namespace tutte {

/// A topology that is another one's dual, and how it relates to it.
struct DualTopology {
  Topology topology;                   ///< faces: the primal umbrellas; umbrellas: the primal faces, dummies marked
  std::vector<Index> primal_umbrella;  ///< per dual face
  std::vector<Index> primal_corner;    ///< per dual corner
};

/// The dual. O(n).
DualTopology dualOf(const Topology& primal);

}  // namespace tutte
