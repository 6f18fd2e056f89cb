#pragma once
// Sorting, once for all who need it in a decoder: each kind of elements would take some kB where a program's size
// counts.

#include <cstdint>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Two numbers as one, the first of which decides about the order.
constexpr uint64_t pairOf(Index first, Index second) { return uint64_t{first} << 32 | second; }
constexpr Index secondOf(uint64_t pair) { return static_cast<Index>(pair); }

/// Ascending. O(n log n), not stable.
void sortNumbers(std::vector<uint64_t>& numbers);

}  // namespace tutte
