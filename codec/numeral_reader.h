#pragma once
// Floats taken apart into numerals, for encoders.

#include <cstdint>
#include <optional>

#include "codec/numerals.h"

namespace tutte {

/// The numeral of a float without sign (its bits below 0x7F800000) in this system, if it has one that gives exactly
/// these bits again. O(digits).
std::optional<Numeral> numeralOf(const NumeralSystem& system, uint32_t magnitude);

}  // namespace tutte
