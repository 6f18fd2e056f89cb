#pragma once
// Adaptive coding of residuals by classes: one symbol of sixteen per residual, signs included, and plain digits. The
// distributions of one or two contexts are averaged. Fast: no decision is taken more than once per residual.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
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
  /// What they begin with, `rows` times. Copied row by row, since a plane of a few values takes less time than this.
  Habits(uint32_t rows, std::span<const Distribution> priors) {
    habits_.reserve(rows * priors.size());
    for (; rows > 0; --rows) habits_.insert(habits_.end(), priors.begin(), priors.end());
  }

  Distribution& operator[](uint32_t habit) { return habits_[habit]; }

 private:
  std::vector<Distribution> habits_;
};

/// Classes of residuals, in ascending order: symbols 0 to 14 are -15 to -12, -11 to -8, -7 and -6, -5 and -4, -3, -2,
/// -1, 0, and the same upwards. Symbol 15 is everything else. Where large residuals are expected, the m-th below or
/// above 0 stands for 2^shift of them: those of a class begin at `least` * 2^shift, or above 0 at 1 more.
struct ResidualClass {
  int8_t least;
  uint8_t above;   ///< 1 above 0
  uint8_t digits;  ///< binary ones of the number within the class
  uint8_t scaled;  ///< all bits are set if they become `shift` more
};
inline constexpr int kMostDirect = 15;
inline constexpr uint32_t kZeroClass = 7;
inline constexpr std::array<ResidualClass, kSymbols> kClasses = {{{-15, 0, 2, 255},
                                                                  {-11, 0, 2, 255},
                                                                  {-7, 0, 1, 255},
                                                                  {-5, 0, 1, 255},
                                                                  {-3, 0, 0, 255},
                                                                  {-2, 0, 0, 255},
                                                                  {-1, 0, 0, 255},
                                                                  {0, 0, 0, 0},
                                                                  {0, 1, 0, 255},
                                                                  {1, 1, 0, 255},
                                                                  {2, 1, 0, 255},
                                                                  {3, 1, 1, 255},
                                                                  {5, 1, 1, 255},
                                                                  {7, 1, 2, 255},
                                                                  {11, 1, 2, 255},
                                                                  {15, 1, 0, 255}}};

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
      const int most = i < 7 ? kClasses[i + 1].least - 1 : kClasses[i + 1].least;
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

/// Which distributions suit an expected size.
struct SizeCell {
  uint8_t first, second;  ///< the first cell, and the first coarse one
  uint8_t fractions;      ///< 3: the next three are for other fractions; 0: there is one
  uint8_t shift;          ///< residuals are scaled by 2^shift
};
inline constexpr uint32_t kCoarse = 5, kCoarseCells = 2 * kFractions + 1;  // half octaves; cells

/// By a size's logarithm, four steps per octave, from that of 4 eighths on.
TUTTE_TABLE std::array<SizeCell, 4 * 28> kSizeCells = madeTable([] {
  std::array<SizeCell, 4 * 28> cells{};
  for (uint32_t i = 0; i < cells.size(); ++i) {
    const uint32_t octave = i / 4, top = kTopLog - 1;
    const auto shift = static_cast<uint8_t>(octave < top ? 0 : octave + 1 - top);
    const auto first = static_cast<uint8_t>(shift == 0 ? i / 2 * kFractions : kScaledCell + i % 4);
    const auto second = static_cast<uint8_t>(shift == 0 ? (i / 2 >= kCoarse) * kFractions : kCoarseCells - 1);
    cells[i] = {first, second, static_cast<uint8_t>(shift == 0 ? kFractions - 1 : 0), shift};
  }
  return cells;
});

/// What coarse cells begin with.
TUTTE_TABLE std::array<Distribution, kCoarseCells> kCoarsePriors = madeTable([] {
  std::array<Distribution, kCoarseCells> priors{};
  for (uint32_t cell = 0; cell < kCoarseCells; ++cell) {
    const uint32_t fine = cell / kFractions * kFractions * kCoarse + cell % kFractions;
    priors[cell] = kPriors[cell == kCoarseCells - 1 ? kScaledCell + 1 : fine];
  }
  return priors;
});

/// With one context or two. Few habits, because small meshes visit each of them seldom.
class ClassCoder {
 public:
  ClassCoder() : firsts_(kRows, kPriors), seconds_(kColumns, kCoarsePriors), outside_(2, std::span(&kEvenPrior, 1)) {}

  template <class Port>
  [[gnu::always_inline]] int32_t code(Port& port, const Expectation& about, int32_t residual, bool two) {
    const uint32_t size = Expectation::half(about.estimate) + 4;
    const int log = floorLog(size);
    const SizeCell& cell = kSizeCells[static_cast<uint32_t>(4 * log) + (size >> (log - 2)) - 12];
    const int shift = cell.shift;
    const uint32_t part = about.fraction >> 2 & cell.fractions;
    Distribution& first = firsts_[(static_cast<uint32_t>(about.rank) * 4 + about.members) * kCells + cell.first + part];
    Distribution& second = two ? seconds_[columnOf(about, shift) + cell.second + part] : first;
    uint32_t symbol = 0;
    if constexpr (Port::kWriting) symbol = classOf(residual, shift);
    // The average of one is that one.
    symbol = port.symbol(Parts(first, second), symbol);
    approach(first, kTargets[symbol]);
    if (two) approach(second, kTargets[symbol]);
    if (symbol == kSymbols - 1) [[unlikely]]
      return codeOutside(port, residual, shift);
    const ResidualClass& found = kClasses[symbol];
    const int32_t least = found.least * (1 << shift) + found.above;
    const uint32_t rest = port.bits(found.digits + (shift & found.scaled), static_cast<uint32_t>(residual - least));
    return least + static_cast<int32_t>(rest);
  }

 private:
  static constexpr uint32_t kRows = 12;
  static constexpr int kSpreads = 7, kNears = 5;
  static constexpr uint32_t kColumns = kSpreads * kNears;
  static constexpr int kMostLength = 7;
  static constexpr int kLongest = 28;  // of residuals, in binary digits

  static int floorLog(uint32_t x) { return 31 ^ __builtin_clz(x); }

  /// The first of the coarse cells for what neighbours and predictions say about a component.
  [[gnu::always_inline]] static uint32_t columnOf(const Expectation& about, int shift) {
    return static_cast<uint32_t>(lengthOf(about.spread, shift, kSpreads) * kNears +
                                 lengthOf(about.near, shift, kNears)) *
           kCoarseCells;
  }

  static int lengthOf(int32_t size, int shift, int count) {
    return std::min(floorLog((Expectation::half(size) >> shift) + 4) - 2, count - 1);
  }

  static uint32_t classOf(int32_t residual, int shift) {
    if (residual == 0) return kZeroClass;
    const int32_t scaled = ((residual < 0 ? -residual : residual) - 1) >> shift;
    uint32_t up = 1;
    while (kZeroClass + up < kSymbols - 1 && kClasses[kZeroClass + up + 1].least <= scaled) ++up;
    return kZeroClass + up == kSymbols - 1 || residual > 0 ? kZeroClass + up : kZeroClass - up;
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

  Habits firsts_, seconds_, outside_;
  Chance longer_;
};

}  // namespace tutte::values
