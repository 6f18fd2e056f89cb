#pragma once
// Adaptive coding of residuals: the differences between values and their predictions.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "codec/value_tables.h"

namespace tutte::values {

/// An adaptive probability: 22 bits of it, and how often it was used.
class Chance {
 public:
  explicit constexpr Chance(uint32_t one16 = 32768) : state_(one16 << 16) {}

  uint32_t one16() const { return state_ >> 16; }
  int32_t stretched() const { return kStretch[state_ >> 20]; }
  int32_t trusted() const { return stretched() * kConfidence[state_ & 1023] >> 8; }

  void update(bool bit) {
    const uint32_t seen = state_ & 1023;
    const int64_t target = bit ? 0x3FFFFF - kLeast : kLeast;
    const int64_t probability = state_ >> 10;
    const int64_t moved = probability + ((target - probability) * kAdaptation[seen] >> 16);
    state_ = static_cast<uint32_t>(moved) << 10 | (seen + (seen < 255));
  }

  template <class Port>
  bool code(Port& port, bool value) {
    const bool bit = port.code(one16(), value);
    update(bit);
    return bit;
  }

 private:
  static constexpr int64_t kLeast = 2048;  // so that one16() stays between 31 and 65504

  uint32_t state_;
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

/// What is known about a residual before it is coded: one line of statistics per input of the mixer.
inline constexpr int kMostInputs = 5;
struct ResidualContext {
  std::array<uint32_t, kMostInputs> line;
  int component = 0;  ///< 0 to 2
  int level = 0;      ///< of the expected size
  int expected = 0;   ///< the bit length that is expected: 0 to kLongest
  int sign = 0;       ///< below kSigns
};

inline constexpr int kLongest = 18;  // of expected lengths
inline constexpr int kSigns = 8 * 3;

/// Codes residuals by their bit length (a walk up or down from the expected one, by mixed contexts), sign and digits.
class MixingCoder {
 public:
  static constexpr int kInputs = 5;

  MixingCoder() {
    for (int i = 0; i < kInputs; ++i) tables_[i].assign(size_t{kLines[i]} * kBins, Chance());
    mixers_.fill(Mixer<kInputs>());
    signs_.fill(Chance());
    digits_.fill(Chance());
    seconds_.fill(Chance());
  }

  template <class Port>
  int64_t code(Port& port, const ResidualContext& context, int64_t residual) {
    const auto magnitude = static_cast<uint64_t>(residual < 0 ? -residual : residual);
    const int length = codeLength(port, context, static_cast<int>(std::bit_width(magnitude)));
    if (length == 0) return 0;
    Chance& sign = signs_[(context.sign * 3 + context.component) * 3 + std::min(length, 3) - 1];
    const bool negative = sign.code(port, residual < 0);
    const auto decoded = static_cast<int64_t>(codeDigits(port, context, length, magnitude));
    return negative ? -decoded : decoded;
  }

 private:
  // How many contexts each input has.
  static constexpr std::array<uint32_t, kInputs> kLines = {64 * 3 * 4, 15 * 4 * 19, 12 * 16 * 19, 3 * 4 * 19 * 32,
                                                           32 * 19 * 3};
  static constexpr int kBins = 19;  // "longer than expected?", ten steps up, eight steps down
  static constexpr int kUp = 1, kDown = 11;
  static constexpr int kLongestResidual = 30;

  template <class Port>
  int codeLength(Port& port, const ResidualContext& context, int length) {
    std::array<Chance*, kInputs> lines;
    for (int i = 0; i < kInputs; ++i) lines[i] = tables_[i].data() + size_t{context.line[i]} * kBins;
    Mixer<kInputs>* const mixers = &mixers_[static_cast<size_t>(context.component) * kBins];
    const auto decide = [&](int bin, bool value) {
      std::array<Chance*, kInputs> chances;
      for (int i = 0; i < kInputs; ++i) chances[i] = lines[i] + bin;
      return mixers[bin].code(port, chances, value);
    };
    int at = context.expected;
    if (decide(0, length > at)) {
      for (int bin = kUp; ++at < kLongestResidual; bin += bin < kDown - 1) {
        if (!decide(bin, length > at)) break;
      }
    } else {
      for (int bin = kDown; at > 0; --at, bin += bin < kBins - 1) {
        if (!decide(bin, length < at)) break;
      }
    }
    return at;
  }

  // The two digits below the leading one are adaptive, the others plain.
  template <class Port>
  uint64_t codeDigits(Port& port, const ResidualContext& context, int length, uint64_t magnitude) {
    uint64_t value = 1;
    int rest = length - 1;
    const int context_index = (context.component * 8 + std::clamp(length - context.expected, -3, 4) + 3);
    if (rest > 0) {
      --rest;
      value = value << 1 | static_cast<uint64_t>(digits_[context_index].code(port, magnitude >> rest & 1));
    }
    if (rest > 0) {
      --rest;
      value = value << 1 |
              static_cast<uint64_t>(seconds_[context_index * 2 + (value & 1)].code(port, magnitude >> rest & 1));
    }
    if (rest == 0) return value;
    const uint64_t mask = (uint64_t{1} << rest) - 1;
    return value << rest | port.bits(rest, static_cast<uint32_t>(magnitude & mask));
  }

  std::array<std::vector<Chance>, kInputs> tables_;
  std::array<Mixer<kInputs>, 3 * kBins> mixers_;
  std::array<Chance, kSigns * 3 * 3> signs_;
  std::array<Chance, 3 * 8> digits_;
  std::array<Chance, 3 * 8 * 2> seconds_;
};

}  // namespace tutte::values
