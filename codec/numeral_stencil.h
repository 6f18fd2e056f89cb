#pragma once
// Predictions of floats from the known values around a site. 32 bits hold everything, for values are below 2^27.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "codec/apart.h"
#include "codec/value_lanes.h"
#include "codec/value_members.h"
#include "codec/value_nodes.h"
#include "codec/value_surroundings.h"

namespace tutte::numerals {

inline constexpr int kMostComponents = 4;
using Row = values::Vec<kMostComponents, int32_t>;
using Nodes = values::Nodes<kMostComponents>;
inline constexpr int32_t kLargestError = 1 << 24;  ///< so that those of all neighbours fit

template <class F>
[[gnu::always_inline]] inline Row eachOf(F f) {
  return values::eachOf<kMostComponents, int32_t>(f);
}

/// What is known around one site: parallelograms, or else what lies farther away.
class Stencil {
 public:
  explicit Stencil(const Nodes& nodes) : nodes_(nodes) {}

  /// `last` is used where nothing is known around the site.
  TUTTE_APART void gather(const values::Surroundings& around, const Row& last) {
    const std::span<const Index> neighbours = around.neighbours();
    neighbour_count = static_cast<int32_t>(neighbours.size());
    constexpr size_t kStride = sizeof(values::Node<kMostComponents>) / sizeof(int32_t);
    values::lanes::sumFours(error_sum.data(), nodes_[0].error.data(), kStride, neighbours);
    makeMembers(around);
    const std::span<const Row> members(members_.data(), static_cast<size_t>(member_count));
    if (member_count > 0) base = values::averageOf<kMostComponents, int32_t>(members);
    if (member_count > 1) {
      spread = values::spreadOf<kMostComponents, int32_t>(members);
    } else {
      settleFromAfar(around, last);
    }
  }

  int member_count = 0;  ///< parallelograms
  Row base;              ///< the prediction
  Row spread;            ///< how much predictions disagree
  int32_t neighbour_count = 0;
  Row error_sum;  ///< of the neighbours

 private:
  static constexpr int kMostMembers = 4;
  static constexpr int32_t kFarthest = 1 << 28;  // of a member that is scaled

  const Row& value(Index site) const { return nodes_[site].value; }
  Row parallelogram(const values::Term& term) const {
    const Row &a = value(term.a), &b = value(term.b), &x = value(term.x);
    return eachOf([&](size_t i) { return a[i] + b[i] - x[i]; });
  }

  // Those within polygons are better than those across edges.
  void makeMembers(const values::Surroundings& around) {
    member_count = 0;
    for (const values::Term& term : around.scaled()) addScaled(term);
    for (const values::Term& term : around.within()) {
      if (member_count < kMostMembers) members_[static_cast<size_t>(member_count++)] = parallelogram(term);
    }
    if (member_count > 0) return;
    for (const values::Term& term : around.across()) {
      if (member_count == kMostMembers) break;
      const Row &a = value(term.a), &b = value(term.b), &x = value(term.x), &y = value(term.y);
      members_[static_cast<size_t>(member_count++)] =
          eachOf([&](size_t i) { return (2 * (a[i] + b[i]) - x[i] - y[i]) >> 1; });
    }
  }

  void addScaled(const values::Term& term) {
    if (member_count == kMostMembers) return;
    const Row &at = value(term.a), &to = value(term.b), &from = value(term.x);
    members_[static_cast<size_t>(member_count++)] = eachOf([&](size_t i) {
      const int64_t way = (int64_t{to[i]} - from[i]) * static_cast<int32_t>(term.y) >> 12;
      return static_cast<int32_t>(std::clamp<int64_t>(at[i] + way, -kFarthest, kFarthest));
    });
  }

  // Weaker predictions: the best is the base where there is no parallelogram, the next one measures its reliability.
  void settleFromAfar(const values::Surroundings& around, const Row& last) {
    bool have_base = member_count > 0, have_spread = false;
    spread.fill(0);
    const auto offer = [&](const auto& list, auto predict) {
      if (list.empty() || have_spread) return;
      const Row prediction = meanOf(list, predict);
      if (have_base) {
        spread = eachOf([&](size_t i) { return std::max(prediction[i] - base[i], base[i] - prediction[i]); });
        have_spread = true;
      } else {
        base = prediction;
        have_base = true;
      }
    };
    offer(around.over(), [&](const values::Term& term) { return parallelogram(term); });
    offer(around.straight(), [&](const values::Term& term) { return parallelogram(term); });
    offer(around.neighbours(), [&](Index site) { return value(site); });
    if (!have_base) base = last;
  }

  // Of the first four. Of three, the last one counts twice.
  template <class List, class Predict>
  static Row meanOf(const List& list, Predict predict) {
    Row sum{}, last{};
    const size_t count = std::min<size_t>(list.size(), 4);
    for (size_t k = 0; k < count; ++k) {
      last = predict(list[k]);
      sum = eachOf([&](size_t i) { return sum[i] + last[i]; });
    }
    if (count == 1) return sum;
    if (count == 2) return eachOf([&](size_t i) { return (sum[i] + 1) >> 1; });
    const int32_t again = count == 3 ? -1 : 0;
    return eachOf([&](size_t i) { return (sum[i] + (last[i] & again) + 2) >> 2; });
  }

  const Nodes& nodes_;
  std::array<Row, kMostMembers> members_;
};

}  // namespace tutte::numerals
