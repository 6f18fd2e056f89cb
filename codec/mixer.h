#pragma once
// Logistic mixing: several adaptive probabilities of one binary decision become one, with weights that learn which of
// them to trust. 16-bit integers, eight at a time.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "codec/lanes.h"
#include "codec/logistic.h"

namespace tutte {

/// An adaptive probability (high 16 bits) and how often it was updated (low 16 bits), in one word.
class Slot {
 public:
  int16_t stretched() const { return logistic::kStretch4[word_ >> 20]; }
  uint32_t probability() const { return word_ >> 16; }

  void update(bool bit) {
    const uint32_t seen = word_ & 0xFFFF;
    const int64_t error = (bit ? 65535 : 0) - static_cast<int64_t>(word_ >> 16);
    word_ += static_cast<uint32_t>((error * kRate[seen]) >> 16) << 16;
    word_ += seen < kLimit;
  }

 private:
  static constexpr uint32_t kLimit = 255;
  // 65536 / (n + 1.9)
  static constexpr std::array<int32_t, kLimit + 1> kRate = [] {
    std::array<int32_t, kLimit + 1> rate{};
    for (uint32_t n = 0; n <= kLimit; ++n) rate[n] = static_cast<int32_t>(655360 / (10 * n + 19));
    return rate;
  }();

  uint32_t word_ = 0x80000000u;
};

/// `kInputs` (a multiple of 8) stretched probabilities, each times 4.
template <int kInputs>
class Inputs {
 public:
  explicit Inputs(const std::array<int16_t, kInputs>& inputs)
      : Inputs(inputs, std::make_index_sequence<kInputs / 8>()) {}

  Lanes operator[](size_t i) const { return lanes_[i]; }

 private:
  template <size_t... i>
  Inputs(const std::array<int16_t, kInputs>& in, std::index_sequence<i...>)
      : lanes_{Lanes({in[8 * i], in[8 * i + 1], in[8 * i + 2], in[8 * i + 3], in[8 * i + 4], in[8 * i + 5],
                      in[8 * i + 6], in[8 * i + 7]})...} {}

  std::array<Lanes, kInputs / 8> lanes_;
};

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

/// The learning rate of a stream's weights: high at first, falling with the number of decisions.
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

/// A final correction: maps (decision, mixed probability) to what was seen there, between 33 points per decision.
class FinalMap {
 public:
  explicit FinalMap(int decisions) : points_(static_cast<size_t>(decisions)) {
    for (auto& point : points_) {
      for (int i = 0; i < 33; ++i) point[i] = static_cast<uint16_t>(squash(std::clamp(i * 128 - 2048, -2047, 2047)));
    }
  }

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
  std::vector<std::array<uint16_t, 33>> points_;
  uint16_t* at_ = nullptr;
  int32_t part_ = 0;
};

}  // namespace tutte
