#pragma once
// One site's floats in either direction; numeral_values.h tells what they are.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>

#include "codec/apart.h"
#include "codec/numeral_differences.h"
#include "codec/numeral_reader.h"
#include "codec/numeral_stencil.h"
#include "codec/numeral_steps.h"
#include "codec/numeral_values.h"
#include "codec/value_geometry.h"
#include "codec/value_model.h"
#include "codec/value_scale.h"
#include "codec/value_surroundings.h"

namespace tutte::numerals {

/// Nine symbols are equally likely; the others keep as little as they can.
TUTTE_TABLE values::Distribution kNinths = madeTable([] {
  values::Distribution ninths;
  for (uint32_t i = 0; i < 15; ++i) {
    ninths.above[i] = static_cast<uint16_t>(i < 8 ? (32768 - 7) / 9 * (8 - i) + 7 : 15 - i);
  }
  return ninths;
});

/// All sites' floats, in the order of the sites.
template <class Port>
class SiteCoder {
 public:
  SiteCoder(Port& port, const ValueGraph& graph, const NumeralFormat& format)
      : port_(port),
        format_(format),
        count_(format.components),
        steps_{Steps(format.systems[0]), Steps(format.systems[1]), Steps(format.systems[2]), Steps(format.systems[3])},
        finder_(graph, {.beside = true, .far = false}),
        nodes_(graph.siteCount()),
        stencil_(nodes_),
        scale_(count_, kFirstError),
        differences_(port) {
    limit_ = eachOf([&](size_t i) { return i < static_cast<size_t>(count_) ? steps_[i].limit() : 0; });
    deviation_ = 16 * static_cast<int32_t>(format.systems[0].power(format.systems[0].spare()));
  }

  /// The next site's. A writer takes the floats' bits from `floats`, a reader stores them there.
  TUTTE_APART void code(std::span<uint32_t> floats) {
    stencil_.gather(finder_.next(), value_);
    scale_.estimate(stencil_.neighbour_count, stencil_.error_sum);
    prepare();
    for (int rank = 0; rank < count_; ++rank) {
      const auto i = static_cast<size_t>(order_[rank]);
      codeComponent(i, rank == solved_rank_, floats[i]);
      const int32_t off = value_[i] - stencil_.base[i];
      error_[i] = std::min(off < 0 ? -off : off, kLargestError);
      weighed_ = (rank == 0 ? error_[i] : weighed_ >> 1) + error_[i];
    }
    nodes_.add({value_, error_});
    scale_.adapt(error_);
  }

  /// True when the bytes held what no encoder writes.
  bool damaged() const { return damaged_; }

 private:
  static constexpr int32_t kFirstError = 1 << 20;
  static constexpr int64_t kLargestNumber = int64_t{1} << 44;

  // Which component comes when, and what is known of all of them.
  void prepare() {
    const Row& near = scale_.near();
    const int32_t all = scale_.all(), several = stencil_.member_count > 1 ? -1 : 0;
    spread_ = eachOf([&](size_t i) { return std::min(stencil_.spread[i], kLargestError); });
    share_ = eachOf([&](size_t i) { return all + near[i] + (4 * spread_[i] & several); });
    share_digits_ = 2 - several;
    order_ = {0, 1, 2, 3};
    weighed_ = all + near[0];
    if (format_.relation == Relation::kNone) return;
    // The largest of the related components comes last of them: it follows best from the others.
    solved_rank_ = format_.relation == Relation::kUnitVector ? 2 : count_ - 1;
    int largest = 0;
    for (int i = 1; i <= solved_rank_; ++i) {
      if (std::abs(stencil_.base[i]) > std::abs(stencil_.base[largest])) largest = i;
    }
    std::swap(order_[largest], order_[solved_rank_]);
    weighed_ = all + near[order_[0]];
  }

  // What the others leave for component i.
  int64_t solve(size_t i) const {
    const NumeralSystem& system = format_.systems[0];
    const int64_t one = system.power(system.spare() - system.top);
    int64_t sum = 0, squares = 0;
    for (int rank = 0; rank < solved_rank_; ++rank) {
      const int64_t value = value_[order_[rank]];
      sum += value;
      squares += value * value;
    }
    if (format_.relation == Relation::kUnitSum) return one - sum;
    const int64_t rest = one * one - squares;
    const int64_t root = rest > 0 ? static_cast<int64_t>(values::squareRoot(static_cast<uint64_t>(rest))) : 0;
    return stencil_.base[i] < 0 ? -root : root;
  }

  [[gnu::always_inline]] void codeComponent(size_t i, bool solved, uint32_t& bits) {
    const int32_t limit = limit_[i];
    const auto prediction =
        solved ? static_cast<int32_t>(std::clamp<int64_t>(solve(i), -limit, limit)) : stencil_.base[i];
    const int32_t estimate = std::min(solved ? deviation_ / 16 : (share_[i] + weighed_) >> share_digits_, limit);
    const Step& step = steps_[i].stepFor(std::min(std::abs(prediction) + estimate, limit));
    DifferenceContext about;
    about.kind = solved ? kSolved : static_cast<uint32_t>(i);
    about.sure = stencil_.member_count > 1;
    const int size = quarterLog(step.widened(estimate));
    about.size = size - step.log;
    about.spread = solved ? 0 : octave(step.widened(spread_[i])) - size / 4;
    about.near = octave(step.widened(scale_.near()[i])) - size / 4;
    value_[i] = codeFloat(i, step, prediction, about, bits);
    if (solved) adaptDeviation(std::abs(value_[i] - prediction));
  }

  void adaptDeviation(int32_t off) {
    const int64_t now = std::min(int64_t{16} * std::min(off, kLargestError), int64_t{4} * deviation_);
    deviation_ = std::max(deviation_ + static_cast<int32_t>((now - deviation_) >> 5), 1);
  }

  // Returns the value in the system's units.
  [[gnu::always_inline]] int32_t codeFloat(size_t i, const Step& step, int32_t prediction,
                                           const DifferenceContext& about, uint32_t& bits) {
    const int64_t guess = steps_[i].nearest(prediction, step);
    std::optional<Numeral> numeral;
    int64_t difference = Port::kWriting ? kNoDifference : 0;
    if constexpr (Port::kWriting) {
      numeral = numeralOf(format_.systems[i], bits & 0x7FFFFFFF);
      const auto number = numeral ? stepsOf(format_.systems[i], *numeral, step.x, bits >> 31) : std::nullopt;
      if (number) difference = *number - guess;
    }
    difference = differences_.code(about, difference);
    if (difference == kNoDifference) return codePlain(bits), std::clamp(prediction, -limit_[i], limit_[i]);
    const int64_t number = guess + difference;
    if (number == 0) return codeZero(i, bits), 0;
    return codeNumber(i, step, number, numeral, bits);
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
  [[gnu::always_inline]] int32_t codeNumber(size_t i, const Step& step, int64_t number,
                                            const std::optional<Numeral>& numeral, uint32_t& bits) {
    const NumeralSystem& system = format_.systems[i];
    const int64_t magnitude = std::abs(number);
    const uint32_t sign = number < 0 ? 0x80000000u : 0u;
    if (magnitude >= steps_[i].beyond()) [[unlikely]] {
      const auto whole = shortened(system, magnitude, step.x);
      if (!whole) return damage(bits);
      bits = system.floatOf(*whole) | sign;
      return step.inUnits(number);
    }
    if (step.x > system.least) {
      const Numeral result = codeTrailing(i, magnitude, step.x, numeral);
      bits = system.floatOf(result) | sign;
      return number < 0 ? -system.fixed(result) : system.fixed(result);
    }
    bits = system.floatOf({static_cast<uint32_t>(magnitude), step.x}) | sign;
    return step.inUnits(number);
  }

  // A number of steps that has too many digits.
  static std::optional<Numeral> shortened(const NumeralSystem& system, int64_t magnitude, int x) {
    if (magnitude >= kLargestNumber) return {};
    const int extra = system.digitsOf(magnitude) - system.digits;
    const int64_t scale = system.power(extra);
    if (magnitude % scale != 0 || x + extra > system.top) return {};
    return Numeral{static_cast<uint32_t>(magnitude / scale), x + extra};
  }

  // Zeros are likely behind zeros: many numbers have fewer digits than they could.
  Numeral codeTrailing(size_t i, int64_t magnitude, int x, const std::optional<Numeral>& numeral) {
    const NumeralSystem& system = format_.systems[i];
    auto n = static_cast<uint32_t>(magnitude);
    size_t zeros = 1;
    const int count = std::min(system.digits - system.digitsOf(magnitude), x - system.least);
    for (int at = 0; at < count; ++at) {
      const auto digit = static_cast<uint32_t>(numeral ? numeral->n / system.power(count - at - 1) % system.radix : 0);
      const size_t place = (i * kDepths + static_cast<size_t>(at)) * 2 + zeros;
      const uint32_t coded = codeDigit(system, trailing_[place], digit);
      n = n * static_cast<uint32_t>(system.radix) + coded;
      zeros &= coded == 0;
    }
    return {n, x - count};
  }

  uint32_t codeDigit(const NumeralSystem& system, values::Chance& zero, uint32_t digit) {
    if (zero.code(port_, digit == 0)) return 0;
    return system.radix == 2 ? 1 : 1 + port_.symbol(values::Parts(kNinths), digit - 1) % 9;
  }

  void codeZero(size_t i, uint32_t& bits) {
    if (zeros_[2 * i].code(port_, bits == 0)) {
      bits = 0;
    } else if (zeros_[2 * i + 1].code(port_, bits == 0x80000000u)) {
      bits = 0x80000000u;
    } else {
      codePlain(bits);
    }
  }

  void codePlain(uint32_t& bits) {
    const uint32_t high = port_.bits(16, bits >> 16);
    bits = high << 16 | port_.bits(16, bits & 0xFFFF);
  }

  int32_t damage(uint32_t& bits) {
    damaged_ = true;
    bits = 0;
    return 0;
  }

  static constexpr size_t kDepths = NumeralSystem::kMostBinary;

  Port& port_;
  const NumeralFormat& format_;
  const int count_;
  const std::array<Steps, kMostComponents> steps_;
  values::SurroundingsFinder finder_;
  Nodes nodes_;
  Stencil stencil_;
  values::ErrorScale<kMostComponents> scale_;
  DifferenceCoder<Port> differences_;
  std::array<values::Chance, 2 * kMostComponents> zeros_;
  std::array<values::Chance, kMostComponents * kDepths * 2> trailing_;
  Row limit_;
  int32_t deviation_;  // of solved components from what the others leave, in 1/16
  bool damaged_ = false;

  // Of the current site.
  Row value_{}, error_{};
  Row spread_, share_;
  std::array<int, kMostComponents> order_;
  int solved_rank_ = -1, share_digits_ = 2;
  int32_t weighed_ = 0;  // the errors of the components so far
};

}  // namespace tutte::numerals
