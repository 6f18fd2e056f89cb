#pragma once
// One site's floats in either direction; numeral_values.h tells what they are.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/numeral_differences.h"
#include "codec/numeral_reader.h"
#include "codec/numeral_stencil.h"
#include "codec/numeral_values.h"
#include "codec/value_geometry.h"
#include "codec/value_model.h"

namespace tutte::numerals {

/// All sites' floats, in the order of the calls.
template <class Port>
class SiteCoder {
 public:
  SiteCoder(Port& port, const ValueGraph& graph, const NumeralFormat& format)
      : port_(port),
        format_(format),
        count_(format.components),
        stencil_(graph, count_),
        differences_(port),
        trailing_(size_t(count_) * kTrailing) {
    solved_error_ = 16 * format.systems[0].power(format.systems[0].spare());
  }

  /// A writer takes the floats' bits from `floats`, a reader stores them there.
  void code(Index site, std::span<uint32_t> floats) {
    stencil_.gather(site);
    Node& node = stencil_.node(site);
    prepare();
    int64_t so_far = 0;
    for (int rank = 0; rank < count_; ++rank) {
      const int i = order_[rank];
      const bool solved = rank == solved_rank_;
      const int64_t prediction = solved ? solve(i, node) : base_[i];
      const int64_t estimate = solved ? solved_error_ : estimateOf(i, rank, so_far);
      node.value[i] = codeComponent(i, solved, prediction, estimate, floats[i]);
      const int64_t off = std::abs(node.value[i] * kOne - (solved ? prediction : base_[i]));
      if (solved) solved_error_ = std::max<int64_t>(adapted(solved_error_, off), 1);
      const int64_t error = std::min(solved ? std::abs(node.value[i] * kOne - base_[i]) : off, kLargestError);
      node.error[i] = static_cast<uint32_t>(error);
      so_far += error;
    }
    node.known = true;
    stencil_.remember(site);
    typical_error_ = std::max<int64_t>(adapted(typical_error_, so_far / count_), 16);
  }

  /// True when the bytes held what no encoder writes.
  bool damaged() const { return damaged_; }

 private:
  static constexpr int64_t kOne = 16, kLargestError = 1 << 30, kLargestSteps = int64_t{1} << 44;
  static constexpr int kDepths = 24, kTrailing = kDepths * 2;

  static int64_t adapted(int64_t typical, int64_t now) {
    return typical + ((std::min(now, 4 * typical) - typical) >> 5);
  }

  // Which component comes when, and the predictions within their limits.
  void prepare() {
    all_error_ = 0;
    for (int i = 0; i < count_; ++i) {
      const NumeralSystem& system = format_.systems[i];
      const int64_t limit = (system.power(system.digits + system.spare()) - 1) * kOne;
      base_[i] = std::clamp(stencil_.base()[i], -limit, limit);
      near_error_[i] = stencil_.hasNeighbours() ? stencil_.meanError(i) : typical_error_;
      all_error_ += near_error_[i];
      order_[i] = i;
    }
    all_error_ /= count_;
    if (format_.relation == Relation::kNone) return;
    // The largest of the related components comes last of them: it follows best from the others.
    solved_rank_ = format_.relation == Relation::kUnitVector ? 2 : count_ - 1;
    int largest = 0;
    for (int i = 1; i <= solved_rank_; ++i) {
      if (std::abs(base_[i]) > std::abs(base_[largest])) largest = i;
    }
    std::swap(order_[largest], order_[solved_rank_]);
  }

  // What the others leave for component i.
  int64_t solve(int i, const Node& node) const {
    const NumeralSystem& system = format_.systems[0];
    const int64_t one = system.power(system.spare() - system.top);
    int64_t sum = 0, squares = 0;
    for (int rank = 0; rank < solved_rank_; ++rank) {
      const int64_t value = node.value[order_[rank]];
      sum += value;
      squares += value * value;
    }
    if (format_.relation == Relation::kUnitSum) return (one - sum) * kOne;
    const int64_t rest = one * one - squares;
    const int64_t root = rest > 0 ? static_cast<int64_t>(values::squareRoot(static_cast<uint64_t>(rest))) : 0;
    return base_[i] < 0 ? -root * kOne : root * kOne;
  }

  int64_t estimateOf(int i, int rank, int64_t so_far) const {
    const int64_t all = all_error_, near = near_error_[i], spread = stencil_.spread()[i];
    int64_t estimate = (2 * all + near) / 3;
    if (rank == 1) estimate = (all + near + 2 * so_far) / 4;
    if (rank > 1) estimate = (all + near + so_far) / (rank + 2);
    if (stencil_.members() > 1) return (estimate + spread) / 2;
    if (stencil_.members() == 1) return (7 * estimate + std::min(spread, 2 * estimate)) / 8;
    return estimate;
  }

  // Steps are as long as those of the largest number that is expected. Returns the value in the system's units.
  int32_t codeComponent(int i, bool solved, int64_t prediction, int64_t estimate, uint32_t& bits) {
    const NumeralSystem& system = format_.systems[i];
    const int64_t limit = system.power(system.digits + system.spare()) - 1;
    prediction = std::clamp(prediction, -limit * kOne, limit * kOne);
    estimate = std::min(estimate, limit * kOne);
    const int64_t extent = std::min(std::abs(prediction) / kOne + estimate / kOne, limit);
    const int all_digits = system.digits + system.spare();
    const int finer = std::clamp(all_digits - system.digitsOf(extent), 0, system.top - system.least);
    const int x = system.top - finer;
    const auto steps = [&](int64_t value, int64_t unit) {
      const int up = finer - system.spare();
      return up >= 0 ? divideRounded(value * system.power(up), unit) : divideRounded(value, unit * system.power(-up));
    };
    const int64_t expected = steps(estimate, 1), guess = steps(prediction, kOne);

    std::optional<Numeral> numeral;
    std::optional<int64_t> count;
    if constexpr (Port::kWriting) {
      numeral = numeralOf(system, bits & 0x7FFFFFFF);
      if (numeral) count = stepsOf(system, *numeral, x, bits >> 31);
    }
    if (escapes_[i].code(port_, !count)) return codePlain(bits), plainValue(prediction);
    const int64_t number = guess + differences_.code(contextOf(i, solved, expected, steps), count ? *count - guess : 0);
    if (std::abs(number) >= kLargestSteps) return damage(bits);
    if (number == 0) return codeZero(i, bits), plainValue(0);
    return codeNumber(i, x, number, numeral, bits);
  }

  template <class Steps>
  auto contextOf(int i, bool solved, int64_t expected, Steps steps) const {
    typename DifferenceCoder<Port>::Context context;
    const int size = values::quarterLog(small(expected >> 1));
    const int64_t spread = std::min<int64_t>(stencil_.spread()[i], kLargestError);
    const int apart = solved ? size : values::quarterLog(small(steps(spread, 2)));
    context.kind = solved ? 4 : i;
    context.expected = std::min(values::bitLength(small(expected * 3 >> 6)), 31);
    context.size = static_cast<uint32_t>(std::min(size / 2, 63));
    context.ratio = static_cast<uint32_t>(std::clamp((apart - size) / 2, -7, 7) + 7);
    context.members = static_cast<uint32_t>(std::min(stencil_.members(), 3));
    return context;
  }

  /// A number in steps of radix^x, rounded towards zero; nothing when there would be too many.
  static std::optional<int64_t> stepsOf(const NumeralSystem& system, const Numeral& numeral, int x, bool negative) {
    const int up = numeral.x - x;
    if (up > (system.radix == 2 ? 18 : 4)) return {};
    const int64_t count = up >= 0               ? numeral.n * system.power(up)
                          : -up > system.digits ? 0
                                                : numeral.n / system.power(-up);
    return negative ? -count : count;
  }

  // Digits that are smaller than a step follow; of numbers that are larger than expected, the last digits must be zero.
  int32_t codeNumber(int i, int x, int64_t number, std::optional<Numeral> numeral, uint32_t& bits) {
    const NumeralSystem& system = format_.systems[i];
    int64_t magnitude = std::abs(number);
    const int extra = system.digitsOf(magnitude) - system.digits;
    if (extra > 0) {
      const int64_t scale = system.power(extra);
      if (magnitude % scale != 0 || x + extra > system.top) return damage(bits);
      magnitude /= scale;
      x += extra;
    }
    for (int depth = std::min(-extra, x - system.least), zeros = 1, at = 0; depth > 0; --depth, --x, ++at) {
      const auto digit = static_cast<uint32_t>(numeral ? numeral->n / system.power(depth - 1) % system.radix : 0);
      const uint32_t coded = codeDigit(system, trailing_[(i * kDepths + at) * 2 + zeros], digit);
      magnitude = magnitude * system.radix + coded;
      zeros &= coded == 0;
    }
    const Numeral result{static_cast<uint32_t>(magnitude), x};
    const auto magnitude_bits = system.floatOf(result);
    if (!magnitude_bits) return damage(bits);
    bits = *magnitude_bits | (number < 0 ? 0x80000000u : 0u);
    return number < 0 ? -system.fixed(result) : system.fixed(result);
  }

  // Zeros are likely behind zeros: many numbers have fewer digits than they could.
  uint32_t codeDigit(const NumeralSystem& system, values::Chance& zero, uint32_t digit) {
    if (zero.code(port_, digit == 0)) return 0;
    return system.radix == 2 ? 1 : 1 + port_.uniform(9, digit - 1);
  }

  void codeZero(int i, uint32_t& bits) {
    if (zeros_[2 * i].code(port_, bits == 0)) {
      bits = 0;
    } else if (zeros_[2 * i + 1].code(port_, bits == 0x80000000u)) {
      bits = 0x80000000u;
    } else {
      codePlain(bits);
    }
  }

  void codePlain(uint32_t& bits) {
    const uint32_t high = port_.uniform(0x10000, bits >> 16);
    bits = high << 16 | port_.uniform(0x10000, bits & 0xFFFF);
  }

  static int32_t plainValue(int64_t prediction) { return static_cast<int32_t>(prediction / kOne); }

  int32_t damage(uint32_t& bits) {
    damaged_ = true;
    bits = 0;
    return 0;
  }

  static uint32_t small(int64_t x) { return static_cast<uint32_t>(std::min<int64_t>(x, 0x7FFFFFF0)); }

  Port& port_;
  const NumeralFormat& format_;
  const int count_;
  Stencil stencil_;
  DifferenceCoder<Port> differences_;
  std::array<values::Chance, kMostComponents> escapes_{values::Chance(1024), values::Chance(1024), values::Chance(1024),
                                                       values::Chance(1024)};
  std::array<values::Chance, 2 * kMostComponents> zeros_;
  std::vector<values::Chance> trailing_;
  int64_t typical_error_ = 1 << 24, solved_error_ = 16;
  bool damaged_ = false;

  // Of the current site.
  std::array<int, kMostComponents> order_{};
  int solved_rank_ = -1;
  Row base_{}, near_error_{};
  int64_t all_error_ = 0;
};

}  // namespace tutte::numerals
