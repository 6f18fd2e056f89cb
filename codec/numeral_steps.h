#pragma once
// The steps in which numbers are coded: as long as those of the largest number that is expected.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "codec/numerals.h"

namespace tutte::numerals {

/// A step: 1 / `up`, or `unit`, of the units of predictions. One of both is 1.
struct Step {
  int32_t up = 1, unit = 1;
  int shift = 0;  ///< binary: `unit` is 2^shift
  int x = 0;      ///< the step is radix^x
  int log = 0;    ///< of widened(0)

  /// 8 m + 4 for a size of m steps, times their number of units.
  int64_t widened(int32_t size) const { return int64_t{8} * up * size + int64_t{4} * unit; }

  /// A number of steps in units, rounded towards zero.
  int32_t inUnits(int64_t number) const {
    return up == 1 ? static_cast<int32_t>(number) * unit : static_cast<int32_t>(number / up);
  }
};

/// The binary logarithm of a positive number, rounded down.
inline int octave(int64_t number) { return static_cast<int>(std::bit_width(static_cast<uint64_t>(number))) - 1; }

/// Four times the binary logarithm of a number from 4 on, roughly.
inline int quarterLog(int64_t number) {
  const int high = octave(number);
  return 4 * high + static_cast<int>(number >> (high - 2) & 3);
}

/// All steps of one system.
class Steps {
 public:
  explicit Steps(const NumeralSystem& system)
      : all_digits_(system.allDigits()),
        limit_(static_cast<int32_t>(system.power(all_digits_)) - 1),
        finest_(std::min(system.top - system.least, all_digits_)),
        beyond_(system.power(system.digits)),
        system_(system) {
    for (int finer = 0; finer <= finest_; ++finer) {
      Step& step = steps_[static_cast<size_t>(finer)];
      const int up = finer - system.spare();
      step.up = static_cast<int32_t>(system.power(std::max(up, 0)));
      step.unit = static_cast<int32_t>(system.power(std::max(-up, 0)));
      step.log = quarterLog(step.widened(0));
      step.shift = std::max(-up, 0);
      step.x = system.top - finer;
    }
  }

  /// Of numbers, in the units of predictions.
  int32_t limit() const { return limit_; }

  /// The least number that has too many digits.
  int64_t beyond() const { return beyond_; }

  /// For numbers that are at most `extent`.
  const Step& stepFor(int32_t extent) const {
    if (finest_ == 0) return steps_[0];
    return steps_[static_cast<size_t>(std::clamp(all_digits_ - system_.digitsOf(extent), 0, finest_))];
  }

  /// A prediction in steps, rounded to the nearest.
  int64_t nearest(int32_t prediction, const Step& step) const {
    const int32_t sum = prediction + step.unit / 2;
    if (system_.radix == 2) return int64_t{sum >> step.shift} * step.up;
    const int32_t sign = sum >> 31;
    return int64_t{((sum ^ sign) / step.unit) ^ sign} * step.up;
  }

 private:
  static constexpr size_t kMostSteps = 28;

  int all_digits_;
  int32_t limit_;
  int finest_;
  int64_t beyond_;
  NumeralSystem system_;
  std::array<Step, kMostSteps> steps_;
};

}  // namespace tutte::numerals
