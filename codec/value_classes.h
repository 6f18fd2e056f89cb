#pragma once
// Adaptive coding of residuals by classes of sizes: one symbol of sixteen per residual, then its sign and digits. The
// distributions of one or two contexts are blended. Fast: no decision is taken more than once per residual.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "codec/made_table.h"
#include "codec/value_expectation.h"
#include "codec/value_lanes.h"
#include "codec/value_model.h"

namespace tutte::values {

/// Distributions that learn, each from a prior.
class Habits {
 public:
  /// `prior(i)` gives the prior of habit i.
  template <class Prior>
  Habits(uint32_t count, Prior prior) : seen_(count, 0) {
    distributions_.reserve(count);
    for (uint32_t i = 0; i < count; ++i) distributions_.push_back(prior(i));
  }

  const Distribution& operator[](uint32_t habit) const { return distributions_[habit]; }

  void learn(uint32_t habit, int symbol) {
    uint8_t& seen = seen_[habit];
    approach(distributions_[habit], kTargets[symbol], kRates[seen]);
    seen = static_cast<uint8_t>(seen + (seen < kLimit));
  }

 private:
  static constexpr uint32_t kLimit = 127;
  static constexpr int kLeast = 3;

  // Where distributions go if only one symbol is seen: every other one keeps a little.
  static TUTTE_TABLE std::array<Distribution, kSymbols> kTargets = madeTable([] {
    std::array<Distribution, kSymbols> targets{};
    for (int symbol = 0; symbol < kSymbols; ++symbol) {
      for (int i = 0; i < kSymbols - 1; ++i) {
        targets[symbol].above[i] =
            static_cast<uint16_t>(kLeast * (kSymbols - 1 - i) + (i < symbol ? 32768 - 16 * kLeast : 0));
      }
    }
    return targets;
  });

  static TUTTE_TABLE std::array<int32_t, kLimit + 1> kRates = madeTable([] {
    std::array<int32_t, kLimit + 1> rates{};
    for (uint32_t n = 0; n <= kLimit; ++n) rates[n] = static_cast<int32_t>(655360 / (10 * n + 160));
    return rates;
  });

  std::vector<Distribution> distributions_;
  std::vector<uint8_t> seen_;  // how many symbols, at most kLimit
};

/// Residuals in classes: 0, 1, 2, 3, 4 to 5, 6 to 7, 8 to 11, 12 to 15 and so on, two for each bit length.
inline int classOf(uint32_t magnitude) {
  if (magnitude < 2) return static_cast<int>(magnitude);
  const int length = std::bit_width(magnitude);
  return 2 * (length - 1) + static_cast<int>(magnitude >> (length - 2) & 1);
}

/// With large residuals the lowest classes are one: all magnitudes below 2^shift. Level as in Expectation.
constexpr int shiftOf(int level) { return level < 28 ? 0 : (level - 24) >> 2; }

/// Expected sizes of residuals, in steps of half an octave (half a level).
inline constexpr uint32_t kScales = 32;

/// What is expected before anything was seen: sizes m or larger have the probability (4 s / (4 s + m - 1/2))^4, s being
/// the expected size.
TUTTE_TABLE std::array<Distribution, kScales> kPriors = madeTable([] {
  std::array<Distribution, kScales> priors{};
  uint64_t power = 84990;  // 2^((2 scale + 3/2) / 4), in 1/65536
  for (uint32_t scale = 0; scale < kScales; ++scale) {
    const uint64_t size = (power * 102 - 65536 * 51) >> 16;  // in 1/256
    const int shift = shiftOf(static_cast<int>(2 * scale));
    uint32_t last = 32768;
    for (int i = 0; i < kSymbols - 1; ++i) {
      const int least_class = i + 1 + (shift == 0 ? 0 : 2 * shift - 1);
      const uint64_t least = least_class < 2 ? static_cast<uint64_t>(least_class)
                                             : (uint64_t{2} + (least_class & 1)) << (least_class / 2 - 1);
      const uint64_t ratio = (4 * size << 16) / (4 * size + 256 * least - 128);
      const uint64_t square = ratio * ratio >> 16;
      const auto above = static_cast<uint32_t>(square * square >> 17);
      // Every symbol keeps a little.
      last = std::max(std::min(above, last - 3), 3u * static_cast<uint32_t>(kSymbols - 1 - i));
      priors[scale].above[i] = static_cast<uint16_t>(last);
    }
    power = power * 92682 >> 16;
  }
  return priors;
});

/// One context (`two` false) or two. Few habits, because small meshes visit each of them seldom.
class ClassCoder {
 public:
  explicit ClassCoder(bool two)
      : two_(two),
        firsts_(kScales * kRows, [](uint32_t i) { return kPriors[i / kRows]; }),
        seconds_(two ? kSeconds : 0, [](uint32_t i) { return kPriors[i % 16 * 2]; }) {}

  template <class Port>
  [[gnu::always_inline]] int64_t code(Port& port, const Expectation& about, int64_t residual) {
    const auto magnitude = static_cast<uint32_t>(residual < 0 ? -residual : residual);
    const int level = about.level(), shift = shiftOf(level);
    const int first = shift == 0 ? 0 : 2 * shift - 1;
    const int value_class = std::max(classOf(magnitude) - first, 0);
    int symbol = codeSymbol(port, about, level, std::min(value_class, kSymbols - 1));
    if (symbol == kSymbols - 1) {
      while (symbol + first < kMostClass &&
             longer_[std::min(symbol - kSymbols + 1, 7)].code(port, value_class > symbol))
        ++symbol;
    }
    // The leading digits and how many follow.
    const int coded_class = symbol == 0 ? 0 : symbol + first;
    const int rest = symbol == 0 ? shift : std::max((coded_class >> 1) - 1, 0);
    const auto leading = static_cast<uint32_t>(symbol == 0 ? 0 : coded_class - 2 * rest);
    const uint32_t decoded = leading << rest | port.bits(rest, magnitude & ((1u << rest) - 1));
    if (decoded == 0) return 0;
    Chance& sign = signs_[static_cast<size_t>((about.sign * 3 + about.rank) * 4 + std::min(symbol, 3))];
    const bool negative = sign.code(port, residual < 0);
    return negative ? -int64_t{decoded} : int64_t{decoded};
  }

 private:
  static constexpr uint32_t kRows = 12, kSeconds = 15 * 6 * 16;
  static constexpr int kMostClass = 59;  // of residuals below 2^30

  template <class Port>
  int codeSymbol(Port& port, const Expectation& about, int level, int symbol) {
    const auto scale = static_cast<uint32_t>(level);
    const uint32_t first = (scale / 2 * 3 + static_cast<uint32_t>(about.rank)) * 4 + about.members;
    if (!two_) {
      symbol = port.symbol(firsts_[first], symbol);
    } else {
      const uint32_t second =
          (about.relative(about.spread, level, -7, 7) * 6 + about.relative(about.near, level, -3, 2)) * 16 + scale / 4;
      Distribution both;
      blend(firsts_[first], seconds_[second], 32767, both);
      symbol = port.symbol(both, symbol);
      seconds_.learn(second, symbol);
    }
    firsts_.learn(first, symbol);
    return symbol;
  }

  const bool two_;
  Habits firsts_, seconds_;
  std::array<Chance, kSigns * 3 * 4> signs_;
  std::array<Chance, 8> longer_;
};

}  // namespace tutte::values
