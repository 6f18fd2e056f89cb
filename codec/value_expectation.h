#pragma once
// What is expected of a residual.

#include <algorithm>
#include <cstdint>

#include "codec/value_tables.h"

namespace tutte::values {

/// What is known about a residual before it is coded. Sizes are in 1/16 and not negative.
struct Expectation {
  int32_t estimate = 0;   ///< its size
  int32_t near = 0;       ///< the errors of the same component at the neighbours
  int32_t all = 0;        ///< the errors of all components there
  int32_t so_far = 0;     ///< the errors of this site's components that are known
  int32_t spread = 0;     ///< how much the predictions of the component disagree
  int32_t widest = 0;     ///< the largest spread of all components
  int32_t apart = 0;      ///< how far the second-best prediction is from the best
  uint32_t members = 0;   ///< how many parallelograms, at most 3; 0 if one was picked
  uint32_t source = 0;    ///< 0 within a polygon, 1 across an edge, 2 neither
  uint32_t fraction = 0;  ///< in its last four digits, those of the prediction, from 1/2 below a whole number on
  int rank = 0;           ///< which component of its site it is, at most 2
  int32_t side = 0;       ///< below 0, the value is likelier below the prediction; above 0, above; 0: not known

  /// Of the estimate, four steps per doubling, below 64.
  int level() const { return std::min(quarterLog(half(estimate)), 63); }

  /// How many half levels a size is above `level`, from 0 for `least` on.
  uint32_t relative(int32_t size, int level, int least, int most) const {
    return static_cast<uint32_t>(std::clamp((quarterLog(half(size)) - level) >> 1, least, most) - least);
  }

  static uint32_t half(int32_t size) { return static_cast<uint32_t>(size) >> 1; }
};

}  // namespace tutte::values
