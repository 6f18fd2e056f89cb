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
  int32_t stretched() const { return kStretch[static_cast<size_t>((state_ >> 20) + 2048)]; }
  int32_t trusted() const { return stretched() * kConfidence[state_ & 1023] >> 8; }

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

/// Several chances of one decision become one, with weights that learn which of them to trust.
template <int kInputs>
class Mixer {
 public:
  Mixer() { weights_.fill(kInitial); }

  template <class Port>
  [[gnu::always_inline]] bool code(Port& port, const std::array<Chance*, kInputs>& chances, bool value) {
    if constexpr (kInputs == 1) {
      return chances[0]->code(port, value);
    } else {
      std::array<int32_t, kInputs> inputs;
      int64_t sum = 0;
      for (int i = 0; i < kInputs; ++i) {
        inputs[i] = chances[i]->trusted();
        sum += int64_t{inputs[i]} * weights_[i];
      }
      const auto mixed = static_cast<int32_t>(std::clamp<int64_t>(sum >> 16, -kStretchLimit, kStretchLimit));
      const int32_t one = kSquash[mixed + 2048];
      const bool bit = port.code(static_cast<uint32_t>(std::clamp(one, 24, 65512)), value);
      const int32_t error = ((bit ? 65535 : 0) - one) >> 4;
      for (int i = 0; i < kInputs; ++i) {
        const int32_t moved = weights_[i] + ((inputs[i] * error * kLearning + 8192) >> 14);
        weights_[i] = std::clamp(moved, -kLargest, kLargest);
        chances[i]->update(bit);
      }
      return bit;
    }
  }

 private:
  static constexpr int32_t kInitial = 65536 * 13 / (10 * kInputs);
  static constexpr int32_t kLearning = 10, kLargest = 1 << 20;

  std::array<int32_t, kInputs> weights_;
};

}  // namespace tutte::values
