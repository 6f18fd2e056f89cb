#pragma once
// Wedges: what a glTF file calls vertices. All corners of a wedge belong to one vertex and share all attribute values.

#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// Wedges in coded order: by vertex, and within a vertex by first coded corner. So a mesh without seams has each
/// vertex's number for its wedge, and the one wedge of each isolated vertex comes last.
struct WedgeNumbering {
  std::vector<Index> wedges;  ///< per coded corner
  std::vector<Index> order;   ///< coded wedge -> the caller's wedge; kNone for wedges of isolated vertices
};

/// Puts wedges into coded order. `wedges` holds the caller's wedge of each coded corner, below `wedge_count`. O(n).
/// Errors: kIndexOutOfRange; kMalformed when one wedge is used by two vertices.
Result<WedgeNumbering> numberWedges(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count);

}  // namespace tutte
