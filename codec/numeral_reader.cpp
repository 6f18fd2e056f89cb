#include "codec/numeral_reader.h"

#include <algorithm>
#include <cmath>

namespace tutte {
namespace {

std::optional<Numeral> binaryNumeral(const NumeralSystem& system, uint32_t magnitude) {
  const uint32_t exponent = magnitude >> 23;
  uint32_t n = (magnitude & 0x7FFFFF) | (exponent > 0 ? 0x800000u : 0u);
  const int x = static_cast<int>(exponent > 0 ? exponent : 1) - 150;
  const int wanted = std::max(system.least, x + static_cast<int>(std::bit_width(n)) - system.digits);
  if (wanted > x) {
    if (std::countr_zero(n) < wanted - x) return {};
    n >>= wanted - x;
  } else {
    n <<= x - wanted;  // at most to `digits` digits
  }
  return Numeral{n, wanted};
}

std::optional<Numeral> decimalNumeral(const NumeralSystem& system, uint32_t magnitude) {
  const double value = std::bit_cast<float>(magnitude);
  const int places = static_cast<int>(std::floor(std::log10(value))) + 1;
  // The logarithm may be off by one where the value is close to a power of ten.
  for (const int x : {places - system.digits, places - system.digits + 1, places - system.digits - 1}) {
    const int wanted = std::max(system.least, x);
    if (wanted > system.top || wanted < -22 || wanted > 22) continue;
    const double scale = std::pow(10.0, std::abs(wanted));
    const double n = std::nearbyint(wanted < 0 ? value * scale : value / scale);
    const auto limit = static_cast<double>(NumeralSystem::kPowersOf10[system.digits]);
    const bool whole = n >= limit / 10 || (wanted == system.least && n >= 1);
    if (!whole || n >= limit) continue;
    const Numeral numeral{static_cast<uint32_t>(n), wanted};
    if (system.floatOf(numeral) == magnitude) return numeral;
  }
  return {};
}

}  // namespace

std::optional<Numeral> numeralOf(const NumeralSystem& system, uint32_t magnitude) {
  if (magnitude == 0) return Numeral{0, system.least};
  if (magnitude >= 0x7F800000u) return {};
  const auto numeral = system.radix == 2 ? binaryNumeral(system, magnitude) : decimalNumeral(system, magnitude);
  return numeral && numeral->x <= system.top ? numeral : std::nullopt;
}

}  // namespace tutte
