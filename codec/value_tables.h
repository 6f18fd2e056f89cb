#pragma once
// The constants of the value coder. All are made by integer recurrences, so that every compiler makes the same ones.

#include <array>
#include <bit>
#include <cstdint>

#include "codec/made_table.h"

namespace tutte::values {

/// Predictions carry four binary digits behind the point.
inline constexpr int kFraction = 4;

/// How far a probability moves at its n-th observation: 65536 / (n + 1.6).
TUTTE_TABLE std::array<uint16_t, 256> kAdaptation = madeTable([] {
  std::array<uint16_t, 256> table{};
  for (uint32_t n = 0; n < 256; ++n) table[n] = static_cast<uint16_t>(655360 / (10 * n + 16));
  return table;
});

/// kReciprocal[n] = 65536 / n, rounded.
TUTTE_TABLE std::array<uint32_t, 256> kReciprocal = madeTable([] {
  std::array<uint32_t, 256> table{};
  for (uint32_t n = 1; n < 256; ++n) table[n] = (65536 + n / 2) / n;
  return table;
});

/// sum / count for count 1 to 255, rounded.
constexpr int64_t mean(int64_t sum, uint32_t count) {
  if (count == 1) return sum;
  if (count == 2) return (sum + 1) >> 1;
  if (count == 4) return (sum + 2) >> 2;
  return (sum * kReciprocal[count] + 32768) >> 16;
}

/// Regular polygons: the diagonal over three sides is k times the side, k = 1 + 2 cos(2 pi / n), in 1/4096; and 1 / k.
struct PolygonRatio {
  int32_t k;
  int32_t inverse;
};
inline constexpr uint32_t kLargestPolygon = 16;
inline constexpr std::array<PolygonRatio, kLargestPolygon + 1> kPolygonRatio = {{
    {0, 0},
    {0, 0},
    {0, 0},
    {0, 0},
    {4096, 4096},
    {6627, 2531},
    {8192, 2048},
    {9204, 1823},
    {9889, 1697},
    {10371, 1618},
    {10723, 1565},
    {10988, 1527},
    {11190, 1499},
    {11350, 1478},
    {11477, 1462},
    {11580, 1449},
    {11664, 1438},
}};

/// Four times the binary logarithm of x / 4 + 1, roughly, for x below 2^31: four steps per doubling.
constexpr int32_t quarterLog(uint32_t x) {
  const int high = 31 ^ __builtin_clz(x + 4);
  return static_cast<int32_t>(4 * (high - 2) + static_cast<int>((x + 4) >> (high - 2) & 3));
}

constexpr int32_t bitLength(uint32_t x) { return static_cast<int32_t>(std::bit_width(x)); }

}  // namespace tutte::values
