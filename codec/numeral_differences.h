#pragma once
// Differences between numbers and what was expected of them.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "codec/made_table.h"
#include "codec/value_classes.h"
#include "codec/value_lanes.h"

namespace tutte::numerals {

/// What is known about a difference. Sizes of m are told by logarithms of 2 m + 1.
struct DifferenceContext {
  uint32_t kind = 0;  ///< the component, or kSolved
  bool sure = false;
  int size = 0;    ///< of the difference that is expected, four steps per octave
  int spread = 0;  ///< of the disagreement of predictions, in octaves from that on
  int near = 0;    ///< of the neighbours' errors, alike
};
inline constexpr uint32_t kKinds = 5, kSolved = 4;
inline constexpr int64_t kNoDifference = INT64_MIN;  ///< what has none

inline constexpr uint32_t kCells = 19, kMostSmall = 3;
inline constexpr int kFirstRate = 14000, kLastRate = 1300;

/// What is expected before anything was seen: magnitudes of m and more have the probability (3 s / (3 s + m))^3, s
/// being the expected size, and everything keeps a little.
TUTTE_TABLE std::array<values::Distribution, kCells> kLengthPriors = madeTable([] {
  std::array<values::Distribution, kCells> priors{};
  uint64_t power = 77936;  // 2^(1/4 + cell / 2), in 1/65536
  for (values::Distribution& prior : priors) {
    const uint64_t size = (power - 65536) * 3 >> 9;  // three times, in 1/256
    uint64_t last = 32768;
    for (uint32_t i = 0; i < 15; ++i) {
      const uint64_t ratio = (size << 16) / (size + (uint64_t{256} << i) - 128);
      const uint64_t beyond = ((ratio * ratio >> 16) * ratio >> 16) * 32112 / 65536 + 656;
      last = std::max<uint64_t>(std::min(beyond, last - 3), 3 * (15 - i));
      prior.above[i] = static_cast<uint16_t>(last);
    }
    prior.above[15] = static_cast<uint16_t>(-kFirstRate);
    power = power * 92682 >> 16;
  }
  return priors;
});

/// By the number of digits below the first: these and the sign are equally likely.
TUTTE_TABLE std::array<values::Distribution, kMostSmall> kSmallPriors = madeTable([] {
  std::array<values::Distribution, kMostSmall> priors{};
  for (uint32_t digits = 0; digits < kMostSmall; ++digits) {
    const uint32_t count = 2u << digits;
    for (uint32_t i = 0; i < 15; ++i) {
      const uint32_t above = i + 1 < count ? 32768 / count * (count - 1 - i) : 0;
      priors[digits].above[i] = static_cast<uint16_t>(std::max(above, 3 * (15 - i)));
    }
    priors[digits].above[15] = static_cast<uint16_t>(-kFirstRate);
  }
  return priors;
});

/// values::kTargets, at a higher last rate.
TUTTE_TABLE std::array<values::Distribution, values::kSymbols> kLengthTargets = madeTable([] {
  std::array<values::Distribution, values::kSymbols> targets = values::kTargets;
  for (values::Distribution& target : targets) target.above[15] = static_cast<uint16_t>(-kLastRate);
  return targets;
});

/// Differences below 2^55. Their bit lengths are symbols: 0, or one of fourteen of which the expected one is about the
/// tenth, or whatever is longer or shorter. The sign and the digits below the first are plain, but where a component
/// nearly follows from others, small differences are symbols, too.
template <class Port>
class DifferenceCoder {
 public:
  explicit DifferenceCoder(Port& port)
      : port_(port),
        firsts_(kKinds * 2, kLengthPriors),
        seconds_(kSpreads * kNears, kLengthPriors),
        small_(1, kSmallPriors),
        outside_(kKinds + kNone / 4, std::span(&values::kEvenPrior, 1)) {}

  /// kNoDifference is coded, too.
  [[gnu::always_inline]] int64_t code(const DifferenceContext& about, int64_t difference) {
    const uint64_t magnitude = difference < 0 ? -static_cast<uint64_t>(difference) : static_cast<uint64_t>(difference);
    int length = static_cast<int>(std::bit_width(magnitude));
    const int below = std::max((about.size >> 2) - kBelow, 0);
    uint32_t symbol = 0;
    if constexpr (Port::kWriting) {
      const bool inside = length > below && length <= below + kInside;
      symbol = inside ? static_cast<uint32_t>(length - below) : length == 0 ? 0 : kOutside;
    }
    symbol = codeLength(about, symbol);
    if (symbol == 0) return 0;
    length = below + static_cast<int>(symbol);
    if (symbol == kOutside) [[unlikely]] {
      length = codeOutside(about.kind, static_cast<int>(std::bit_width(magnitude)));
      if (length == 0) return 0;
      if (length >= kNone) return kNoDifference;
    }
    if (about.kind == kSolved && length <= static_cast<int>(kMostSmall)) return codeSmall(length, difference);
    return codeDigits(length, difference < 0, magnitude);
  }

 private:
  using Distribution = values::Distribution;
  static constexpr int kBelow = 9, kInside = 14;
  static constexpr uint32_t kOutside = 15;
  static constexpr int kNone = 56;  // from this length on, there is no difference
  static constexpr uint32_t kSpreads = 8, kNears = 4;

  [[gnu::always_inline]] uint32_t codeLength(const DifferenceContext& about, uint32_t symbol) {
    const auto cell = std::min(static_cast<uint32_t>(about.size) / 2, kCells - 1);
    const auto spread = static_cast<uint32_t>(std::clamp(about.spread + 5, 0, static_cast<int>(kSpreads) - 1));
    const auto near = static_cast<uint32_t>(std::clamp(about.near + 2, 0, static_cast<int>(kNears) - 1));
    Distribution& first = firsts_[(about.kind * 2 + about.sure) * kCells + cell];
    Distribution& second = seconds_[(spread * kNears + near) * kCells + cell];
    symbol = port_.symbol(values::Parts(first, second), symbol);
    approach(first, kLengthTargets[symbol]);
    approach(second, kLengthTargets[symbol]);
    return symbol;
  }

  uint32_t codeSymbol(Distribution& habit, uint32_t symbol) {
    symbol = port_.symbol(values::Parts(habit), symbol);
    approach(habit, kLengthTargets[symbol]);
    return symbol;
  }

  // Four lengths together.
  [[gnu::noinline]] int codeOutside(uint32_t kind, int length) {
    const auto wanted = static_cast<uint32_t>(std::min(length, kNone));
    const uint32_t four = codeSymbol(outside_[kind], wanted / 4);
    if (four >= kNone / 4) return kNone;
    return static_cast<int>(4 * four + codeSymbol(outside_[kKinds + four], wanted % 4) % 4);
  }

  // The sign stands above the digits below the first.
  [[gnu::noinline]] int64_t codeSmall(int length, int64_t difference) {
    const auto digits = static_cast<uint32_t>(length - 1);
    const uint32_t mask = (1u << digits) - 1;
    const auto magnitude = static_cast<uint32_t>(difference < 0 ? -difference : difference);
    const uint32_t symbol = codeSymbol(small_[digits], uint32_t{difference < 0} << digits | (magnitude & mask));
    const int64_t decoded = mask + 1 + (symbol & mask);
    return (symbol >> digits & 1) != 0 ? -decoded : decoded;
  }

  // The sign stands below them.
  [[gnu::always_inline]] int64_t codeDigits(int length, bool negative, uint64_t magnitude) {
    const uint64_t first = uint64_t{1} << (length - 1);
    const uint64_t wanted = (magnitude & (first - 1)) << 1 | uint64_t{negative};
    uint64_t digits = 0;
    int rest = length;
    if (rest > kTogether) {
      digits = port_.bits(rest - kTogether, static_cast<uint32_t>(wanted >> kTogether));
      rest = kTogether;
    }
    digits = digits << rest | port_.bits(rest, static_cast<uint32_t>(wanted));
    const int64_t sign = -static_cast<int64_t>(digits & 1);
    return (static_cast<int64_t>(first | digits >> 1) ^ sign) - sign;
  }
  static constexpr int kTogether = 24;

  Port& port_;
  values::Habits firsts_, seconds_, small_, outside_;
};

}  // namespace tutte::numerals
