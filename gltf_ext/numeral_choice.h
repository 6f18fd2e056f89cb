#pragma once
// How the floats of an attribute were probably written.

#include <optional>

#include "codec/numeral_values.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// The format in which coding takes the fewest bits, by an estimate: computed numbers in binary, printed ones in
/// decimals, with as few digits as most of them have. For attributes of floats. O(values).
NumeralFormat chooseNumerals(const Attribute& attribute);

/// The power of ten of which all values are multiples when the format says that they are decimals with so many digits
/// behind the point and have no relation; 0 otherwise.
uint32_t commonDenominator(const NumeralFormat& format);

}  // namespace tutte
