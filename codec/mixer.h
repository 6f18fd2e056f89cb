#pragma once
// Logistic mixing: several adaptive probabilities of one binary decision become one, with weights that learn which of
// them to trust. 16-bit integers, eight at a time.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "codec/lanes.h"
#include "codec/logistic.h"
#include "codec/made_table.h"

namespace tutte {

/// An adaptive probability (high 16 bits) and the rate at which it learns (low 16 bits), in one word. The rate falls
/// with every decision, much as if all decisions had the same weight, down to about 1/255. No probability comes closer
/// than 50 / 65536 to 0 or 1.
class Slot {
 public:
  static constexpr int kLeastRate = 257;

  uint32_t probability() const { return word_ >> 16; }
  int16_t stretched() const { return stretch4(probability()); }
  uint32_t word() const { return word_; }
  void setWord(uint32_t word) { word_ = word; }

  void update(bool bit) {
    const uint32_t flip = bit ? 0xFFFF : 0, rate = word_ & 0xFFFF;
    uint32_t other = word_ >> 16 ^ flip;
    other -= other * rate >> 16;
    word_ = (other ^ flip) << 16 | std::max(rate - (rate * rate >> 17), uint32_t{kLeastRate});
  }

 private:
  uint32_t word_ = 0x80007FFFu;
};

/// A cache line of slots, one for each node of a context.
inline constexpr int kNodeBits = 4, kNodes = 1 << kNodeBits;
struct alignas(64) Line {
  std::array<Slot, kNodes> slot;
};

/// Eight slots' words after a decision.
[[gnu::always_inline]] inline std::array<uint32_t, 8> updatedSlots(const std::array<uint32_t, 8>& words, bool bit) {
  const Lanes::Halves halves = Lanes::split(words);
  const Lanes flip = Lanes::all(static_cast<int16_t>(bit ? -1 : 0)), rate = halves.low;
  const Lanes other = halves.high ^ flip;
  const Lanes slower = (rate - rate.highProduct(rate).shifted<1>()).atLeast(Slot::kLeastRate);
  return Lanes::join({(other - other.highProduct(rate)) ^ flip, slower});
}

/// `kInputs` (a multiple of 8) stretched probabilities, each times 4.
template <int kInputs>
using Inputs = std::array<Lanes, kInputs / 8>;

/// As many weights, 16384 standing for 1.
template <int kInputs>
struct alignas(16) Weights {
  std::array<int16_t, kInputs> weight{};

  /// What the inputs say together: a stretched probability.
  int32_t mix(const Inputs<kInputs>& inputs) const {
    Lanes::Sums sums = Lanes::load(&weight[0]).times(inputs[0]);
    for (int i = 1; i < kInputs / 8; ++i) sums = sums + Lanes::load(&weight[8 * i]).times(inputs[i]);
    return std::clamp(sums.total() >> 16, -2047, 2047);
  }

  /// Adds input * rate / 32768, rounded, to every weight, within 16 bits.
  void learn(const Inputs<kInputs>& inputs, int16_t rate) {
    for (int i = 0; i < kInputs / 8; ++i)
      Lanes::load(&weight[8 * i]).plusProduct(inputs[i], rate).store(&weight[8 * i]);
  }
};

/// The learning rate of a stream's weights: high at first, falling with the number of decisions that they learn from.
class LearningRate {
 public:
  /// Must be called once per decision.
  void advance() {
    if ((decisions_++ & 63) == 0) rate_ = 200 + 1500 * 4000 / (4000 + static_cast<int64_t>(decisions_));
  }

  /// The weights' step for an error in 1/65536 of a probability.
  int16_t step(int32_t error) const { return static_cast<int16_t>((error * rate_) >> 13); }

 private:
  uint64_t decisions_ = 0;
  int64_t rate_ = 0;
};

/// What a decision's probability lacked, in 1/65536: is it worth learning from? Nothing is learned from what was as
/// good as certain: that takes fewer bytes than learning from all, and less time.
inline bool isLarge(int32_t error) {
  constexpr int32_t kLeast = 1024;
  return static_cast<uint32_t>(error + (kLeast - 1)) > 2 * (kLeast - 1);
}

/// A final correction: maps (decision, mixed probability) to what was seen there, between 33 points per decision.
template <int kDecisions>
class FinalMap {
 public:
  FinalMap() { points_.fill(kInitial); }

  uint32_t refine(int decision, int32_t stretched) {
    const int32_t position = stretched + 2048;
    at_ = &points_[static_cast<size_t>(decision)][static_cast<size_t>(position >> 7)];
    part_ = position & 127;
    return (at_[0] * static_cast<uint32_t>(128 - part_) + at_[1] * static_cast<uint32_t>(part_)) >> 7;
  }

  void update(bool bit) {
    const int32_t target = bit ? 65535 : 0;
    at_[0] = static_cast<uint16_t>(at_[0] + ((target - at_[0]) * (128 - part_) >> 13));
    at_[1] = static_cast<uint16_t>(at_[1] + ((target - at_[1]) * part_ >> 13));
  }

 private:
  static TUTTE_TABLE std::array<uint16_t, 33> kInitial = madeTable([] {
    std::array<uint16_t, 33> points{};
    for (int i = 0; i < 33; ++i) points[i] = static_cast<uint16_t>(squash(std::clamp(i * 128 - 2048, -2047, 2047)));
    return points;
  });

  std::array<std::array<uint16_t, 33>, kDecisions> points_;
  uint16_t* at_ = nullptr;
  int32_t part_ = 0;
};

}  // namespace tutte
