#pragma once
// Floats over a mesh without loss: predicted from their surroundings and coded digit by digit.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/numerals.h"
#include "codec/result.h"
#include "codec/value_graph.h"

namespace tutte {

/// What the components of a value have to do with each other. Part of the format.
enum class Relation : uint8_t {
  kNone = 0,
  kUnitVector = 1,  ///< the first three are (nearly) a vector of length 1
  kUnitSum = 2,     ///< all together (nearly) sum up to 1
};

/// How the numbers of an attribute are written. Floats that have no numeral in the system of their component cost 32
/// bits and more, so any system codes any floats.
struct NumeralFormat {
  int components = 3;  ///< 1 to 4
  Relation relation = Relation::kNone;
  std::array<NumeralSystem, 4> systems;  ///< per component

  /// True when all systems are valid, the related ones are equal and can hold a 1, and kUnitVector has three.
  bool valid() const;
};

/// The bytes of the floats' bit patterns, `components` per site in the order of site numbers, in which they are coded.
/// NaNs, infinities and negative zeros come back with all their bits. O(values).
std::vector<uint8_t> encodeNumerals(const ValueGraph& graph, const NumeralFormat& format,
                                    std::span<const uint32_t> floats);

/// The bit patterns of any bytes, or kMalformed. All of `bytes` must be used.
Result<std::vector<uint32_t>> decodeNumerals(const ValueGraph& graph, const NumeralFormat& format,
                                             std::span<const uint8_t> bytes);

}  // namespace tutte
