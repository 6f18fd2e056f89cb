#pragma once
// Equal elements of a sequence, found by hashing.

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Which elements are equal to which.
struct Distinct {
  std::vector<Index> numbers;  ///< per element: equal ones have the same number; numbers are in order of appearance
  std::vector<Index> firsts;   ///< per number: the first element that has it
};

/// `hash(element)` is a uint64_t, `equal(a, b)` compares two of the elements 0 to count - 1. O(count), as far as hashes
/// differ.
template <class Hash, class Equal>
Distinct findDistinct(Index count, Hash hash, Equal equal) {
  Distinct result;
  result.numbers.reserve(count);
  size_t size = 16;
  while (size < 2 * size_t{count}) size *= 2;
  std::vector<Index> table(size, kNone);
  for (Index element = 0; element < count; ++element) {
    size_t slot = hash(element) & (size - 1);
    while (table[slot] != kNone && !equal(result.firsts[table[slot]], element)) slot = (slot + 1) & (size - 1);
    if (table[slot] == kNone) {
      table[slot] = static_cast<Index>(result.firsts.size());
      result.firsts.push_back(element);
    }
    result.numbers.push_back(table[slot]);
  }
  return result;
}

/// Continues the hash `seed` over bytes.
inline uint64_t hashOf(std::span<const uint8_t> bytes, uint64_t seed) {
  seed = (seed + 1) * 0x9E3779B97F4A7C15u;
  for (size_t at = 0; at < bytes.size(); at += 4) {
    uint32_t word = 0;
    std::memcpy(&word, &bytes[at], bytes.size() - at < 4 ? bytes.size() - at : 4);
    seed = (seed ^ word) * 0x9E3779B97F4A7C15u;
    seed ^= seed >> 32;
  }
  return seed;
}

}  // namespace tutte
