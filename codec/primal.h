#pragma once
// A walked dual turned back into the mesh: the decoder's half of codec/dual.h, which knows no input mesh.

#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// What remains of a walk over a dual when it is turned back into the mesh.
struct PrimalMesh {
  Connectivity connectivity;
  std::vector<Index> dual_corner;    ///< per corner: the dual's
  std::vector<uint8_t> on_boundary;  ///< per umbrella: a dummy face touches it
};

/// Turns a walked dual back. `dummies` names the dual umbrellas that are dummy faces. Faces come in the order of the
/// dual's umbrellas, each from the corner that the dual has first; umbrellas are numbered like the dual's faces.
/// O(n). kMalformed: a face of degree below 3, an umbrella with two dummy faces or none but those.
Result<PrimalMesh> primalOf(const Connectivity& dual, const std::vector<Index>& dummies, const Limits& limits);

}  // namespace tutte
