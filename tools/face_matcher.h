#pragma once
// One face of A to one of B, from neighbour to neighbour.

#include <optional>
#include <span>
#include <vector>

#include "tools/flat_scene.h"
#include "tools/value_check.h"
#include "tools/vertex_classes.h"

namespace tutte {

/// Which vertex stands for a vertex in the comparison: itself, or its place, which others may share.
struct ComparedVertices {
  std::vector<Index> a, b;
  size_t count = 0;      ///< numbers are below this
  bool related = false;  ///< equal numbers mean the same vertex; otherwise that is to be found out
};

/// Looks for a one-to-one relation of faces and vertices with equal labels, positions and attributes. Nothing when
/// there is one, and `errors` are gauged by it (see ValueCheck::gauge()); otherwise the first face for which there is
/// none. O(n log n), plus the candidates that had to be tried where labels tell nothing apart.
std::optional<Difference> matchFaces(const FlatScene& a, const FlatScene& b, const ClassPair& classes,
                                     const ValueCheck& check, const ComparedVertices& vertices,
                                     std::vector<double>& errors);

}  // namespace tutte
