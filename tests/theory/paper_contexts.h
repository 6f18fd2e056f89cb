#pragma once
// The paper's coder with its contexts switched off, to see what they are worth.

#include <cstddef>

#include "codec/mesh.h"

namespace tutte::theory {

/// Bytes of a mesh's connectivity with the paper's symbols.
struct PaperBytes {
  size_t both = 0;      ///< contexts for both kinds of symbols: profile `paper`
  size_t valences = 0;  ///< for valences alone
  size_t degrees = 0;   ///< for degrees alone
  size_t neither = 0;   ///< one context per stream
};

PaperBytes paperBytes(PolygonView mesh);

}  // namespace tutte::theory
