#pragma once
// Floats as whole numbers of the system that they were written in: n * 2^x as computed, or n * 10^x as printed. What
// was printed with six digits has no more than six digits to be coded, though a float has 24 binary ones.

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>

namespace tutte {

/// A number n * radix^x; the radix is that of its system.
struct Numeral {
  uint32_t n = 0;
  int x = 0;
};

/// Numbers with at most `digits` digits, none below radix^least or above radix^top. Written in one way only: x is
/// `least` or n has all digits.
struct NumeralSystem {
  int radix = 2;  ///< 2 or 10
  int digits = 24;
  int least = -149;
  int top = 104;

  static constexpr int kMostBinary = 24, kMostDecimal = 8;  ///< digits

  bool operator==(const NumeralSystem&) const = default;

  /// True when the limits make sense: 1 to 24 binary or 1 to 8 decimal digits; -149 <= least <= top <= 104, or -22
  /// to 22.
  bool valid() const {
    const bool binary = radix == 2;
    return (binary || radix == 10) && digits >= 1 && digits <= (binary ? kMostBinary : kMostDecimal) && least <= top &&
           least >= (binary ? -149 : -22) && top <= (binary ? 104 : 22);
  }

  /// Predictions are made in units of radix^(top - spare()), in which all numbers are below 2^27.
  int spare() const { return allDigits() - digits; }
  /// What a number in these units has at most.
  int allDigits() const { return radix == 2 ? 27 : kMostDecimal; }

  /// radix^exponent, exponent 0 to 40 (binary) or 0 to 18 (decimal).
  int64_t power(int exponent) const { return radix == 2 ? int64_t{1} << exponent : kPowersOf10[exponent]; }

  /// How many digits a number below power(18) or 2^62 has; 0 for 0.
  int digitsOf(int64_t number) const {
    const auto width = static_cast<int>(std::bit_width(static_cast<uint64_t>(number)));
    if (radix == 2) return width;
    const int least_count = width * 1233 >> 12;  // log10(2) is a little more than that
    return least_count + (number >= kPowersOf10[least_count]);
  }

  /// A number in units of radix^(top - spare()), rounded towards zero. x must not exceed `top`.
  int32_t fixed(const Numeral& numeral) const {
    const int up = numeral.x - top + spare();
    if (up >= 0) return static_cast<int32_t>(numeral.n * power(up));
    return -up > digits ? 0 : static_cast<int32_t>(numeral.n / power(-up));
  }

  /// The bits of the float nearest to a numeral. Decimal: |x| <= 22, one operation in binary64, then rounded, which
  /// every platform does alike.
  uint32_t floatOf(const Numeral& numeral) const {
    if (numeral.n == 0) return 0;
    return radix == 2 ? binaryFloat(numeral) : decimalFloat(numeral);
  }

  static constexpr std::array<int64_t, 19> kPowersOf10 = [] {
    std::array<int64_t, 19> table{};
    int64_t power = 1;
    for (int64_t& entry : table) {
      entry = power;
      if (power < 1'000'000'000'000'000'000) power *= 10;
    }
    return table;
  }();

 private:
  static constexpr std::array<double, 23> kExactPowers = [] {
    std::array<double, 23> table{};
    double power = 1;
    for (double& entry : table) {
      entry = power;
      power *= 10;
    }
    return table;
  }();

  static uint32_t binaryFloat(const Numeral& numeral) {
    const int width = static_cast<int>(std::bit_width(numeral.n)), exponent = numeral.x + width + 126;
    if (exponent <= 0) return numeral.n << (numeral.x + 149);
    return static_cast<uint32_t>(exponent) << 23 | ((numeral.n << (24 - width)) & 0x7FFFFF);
  }

  static uint32_t decimalFloat(const Numeral& numeral) {
    const double power = kExactPowers[std::abs(numeral.x)];
    return std::bit_cast<uint32_t>(static_cast<float>(numeral.x < 0 ? numeral.n / power : numeral.n * power));
  }
};

}  // namespace tutte
