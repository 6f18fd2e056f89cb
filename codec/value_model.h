#pragma once
// Adaptive coding of residuals: the differences between values and their predictions.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "codec/value_tables.h"

namespace tutte::values {

/// An adaptive probability: 22 bits of how far it is from one half, and how often it was used: a new one is all zeros,
/// as are then tables of them, which makes these quick to clear.
class Chance {
 public:
  constexpr Chance() = default;
  explicit constexpr Chance(uint32_t one16) : state_(static_cast<int32_t>(one16 - 32768) * 65536) {}

  uint32_t one16() const { return static_cast<uint32_t>((state_ >> 16) + 32768); }

  void update(bool bit) {
    const int32_t seen = state_ & 1023;
    const int64_t target = bit ? kMost : kLeast;
    const int64_t offset = state_ >> 10;
    const int64_t moved = offset + ((target - offset) * kAdaptation[static_cast<size_t>(seen)] >> 16);
    state_ = static_cast<int32_t>(moved) * 1024 + seen + (seen < 255);
  }

  template <class Port>
  [[gnu::always_inline]] bool code(Port& port, bool value) {
    const bool bit = port.code(one16(), value);
    update(bit);
    return bit;
  }

 private:
  // So that one16() stays between 31 and 65504.
  static constexpr int64_t kLeast = 2048 - (1 << 21), kMost = (1 << 21) - 1 - 2048;

  int32_t state_ = 0;
};

}  // namespace tutte::values
