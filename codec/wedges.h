#pragma once
// Wedges: what a glTF file calls vertices. All corners of a wedge belong to one vertex and share all attribute values.
// In a welded mesh, vertices are parts of points as wedges are parts of vertices.

#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// Wedges (parts) in coded order: by vertex (whole), and within a vertex by first coded corner. So a mesh without seams
/// has each vertex's number for its wedge, and the one wedge of each isolated vertex comes last.
struct PartNumbering {
  std::vector<Index> parts;  ///< per coded corner
  std::vector<Index> order;  ///< coded part -> the caller's part; kNone for those of wholes without corners
};

/// Puts parts into coded order. Per coded corner, `wholes` holds its whole in coded order, below `whole_count`, and
/// `parts` the caller's part, below `part_count`. O(n).
/// Errors: kCountMismatch; kIndexOutOfRange; kMalformed when one part is used by two wholes.
Result<PartNumbering> numberParts(std::span<const Index> wholes, Index whole_count, std::span<const Index> parts,
                                  Index part_count);

}  // namespace tutte
