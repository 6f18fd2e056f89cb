#pragma once
// Probabilities in the logistic domain: stretch(p) = 170 ln(p / (1 - p)) and its inverse, as integer tables that the
// compiler computes with integers alone, so that they are the same everywhere.

#include <array>
#include <cstdint>

#include "codec/made_table.h"

namespace tutte {
namespace logistic {

inline constexpr int kDomain = 4096;  ///< table size; stretched probabilities lie in [-2047, 2047]

// exp(-k / 170) * 2^48 for k = 0 ... 2047, and the same half a step further.
struct Decay {
  std::array<uint64_t, kDomain / 2> whole{}, half{};
};

TUTTE_TABLE Decay kDecay = madeTable([] {
  constexpr uint64_t kStep = 4584638084353230594u;      // exp(-1 / 170) * 2^62
  constexpr uint64_t kHalfStep = 4598142163217826931u;  // exp(-1 / 340) * 2^62
  const auto times = [](uint64_t a, uint64_t b) {       // a * b / 2^62, for factors below 2^63
    const uint64_t a_high = a >> 31, a_low = a & 0x7FFFFFFF, b_high = b >> 31, b_low = b & 0x7FFFFFFF;
    return a_high * b_high + ((a_high * b_low + a_low * b_high) >> 31);
  };
  Decay decay;
  uint64_t power = uint64_t{1} << 62;
  for (int k = 0; k < kDomain / 2; ++k) {
    decay.whole[k] = power >> 14;
    decay.half[k] = times(power, kHalfStep) >> 14;
    power = times(power, kStep);
  }
  return decay;
});

/// squash[s + 2048] = 65536 / (1 + exp(-s / 170)), from 1 to 65535.
TUTTE_TABLE std::array<uint16_t, kDomain> kSquash = madeTable([] {
  std::array<uint16_t, kDomain> table{};
  constexpr uint64_t kOne = uint64_t{1} << 48;
  for (int k = 0; k < kDomain / 2; ++k) {
    const uint64_t high = (kOne << 15) / ((kOne + kDecay.whole[k]) >> 1);
    table[kDomain / 2 + k] = static_cast<uint16_t>(high > 65535 ? 65535 : high);
    if (k > 0) table[kDomain / 2 - k] = static_cast<uint16_t>(high > 65535 ? 1 : 65536 - high);
  }
  table[0] = 1;
  return table;
});

/// stretch4[p >> 4] = 4 * round(170 ln(p / (65536 - p))), for the middle of each interval of 16.
TUTTE_TABLE std::array<int16_t, kDomain> kStretch4 = madeTable([] {
  std::array<int16_t, kDomain> table{};
  int steps = kDomain / 2 - 1;  // falls as p rises to one half
  for (int i = 0; i < kDomain / 2; ++i) {
    const uint64_t odds = 2 * static_cast<uint64_t>(i) + 1, against = 2 * kDomain - odds;
    while (steps > 0 && odds << 48 >= kDecay.half[steps - 1] * against) --steps;
    table[i] = static_cast<int16_t>(-4 * steps);
    table[kDomain - 1 - i] = static_cast<int16_t>(4 * steps);
  }
  return table;
});

}  // namespace logistic

/// stretch of a 16-bit probability, times 4.
inline int16_t stretch4(uint32_t probability) { return logistic::kStretch4[probability >> 4]; }

/// The probability of 1, 1 to 65535, for a stretched value in [-2047, 2047].
constexpr uint32_t squash(int32_t stretched) { return logistic::kSquash[stretched + logistic::kDomain / 2]; }

}  // namespace tutte
