#pragma once
// One mesh, coded with every profile.

#include <array>

#include "codec/encode.h"
#include "codec/mesh.h"

namespace tutte::theory {

inline constexpr int kProfileCount = 4;
inline constexpr std::array<const char*, kProfileCount> kProfileNames = {"paper", "fast", "default", "small"};

/// What one profile makes of a mesh.
struct Coded {
  size_t bytes = 0;
  Index splits = 0;
  double split_bits = 0;  ///< that there are splits, and where
};

using AllCoded = std::array<Coded, kProfileCount>;

/// Ends the program where a mesh does not come back: figures of broken streams mean nothing.
Coded code(PolygonView mesh, Profile profile, int effort);

/// By number of profile.
AllCoded codeAll(PolygonView mesh, int effort);

inline double perUnit(size_t bytes, size_t count) { return 8.0 * static_cast<double>(bytes) / double(count); }

}  // namespace tutte::theory
