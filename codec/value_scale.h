#pragma once
// How large the error of a prediction may be, told from those around it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "codec/value_nodes.h"
#include "codec/value_tables.h"

namespace tutte::values {

/// Expected errors of one site after the other, in 1/16, each at most kLargestError.
template <int C>
class ErrorScale {
 public:
  explicit ErrorScale(int components, int32_t typical = 64)
      : part_(components == 3 ? 21845 : 65536 / components), typical_(typical) {}

  /// Of each component, and on average.
  const Vec<C, int32_t>& near() const { return near_; }
  int32_t all() const { return all_; }

  /// From the sum of the errors at `count` known neighbours; without any, from what is typical.
  template <class Sum>
  void estimate(int32_t count, const Sum& errors) {
    if (count == 0) return set(typical_);
    const uint64_t reciprocal = kReciprocal[static_cast<size_t>(count)];
    near_ = eachOf<C, int32_t>(
        [&](size_t i) { return static_cast<int32_t>(static_cast<uint32_t>(errors[i]) * reciprocal >> 16); });
    all_ = mean(near_);
    if (count == 1) all_ = (all_ + typical_) >> 1;
  }

  void set(int32_t error) {
    near_.fill(error);
    all_ = error;
  }

  /// What the errors were.
  void adapt(const Vec<C, int32_t>& errors) {
    const int32_t now = std::min(mean(errors), 4 * typical_);
    typical_ = std::max(typical_ + ((now - typical_) >> 5), 16);
  }

 private:
  // Over the components; the others are 0. The sum is below 2^23.
  int32_t mean(const Vec<C, int32_t>& errors) const {
    int32_t sum = 0;
    for (size_t i = 0; i < C; ++i) sum += errors[i];
    return static_cast<int32_t>(sum * int64_t{C == 2 ? 32768 : part_} >> 16);
  }

  const int part_;  // 65536 / components
  Vec<C, int32_t> near_{};
  int32_t all_ = 0, typical_;
};

}  // namespace tutte::values
