#pragma once
// Adaptive coding of residuals digit by digit, every decision mixed from five contexts. Small, not fast.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "codec/value_expectation.h"
#include "codec/value_model.h"

namespace tutte::values {

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
  [[gnu::noinline]] int64_t code(Port& port, const Expectation& about, int64_t residual) {
    const auto magnitude = static_cast<uint64_t>(residual < 0 ? -residual : residual);
    const int expected = std::min(bitLength(static_cast<uint32_t>(about.estimate * 3 >> 6)), kLongest);
    const int length = codeLength(port, about, expected, static_cast<int>(std::bit_width(magnitude)));
    if (length == 0) return 0;
    Chance& sign = signs_[static_cast<size_t>((about.sign * 3 + about.rank) * 3 + std::min(length, 3) - 1)];
    const bool negative = sign.code(port, residual < 0);
    const auto decoded = static_cast<int64_t>(
        codeDigits(port, about.rank * 8 + std::clamp(length - expected, -3, 4) + 3, length, magnitude));
    return negative ? -decoded : decoded;
  }

 private:
  // How many contexts each input has.
  static constexpr std::array<uint32_t, kInputs> kLines = {64 * 3 * 4, 15 * 4 * 19, 12 * 16 * 19, 3 * 4 * 19 * 32,
                                                           32 * 19 * 3};
  static constexpr int kLongest = 18;  // of expected lengths
  static constexpr int kBins = 19;     // "longer than expected?", ten steps up, eight steps down
  static constexpr int kUp = 1, kDown = 11;
  static constexpr int kLongestResidual = 30;

  static std::array<uint32_t, kInputs> contextsOf(const Expectation& about, uint32_t e) {
    const int level = about.level();
    const auto rank = static_cast<uint32_t>(about.rank);
    const auto log = [](uint32_t x) { return static_cast<uint32_t>(std::min(quarterLog(x) / 2, 31)); };
    return {(static_cast<uint32_t>(level) * 3 + rank) * 4 + about.members,
            (about.relative(about.spread, level, -7, 7) * 4 + about.members) * 19 + e,
            (about.relative(about.near, level, -5, 6) * 16 + about.relative(about.widest, level, -7, 8)) * 19 + e,
            ((about.source * 4 + about.members) * 19 + e) * 32 + log(Expectation::half(about.all)),
            (log(static_cast<uint32_t>(about.so_far)) * 19 + e) * 3 + rank};
  }

  template <class Port>
  int codeLength(Port& port, const Expectation& about, int expected, int length) {
    const std::array<uint32_t, kInputs> contexts = contextsOf(about, static_cast<uint32_t>(expected));
    std::array<Chance*, kInputs> lines;
    for (int i = 0; i < kInputs; ++i) lines[i] = tables_[i].data() + size_t{contexts[i]} * kBins;
    Mixer<kInputs>* const mixers = &mixers_[static_cast<size_t>(about.rank) * kBins];
    const auto decide = [&](int bin, bool value) {
      std::array<Chance*, kInputs> chances;
      for (int i = 0; i < kInputs; ++i) chances[i] = lines[i] + bin;
      return mixers[bin].code(port, chances, value);
    };
    int at = expected;
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
  uint64_t codeDigits(Port& port, int context_index, int length, uint64_t magnitude) {
    uint64_t value = 1;
    int rest = length - 1;
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
