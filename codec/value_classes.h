#pragma once
// Adaptive coding of residuals by classes: one symbol of sixteen per residual, signs included, and plain digits. The
// distributions of one or two contexts are averaged. Fast: no decision is taken more than once per residual.

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

/// Rates of learning: at first, and what they fall to; not quite, because steps are rounded down. Each falls much as if
/// everything seen so far counted alike.
inline constexpr int kFirstRate = 65536 / 12, kLastRate = 350;

/// Where distributions go if only one symbol is seen: every other one keeps a little.
TUTTE_TABLE std::array<Distribution, kSymbols> kTargets = madeTable([] {
  constexpr int kLeast = 3;
  std::array<Distribution, kSymbols> targets{};
  for (int symbol = 0; symbol < kSymbols; ++symbol) {
    for (int i = 0; i < kSymbols - 1; ++i) {
      targets[symbol].above[i] =
          static_cast<uint16_t>(kLeast * (kSymbols - 1 - i) + (i < symbol ? 32768 - 16 * kLeast : 0));
    }
    targets[symbol].above[kSymbols - 1] = static_cast<uint16_t>(-kLastRate);
  }
  return targets;
});

/// Distributions that learn.
class Habits {
 public:
  /// `prior(i)` gives what habit i begins with.
  template <class Prior>
  Habits(uint32_t count, Prior prior) {
    habits_.reserve(count);
    for (uint32_t i = 0; i < count; ++i) habits_.push_back(prior(i));
  }

  Distribution& operator[](uint32_t habit) { return habits_[habit]; }

 private:
  std::vector<Distribution> habits_;
};

/// Classes of residuals, in ascending order: symbols 0 to 14 are -15 to -12, -11 to -8, -7 and -6, -5 and -4, -3, -2,
/// -1, 0, and the same upwards. Symbol 15 is everything else. Where large residuals are expected, the m-th below or
/// above 0 stands for 2^shift of them.
struct ResidualClass {
  int32_t least, digits;  ///< of the magnitudes less 1
  int32_t away, side;     ///< 0 for the class of 0, otherwise 1; -1 below 0, otherwise 0
};
inline constexpr int kMostDirect = 15;
inline constexpr uint32_t kZeroClass = 7;
inline constexpr std::array<ResidualClass, kSymbols> kClasses = {{{11, 2, 1, -1},
                                                                  {7, 2, 1, -1},
                                                                  {5, 1, 1, -1},
                                                                  {3, 1, 1, -1},
                                                                  {2, 0, 1, -1},
                                                                  {1, 0, 1, -1},
                                                                  {0, 0, 1, -1},
                                                                  {0, 0, 0, 0},
                                                                  {0, 0, 1, 0},
                                                                  {1, 0, 1, 0},
                                                                  {2, 0, 1, 0},
                                                                  {3, 1, 1, 0},
                                                                  {5, 1, 1, 0},
                                                                  {7, 2, 1, 0},
                                                                  {11, 2, 1, 0},
                                                                  {15, 0, 1, 0}}};

/// Where a residual is expected: in half octaves of its size, each for four fractions of the prediction; for all that
/// is larger, residuals are scaled, and the four cells are for the size's binary digits below the first.
inline constexpr int kTopLog = 6;
inline constexpr uint32_t kHalfOctaves = 2 * (kTopLog - 1), kFractions = 4;
inline constexpr uint32_t kScaledCell = kHalfOctaves * kFractions, kCells = kScaledCell + kFractions;

/// What is expected before anything was seen: residuals beyond m have the probability (4 s / (4 s + m))^4 / 2 on either
/// side, s being the expected size.
TUTTE_TABLE std::array<Distribution, kCells> kPriors = madeTable([] {
  std::array<Distribution, kCells> priors{};
  uint64_t power = 84990;  // 2^((2 h + 3/2) / 4), in 1/65536, for half octave h
  for (uint32_t cell = 0; cell < kCells; ++cell) {
    const bool scaled = cell >= kScaledCell;
    if (cell > 0 && cell % kFractions == 0) power = power * 92682 >> 16;
    if (scaled) power = uint64_t{9 + 2 * (cell % kFractions)} << (kTopLog + 12);
    uint64_t size = (power * 102 - 65536 * 51) >> 16;  // in 1/256
    if (scaled) size >>= 1;
    // In 1/8; the fractions are from -1/2 to 1/2.
    const int fraction = scaled ? 0 : 2 * static_cast<int>(cell % kFractions) - 3;
    const auto beyond = [&](int limit) {
      const uint64_t ratio = (4 * size << 16) / (4 * size + 32 * static_cast<uint64_t>(limit < 0 ? -limit : limit));
      const uint64_t square = ratio * ratio >> 16;
      const auto tail = static_cast<int>(square * square >> 18);
      return limit < 0 ? 32768 - tail : tail;
    };
    const int outside = 32768 - beyond(-8 * kMostDirect - 4 - fraction);
    int last = 32768;
    for (int i = 0; i < kSymbols - 1; ++i) {
      const int most = i < 7 ? -1 - kClasses[i].least : kClasses[i + 1].least;
      // Every symbol keeps a little.
      last = std::max(std::min(beyond(8 * most + 4 - fraction) + outside, last - 3), 3 * (kSymbols - 1 - i));
      priors[cell].above[i] = static_cast<uint16_t>(last);
    }
    priors[cell].above[kSymbols - 1] = static_cast<uint16_t>(-kFirstRate);
  }
  return priors;
});

/// All symbols are equally likely.
TUTTE_TABLE Distribution kEvenPrior = madeTable([] {
  Distribution prior;
  for (size_t i = 0; i < kSymbols; ++i) prior.above[i] = static_cast<uint16_t>(2048 * (kSymbols - 1 - i));
  prior.above[kSymbols - 1] = static_cast<uint16_t>(-kFirstRate);
  return prior;
});

/// One context (`two` false) or two. Few habits, because small meshes visit each of them seldom.
class ClassCoder {
 public:
  static constexpr bool wantsAll() { return false; }

  explicit ClassCoder(bool two)
      : two_(two),
        firsts_(kCells * kRows, [](uint32_t i) { return kPriors[i / kRows]; }),
        seconds_(
            kCoarseCells * kColumns,
            [](uint32_t i) {
              const uint32_t cell = i / kColumns;
              return kPriors[cell == kCoarseCells - 1 ? kScaledCell + 1
                                                      : cell / kFractions * kFractions * kCoarse + cell % kFractions];
            }),
        outside_(2, [](uint32_t) { return kEvenPrior; }) {}

  template <class Port>
  [[gnu::always_inline]] int32_t code(Port& port, const Expectation& about, int32_t residual) {
    const uint32_t size = Expectation::half(about.estimate) + 4;
    const int log = floorLog(size), shift = std::max(log - kTopLog, 0);
    // Upwards is where the residual is likelier to be.
    const int32_t fraction = static_cast<int32_t>((about.fraction + 8) & 15) - 8;
    const auto down = static_cast<int32_t>((16 * int64_t{about.side} + fraction) >> 63);
    const auto part = std::min(static_cast<uint32_t>(((fraction ^ down) - down + 8) >> 2), kFractions - 1);
    const uint32_t octave = static_cast<uint32_t>(2 * log) + (size >> (log - 1)) - 6;
    const bool scaled = shift > 0;
    const uint32_t cell = scaled ? kScaledCell + (size >> (log - 2)) - 4 : octave * kFractions + part;
    Distribution& first = firsts_[(cell * 3 + static_cast<uint32_t>(about.rank)) * 4 + about.members];
    Distribution& second =
        two_ ? secondOf(about, scaled ? kCoarseCells - 1 : (octave >= kCoarse) * kFractions + part, shift) : first;
    const int32_t turned = (residual ^ down) - down;
    uint32_t symbol = 0;
    if constexpr (Port::kWriting) symbol = classOf(turned, shift);
    // The average of one is that one.
    symbol = port.symbol(Parts(first, second), symbol);
    approach(first, kTargets[symbol]);
    if (two_) approach(second, kTargets[symbol]);
    if (symbol == kSymbols - 1) [[unlikely]]
      return (codeOutside(port, turned, shift) ^ down) - down;
    const ResidualClass found = kClasses[symbol];
    const int32_t least = found.least * (1 << shift) + found.away, side = found.side ^ down;
    const int digits = found.digits + (shift & -found.away);
    const uint32_t rest = port.bits(digits, static_cast<uint32_t>((residual ^ side) - side - least));
    return ((least + static_cast<int32_t>(rest)) ^ side) - side;
  }

 private:
  static constexpr uint32_t kRows = 12, kCoarse = 5, kCoarseCells = 2 * kFractions + 1;
  static constexpr uint32_t kSpreads = 7, kNears = 5, kColumns = kSpreads * kNears;
  static constexpr int kMostLength = 7;
  static constexpr int kLongest = 28;  // of residuals, in binary digits

  static int floorLog(uint32_t x) { return 31 ^ __builtin_clz(x); }

  [[gnu::always_inline]] Distribution& secondOf(const Expectation& about, uint32_t cell, int shift) {
    const uint32_t spread = lengthOf(about.spread, shift, kSpreads), near = lengthOf(about.near, shift, kNears);
    return seconds_[(cell * kSpreads + spread) * kNears + near];
  }

  static uint32_t lengthOf(int32_t size, int shift, uint32_t count) {
    return std::min(static_cast<uint32_t>(floorLog((Expectation::half(size) >> shift) + 4) - 2), count - 1);
  }

  static uint32_t classOf(int32_t turned, int shift) {
    if (turned == 0) return kZeroClass;
    const int32_t scaled = ((turned < 0 ? -turned : turned) - 1) >> shift;
    uint32_t up = 1;
    while (kZeroClass + up < kSymbols - 1 && kClasses[kZeroClass + up + 1].least <= scaled) ++up;
    return kZeroClass + up == kSymbols - 1 || turned > 0 ? kZeroClass + up : kZeroClass - up;
  }

  // Farther than the classes go: how many digits this has and to which side, and the digits.
  template <class Port>
  [[gnu::noinline]] int32_t codeOutside(Port& port, int32_t residual, int shift) {
    Distribution& habit = outside_[shift > 0];
    const int32_t below = -kMostDirect * (1 << shift) - 1, above = kMostDirect * (1 << shift) + 1;
    const auto far = static_cast<uint32_t>(residual < 0 ? below - residual : residual - above);
    const uint32_t number = (far >> shift) + 1;
    uint32_t symbol = 0;
    if constexpr (Port::kWriting) {
      symbol = 2 * static_cast<uint32_t>(std::min(floorLog(number), kMostLength)) + (residual < 0);
    }
    symbol = port.symbol(Parts(habit), symbol);
    approach(habit, kTargets[symbol]);
    auto length = static_cast<int>(symbol >> 1);
    if (length == kMostLength) {
      while (length < kLongest - shift && longer_.code(port, number >> length > 1)) ++length;
    }
    const uint32_t top = 1u << length;
    const uint32_t whole = (top | port.bits(length, number & (top - 1))) - 1;
    const auto decoded = static_cast<int32_t>(whole << shift | port.bits(shift, far & ((1u << shift) - 1)));
    return (symbol & 1) != 0 ? below - decoded : above + decoded;
  }

  const bool two_;
  Habits firsts_, seconds_, outside_;
  Chance longer_;
};

}  // namespace tutte::values
