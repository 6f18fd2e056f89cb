#pragma once
// What the paper says: Khodakovsky, Alliez, Desbrun, Schroeder, "Near-optimal connectivity encoding of 2-manifold
// polygon meshes", 2002, tables 2 and 3.

#include <optional>
#include <string_view>

#include "codec/mesh.h"

namespace tutte {

/// Bits per vertex of the connectivity, as printed, if the paper has a model of that name (the file's name begins with
/// it), that size (the releases that are around differ by a vertex) and that kind.
std::optional<double> paperBitsPerVertex(std::string_view file_stem, Index vertices, bool all_triangles);

}  // namespace tutte
