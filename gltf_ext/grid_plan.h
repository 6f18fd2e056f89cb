#pragma once
// Which grid each payload's positions are put on, so that meshes that touch stay together.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "gltf_ext/failure.h"
#include "gltf_ext/pack.h"

namespace tutte {

/// Whose positions share one grid.
enum class GridScope : uint8_t {
  kFile,  ///< all of a file, as long as no mesh loses more than two bits by it
  kMesh,  ///< the primitives of one glTF mesh
};

/// The box of one payload's positions.
struct PositionBox {
  std::array<float, 3> least{}, largest{};
  bool known = false;  ///< there are positions, floats, and all are finite
  size_t mesh = 0;     ///< boxes with the same number belong together: they have one grid whatever the scope is
};

/// The box of an attribute of three floats.
PositionBox boxOf(const Attribute& positions, size_t mesh);

/// A grid per box, or nothing where a payload does best with one of its own (it is the only one, or its positions are
/// to be kept without loss).
///
/// The step is that of the largest mesh, its extent / (2^position_bits - 1), halved twice for meshes below a quarter of
/// this extent, four times for those below a sixteenth, and so on; every grid has the same origin, so that the points
/// of a coarse one are points of a fine one. Scope kMesh: each mesh by its own extent and origin. With an error bound
/// on positions: the largest step that keeps it, for all. Fails with kUsage when the bound is below what floats can
/// tell apart.
Outcome<std::vector<std::optional<PositionGrid>>> planGrids(std::span<const PositionBox> boxes,
                                                            const PackOptions& options, GridScope scope);

}  // namespace tutte
