#pragma once
// Random data on top of a mesh's connectivity: wedges, groups, triangulations.

#include <string>
#include <vector>

#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/triangulation.h"
#include "tests/shapes/shapes.h"

namespace tutte::overlays {

struct Base {
  std::string name;
  Connectivity mesh;
};

/// The connectivity of every test shape, and of some random meshes.
std::vector<Base> bases();

/// Per coded corner a wedge. Faces get one of `colours` colours in patches of neighbours (`patch` faces or so), and
/// corners of a vertex whose faces have the same colour share a wedge. colours == 0: a wedge per corner.
std::vector<Index> wedgesByColour(const Connectivity& mesh, Index colours, Index patch, uint64_t seed);

/// Per face one of `colours` colours, in patches.
std::vector<Index> colours(const Connectivity& mesh, Index colours, Index patch, uint64_t seed);

/// Wedges are as many as the largest one + 1.
Index countOf(const std::vector<Index>& values);

/// Per face kNone, or a random earlier or later face that is no interior ring, for about one face in `rarity`.
std::vector<Index> randomRings(Index face_count, Index rarity, uint64_t seed);

enum class Style { kFirstFans, kFans, kTrees, kParallel, kLists };

/// Triangles of every polygon in the given style; polygons with holes always have lists.
Triangulation triangles(const Connectivity& mesh, const std::vector<Index>& ring_owners, Style style, uint64_t seed);

/// Per face its triangles, each with its smallest corner first, sorted: equal for equal triangulations.
std::vector<std::vector<std::array<Index, 3>>> normalised(const Triangulation& triangulation);

}  // namespace tutte::overlays
