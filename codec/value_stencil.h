#pragma once
// What the known surroundings say about a value: parallelograms, their average and their disagreement.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/apart.h"
#include "codec/value_angles.h"
#include "codec/value_lanes.h"
#include "codec/value_members.h"
#include "codec/value_nodes.h"
#include "codec/value_surroundings.h"
#include "codec/value_tables.h"

namespace tutte::values {

/// Which kind of prediction was possible, best first.
enum class Source : uint8_t { kWithin, kAcrossTriangle, kAcrossFace, kStraight, kNeighbours, kLast };

/// The surroundings of one site in values. Predictions and spreads are in 1/16.
template <int C, class T>
class Stencil {
 public:
  using Values = Vec<C, T>;

  /// Values lie in [0, max]. `valences`: those of the sites, where triangles are expected to be shaped by them; or
  /// none.
  Stencil(const Nodes<C>& nodes, T max, std::vector<uint8_t> valences)
      : nodes_(nodes),
        valences_(std::move(valences)),
        normal_shift_(std::max(0, static_cast<int>(std::bit_width(static_cast<uint32_t>(max))) - 14)) {}

  /// All about the site. `last` is used where nothing is known around it.
  TUTTE_APART void gather(const Surroundings& around, const Vec<C, int32_t>& last, bool want_normal) {
    sumErrors(around.neighbours());
    normal.fill(0);
    if constexpr (C == 4) {
      want_normal ? makeMembers<true>(around) : makeMembers<false>(around);
    } else {
      makeMembers<false>(around);
    }
    settle(around, last);
  }

  /// The neighbours alone, where predictions will be adopted.
  void gatherErrors(const Surroundings& around) { sumErrors(around.neighbours()); }

  /// What there is without parallelograms, after gatherErrors().
  void settleWithout(const Surroundings& around, const Vec<C, int32_t>& last) {
    member_count = 0;
    settleFromAfar(around, last);
  }

  static constexpr int kMostMembers = 4;

  /// Replaces what was gathered by better predictions: their average and all of them.
  void adopt(Source from, const Values& average, std::span<const Values> predictions) {
    source = from;
    base = lean = average;
    member_count = static_cast<int>(predictions.size());
    std::copy(predictions.begin(), predictions.end(), members.begin());
    spread = member_count > 1 ? spreadOf<C, T>(membersSoFar()) : Values{};
  }

  /// Replaces it by a prediction from elsewhere.
  void replace(const Values& prediction) {
    base = lean = prediction;
    member_count = 0;
    spread.fill(0);
    normal.fill(0);
  }

  Source source = Source::kLast;
  int member_count = 0;  ///< parallelograms, if `source` is one of the first two
  std::array<Values, kMostMembers> members;
  Values base;                                  ///< the prediction
  Values spread;                                ///< how much the predictions disagree
  Values lean;                                  ///< another prediction: the value is likelier on its side of the base
  int32_t neighbours = 0;                       ///< known ones
  Values error_sum;                             ///< of the neighbours' errors
  alignas(16) std::array<int32_t, 4> normal{};  ///< of the surroundings, not of unit length; 0: unknown

 private:
  static constexpr size_t kWidth = C;
  static constexpr T kOne = 1 << kFraction;

  template <class F>
  [[gnu::always_inline]] static Values each(F f) {
    return eachOf<C, T>(f);
  }

  const Vec<C, int32_t>& value(Index site) const { return nodes_[site].value; }

  void sumErrors(std::span<const Index> around) {
    neighbours = static_cast<int32_t>(around.size());
    if constexpr (C == 4 && sizeof(T) == 4) {
      lanes::sumFours(error_sum.data(), nodes_[0].error.data(), sizeof(Node<C>) / sizeof(int32_t), around);
    } else {
      error_sum.fill(0);
      for (const Index site : around) {
        const Vec<C, int32_t>& error = nodes_[site].error;
        error_sum = each([&](size_t i) { return error_sum[i] + error[i]; });
      }
    }
  }

  // Parallelograms within polygons are better than those across edges.
  template <bool kWantNormal>
  [[gnu::always_inline]] void makeMembers(const Surroundings& around) {
    member_count = 0;
    source = Source::kWithin;
    for (const Term& term : around.scaled()) addScaled(term);
    if constexpr (kWantNormal) {
      for (const Term& term : around.planes()) addNormal(value(term.a), value(term.b), value(term.x));
    }
    for (const Term& term : around.within()) {
      addParallelogram<kWantNormal>(term, [](T a, T b, T x, size_t) { return (a + b - x) * kOne; });
    }
    if (member_count > 0) return;
    for (const Term& term : around.across()) {
      if (member_count == kMostMembers) break;
      const Vec<C, int32_t>& y = value(term.y);
      addParallelogram<kWantNormal>(term,
                                    [&](T a, T b, T x, size_t i) { return (2 * (a + b) - x - y[i]) * (kOne / 2); });
      if constexpr (C == 4) {
        if (!valences_.empty()) shape(around.site(), term);
      }
    }
    source = member_count > 0 ? Source::kAcrossTriangle : Source::kLast;
  }

  template <bool kWantNormal, class Predict>
  [[gnu::always_inline]] void addParallelogram(const Term& term, Predict predict) {
    if (member_count == kMostMembers) return;
    const Vec<C, int32_t>&a = value(term.a), &b = value(term.b), &x = value(term.x);
    members[static_cast<size_t>(member_count++)] = each([&](size_t i) { return predict(a[i], b[i], x[i], i); });
    if constexpr (kWantNormal) addNormal(b, a, x);
  }

  // Moves the last member, over the edge of a triangle, to where the valences let expect it.
  [[gnu::always_inline]] void shape(Index site, const Term& term) {
    if (term.x != term.y) return;
    const Shift shift = Shifts::of(valences_[term.a], valences_[term.b], valences_[term.x], valences_[site]);
    const Vec<C, int32_t>&a = value(term.a), &b = value(term.b), &x = value(term.x);
    Values& member = members[static_cast<size_t>(member_count) - 1];
    // Within 32 bits, for points are below 2^20.
    for (size_t i = 0; i < 3; ++i) member[i] += ((a[i] - x[i]) * shift.a + (b[i] - x[i]) * shift.b) >> (8 - kFraction);
  }

  void addScaled(const Term& term) {
    if (member_count == kMostMembers) return;
    const Vec<C, int32_t>&at = value(term.a), &to = value(term.b), &from = value(term.x);
    members[static_cast<size_t>(member_count++)] = each([&](size_t i) {
      const int64_t scaled = (int64_t{to[i]} - from[i]) * static_cast<int32_t>(term.y) >> (12 - kFraction);
      return at[i] * kOne + static_cast<T>(scaled);
    });
  }

  [[gnu::always_inline]] void addNormal(const Vec<C, int32_t>& origin, const Vec<C, int32_t>& first,
                                        const Vec<C, int32_t>& second) {
    lanes::addCross(normal.data(), origin.data(), first.data(), second.data(), normal_shift_);
  }

  // Fills in base and spread from the best source.
  void settle(const Surroundings& around, const Vec<C, int32_t>& last) {
    if (member_count > 0) base = lean = averageOf<C, T>(membersSoFar());
    if (member_count > 1) {
      spread = spreadOf<C, T>(membersSoFar());
    } else {
      settleFromAfar(around, last);
    }
  }

  std::span<const Values> membersSoFar() const { return {members.data(), static_cast<size_t>(member_count)}; }

  // Weaker predictions: the best is the base where there is no parallelogram, the next one measures its reliability.
  void settleFromAfar(const Surroundings& around, const Vec<C, int32_t>& last) {
    spread.fill(0);
    bool have_base = member_count > 0, have_spread = false;
    const auto offer = [&](Source from, const Values& prediction) {
      if (!have_base) {
        base = lean = prediction;
        source = from;
        have_base = true;
      } else if (!have_spread) {
        spread = each([&](size_t i) { return std::max(prediction[i] - base[i], base[i] - prediction[i]); });
        lean = prediction;
        have_spread = true;
      }
    };
    if (!around.over().empty()) offer(Source::kAcrossFace, meanOf(around.over()));
    if (!have_spread && !around.straight().empty()) offer(Source::kStraight, meanOf(around.straight()));
    if (!have_spread && neighbours > 0) offer(Source::kNeighbours, meanOf(around.neighbours()));
    if (!have_base) {
      source = Source::kLast;
      base = lean = each([&](size_t i) { return last[i] * kOne; });
    }
  }

  // At most four. Of three, the last one counts twice.
  Values meanOf(std::span<const Term> terms) const {
    Values sum{}, last{};
    for (const Term& term : terms) {
      const Vec<C, int32_t>&a = value(term.a), &b = value(term.b), &x = value(term.x);
      last = each([&](size_t i) { return T{a[i]} + b[i] - x[i]; });
      sum = each([&](size_t i) { return sum[i] + last[i]; });
    }
    if (terms.size() == 3) sum = each([&](size_t i) { return sum[i] + last[i]; });
    const int shift = kFraction - static_cast<int>(terms.size() > 1) - static_cast<int>(terms.size() > 2);
    return each([&](size_t i) { return sum[i] * (T{1} << shift); });
  }

  Values meanOf(std::span<const Index> sites) const {
    Values sum{};
    for (const Index site : sites) {
      const Vec<C, int32_t>& here = value(site);
      sum = each([&](size_t i) { return sum[i] + here[i]; });
    }
    const auto count = static_cast<uint32_t>(sites.size());
    return each([&](size_t i) { return static_cast<T>(mean(int64_t{sum[i]} * kOne, count)); });
  }

  const Nodes<C>& nodes_;
  const std::vector<uint8_t> valences_;
  const int normal_shift_;  // so that they fit
};

}  // namespace tutte::values
