#pragma once
// Codes the values of one attribute site by site: predicts, corrects, and says how large the residual may be.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "codec/value_classes.h"
#include "codec/value_echoes.h"
#include "codec/value_graph.h"
#include "codec/value_guides.h"
#include "codec/value_model.h"
#include "codec/value_stencil.h"
#include "codec/value_tables.h"

namespace tutte::values {

/// `C` components in numbers of type `T` (value_stencil.h), residuals by `Coder`. Values lie in [0, max]. With
/// `tangent`, three components are points of a surface, and the third is corrected towards its tangent plane. With
/// `echoes`, values may come again (value_echoes.h).
template <class Port, int C, class T, class Coder, class Guide>
class SitePredictor {
 public:
  SitePredictor(Port& port, const ValueGraph& graph, std::span<const int32_t> places, int32_t max, bool tangent,
                bool echoes)
      : port_(port),
        nodes_(graph.siteCount()),
        stencil_(graph, nodes_),
        guide_(graph, nodes_, places, max),
        max_(max),
        tangent_(tangent) {
    if (echoes) echoes_.emplace(graph, nodes_);
    picks_.fill(Chance(6160));
    tangents_.fill(2048);
  }

  /// The site whose turn it is.
  Index next() { return nodes_.order.next(); }

  /// Codes its value; a writer takes it from `value`, a reader stores it there.
  void code(Index site, std::span<int32_t, C> value) {
    stencil_.gather(site, last_, tangent_);
    guide_.refine(site, stencil_);
    estimateScale();
    if (!echo(site, value)) {
      pick(value);
      codeComponents(value);
    }
    std::copy_n(value.data(), C, last_.begin());
    Node<C>& node = nodes_.learn(site, picked_);
    node.value = last_;
    node.error = errors_;
    guide_.learn(site, last_);
    if (echoes_) echoes_->learn(site);
    adaptTypicalError();
  }

  /// True when a value left [0, max]: the bytes are damaged. Such values are clamped.
  bool damaged() const { return damaged_; }

 private:
  using Values = Vec<C, T>;
  static constexpr T kOne = 1 << kFraction;

  bool parallelograms() const { return stencil_.member_count > 0; }

  // The value of an earlier site; the residuals are what they would have been.
  bool echo(Index site, std::span<int32_t, C> value) {
    if (!echoes_) return false;
    Vec<C, int32_t> wanted{};
    std::copy_n(value.data(), C, wanted.begin());
    const Index earlier = echoes_->code(port_, site, stencil_.neighbours > 0, wanted);
    if (earlier == kNone) return false;
    picked_ = false;
    for (int i = 0; i < C; ++i) {
      value[i] = nodes_[earlier].value[i];
      const T off = value[i] * kOne - stencil_.base[i];
      errors_[i] = static_cast<int32_t>(std::min<T>(off < 0 ? -off : off, kLargestError));
    }
    return true;
  }

  // From the errors at the known neighbours.
  void estimateScale() {
    const int32_t count = stencil_.neighbours;
    if (count == 0) {
      near_error_.fill(typical_error_);
      all_error_ = typical_error_;
      return;
    }
    const int64_t reciprocal = kReciprocal[count];
    int64_t sum = 0;
    for (int i = 0; i < C; ++i) {
      near_error_[i] = static_cast<int32_t>(stencil_.error_sum[i] * reciprocal >> 16);
      sum += near_error_[i];
    }
    all_error_ = static_cast<int32_t>(C == 3 ? sum * 21845 >> 16 : sum / C);
    if (count == 1) all_error_ = (all_error_ + typical_error_) >> 1;
  }

  // One parallelogram instead of the average: explicit, where there are several.
  void pick(std::span<const int32_t, C> value) {
    picked_ = false;
    members_context_ = static_cast<uint32_t>(std::min(stencil_.member_count, 3));
    if (stencil_.member_count < 2) return;
    T spread = 0;
    for (int i = 0; i < C; ++i) spread += stencil_.spread[i];
    const int level = std::min(quarterLog(small(spread)) / 4, 11);
    const uint32_t count = static_cast<uint32_t>(std::min(stencil_.member_count, 4)) - 2;
    const auto around = static_cast<uint32_t>(std::min(stencil_.picked_neighbours, 3));
    const uint32_t within = stencil_.source == Source::kWithin ? 1 : 0;
    Chance& chance = picks_[((within * 3 + count) * 4 + around) * 12 + static_cast<uint32_t>(level)];
    int choice = 0;
    if constexpr (Port::kWriting) choice = bestMember(value, chance);
    if (!chance.code(port_, choice > 0)) return;
    int m = 0;
    std::array<Chance, Stencil<C, T>::kMostMembers>& row = indices_[count];
    while (m + 1 < stencil_.member_count && !row[m].code(port_, choice - 1 == m)) ++m;
    stencil_.base = stencil_.members[m];
    members_context_ = 0;
    picked_ = true;
  }

  // 0: the average; m + 1: parallelogram m. Costs are in quarters of bits.
  int bestMember(std::span<const int32_t, C> value, const Chance& chance) const {
    const auto cost = [&](const Values& prediction) {
      int32_t sum = 0;
      for (int i = 0; i < C; ++i) {
        const T off = value[i] * kOne - prediction[i];
        sum += quarterLog(small((off < 0 ? -off : off) + 8));
      }
      return sum;
    };
    int best = 0;
    int32_t least = cost(stencil_.base) - 4;
    const int32_t price = -chance.stretched() / 44 + (stencil_.member_count > 2 ? 4 : 2);
    for (int m = 0; m < stencil_.member_count; ++m) {
      const int32_t here = cost(stencil_.members[m]) + price;
      if (here >= least) continue;
      least = here;
      best = m + 1;
    }
    return best;
  }

  void codeComponents(std::span<int32_t, C> value) {
    const std::array<int, C> order = componentOrder();
    Values raw{};
    int32_t so_far = 0;
    const auto codeAll = [&]<int... ranks>(std::integer_sequence<int, ranks...>) {
      (codeComponent<ranks>(order, raw, so_far, value), ...);
    };
    codeAll(std::make_integer_sequence<int, C>());
  }

  template <int rank>
  [[gnu::always_inline]] void codeComponent(const std::array<int, C>& order, Values& raw, int32_t& so_far,
                                            std::span<int32_t, C> value) {
    const int i = order[rank];
    T prediction = stencil_.base[i];
    int64_t correction = 0;
    if (rank == 2 && bent_) {
      correction = tangentCorrection(order, raw);
      prediction += static_cast<T>(tangentGain() * correction >> 12);
    }
    const T rounded = std::clamp<T>((prediction + 8) >> kFraction, 0, max_);
    const T residual = value[i] - rounded;
    T coded = rounded + static_cast<T>(codeResidual < rank < 2 ? rank : 2 > (i, so_far, prediction, residual));
    if (coded < 0 || coded > max_) {
      damaged_ = true;
      coded = std::clamp<T>(coded, 0, max_);
    }
    value[i] = static_cast<int32_t>(coded);
    raw[i] = coded * kOne - stencil_.base[i];
    const T off = coded * kOne - prediction;
    errors_[i] = static_cast<int32_t>(std::min<T>(off < 0 ? -off : off, kLargestError));
    so_far += errors_[i];
    if (rank == 2 && bent_) adaptTangent(raw[i], correction);
  }

  // Where the plane is at the two components that are known.
  int64_t tangentCorrection(const std::array<int, C>& order, const Values& raw) const {
    const int64_t sum = normal_[order[0]] * int64_t{raw[order[0]]} + normal_[order[1]] * int64_t{raw[order[1]]};
    return -sum / normal_[order[2]];
  }

  // With a normal, the component that the surface's plane determines best comes last.
  std::array<int, C> componentOrder() {
    std::array<int, C> order{};
    for (int i = 0; i < C; ++i) order[i] = i;
    bent_ = false;
    if constexpr (C == 3) {
      if (stencil_.normal == std::array<int64_t, 3>{}) return order;
      std::array<uint64_t, 3> size{};
      for (int i = 0; i < 3; ++i) {
        const int64_t x = stencil_.normal[i];
        size[i] = x < 0 ? uint64_t{0} - static_cast<uint64_t>(x) : static_cast<uint64_t>(x);
      }
      // Ascending; equal ones stay as they are.
      constexpr std::array<std::array<int, 3>, 8> kOrders = {
          {{0, 1, 2}, {0, 2, 1}, {0, 1, 2}, {2, 0, 1}, {1, 0, 2}, {0, 1, 2}, {1, 2, 0}, {2, 1, 0}}};
      order = kOrders[(size[0] > size[1]) * 4 + (size[0] > size[2]) * 2 + (size[1] > size[2])];
      const int shift = static_cast<int>(std::bit_width(size[order[2]])) - 12;
      for (int i = 0; i < 3; ++i) normal_[i] = shift > 0 ? stencil_.normal[i] >> shift : stencil_.normal[i];
      bent_ = normal_[order[2]] != 0;
    }
    return order;
  }

  int32_t& tangentGain() {
    const uint32_t source = parallelograms() ? stencil_.source == Source::kWithin ? 0 : 1 : 2;
    const uint32_t many = stencil_.member_count > 1;
    return tangents_[(static_cast<uint32_t>(std::min(bitLength(small(all_error_)), 15)) * 3 + source) * 2 + many];
  }

  void adaptTangent(int64_t off, int64_t correction) {
    const int64_t limit = 4 * int64_t{all_error_} + 64;
    if (off > limit || off < -limit || correction > limit || correction < -limit) return;
    int32_t& gain = tangentGain();
    const int64_t error = off - (gain * correction >> 12);
    const int shift = 2 * bitLength(small(all_error_)) - 6;
    const int64_t product = error * correction;
    const int64_t step = std::clamp<int64_t>(shift >= 0 ? product >> shift : product << -shift, -512, 512);
    gain = static_cast<int32_t>(std::clamp<int64_t>(gain + step, -512, 4608));
  }

  template <int rank>
  [[gnu::always_inline]] int64_t codeResidual(int i, int32_t so_far, T prediction, T residual) {
    const int32_t near = near_error_[i], all = all_error_;
    const int32_t spread = static_cast<int32_t>(std::min<T>(stencil_.spread[i], kWidest));
    int32_t estimate = C == 1      ? near
                       : rank == 0 ? (2 * all + near) / 3
                       : rank == 1 ? (all + near + 2 * so_far) >> 2
                                   : (all + near + so_far) >> 2;
    if (stencil_.member_count > 1) {
      estimate = (estimate + spread) >> 1;
    } else if (parallelograms()) {
      estimate = (7 * estimate + std::min(spread, 2 * estimate)) >> 3;
    }
    if (picked_) estimate >>= 1;

    ResidualContext context;
    context.component = rank;
    context.level = std::min(quarterLog(half(estimate)), 63);
    const int64_t side = C == 3 && bent_ ? normal_[i] : stencil_.lean[i] - prediction;
    context.sign = static_cast<int>((prediction & 15) >> 1) * 3 + (side > 0) - (side < 0) + 1;
    const auto level = static_cast<uint32_t>(context.level), members = members_context_;
    const auto relative = [&](int32_t size, int least, int most) {
      return static_cast<uint32_t>(std::clamp((quarterLog(half(size)) - context.level) >> 1, least, most) - least);
    };
    if constexpr (Coder::kInputs <= 2) {
      context.line[0] = (level / 2 * 3 + rank) * 4 + members;
      if constexpr (Coder::kInputs == 2) {
        context.line[1] = (relative(spread, -7, 7) * 6 + relative(near, -3, 2)) * 16 + level / 4;
      }
    } else {
      const int expected = std::min(bitLength(static_cast<uint32_t>(estimate * 3 >> 6)), kLongest);
      const auto e = static_cast<uint32_t>(expected);
      context.expected = expected;
      const T widest = *std::max_element(stencil_.spread.begin(), stencil_.spread.begin() + C);
      const uint32_t source = parallelograms() ? stencil_.source == Source::kWithin ? 0 : 1 : 2;
      const auto log = [](uint32_t x) { return static_cast<uint32_t>(std::min(quarterLog(x) / 2, 31)); };
      context.line = {
          (level * 3 + rank) * 4 + members, (relative(spread, -7, 7) * 4 + members) * 19 + e,
          (relative(near, -5, 6) * 16 + relative(static_cast<int32_t>(std::min<T>(widest, kWidest)), -7, 8)) * 19 + e,
          ((source * 4 + members) * 19 + e) * 32 + log(half(all)),
          (log(static_cast<uint32_t>(so_far)) * 19 + e) * 3 + rank};
    }
    return residuals_.code(port_, context, residual);
  }

  void adaptTypicalError() {
    int64_t sum = 0;
    for (int i = 0; i < C; ++i) sum += errors_[i];
    const int64_t now = std::min<int64_t>(sum / C, 4 * int64_t{typical_error_});
    typical_error_ = static_cast<int32_t>(std::max<int64_t>(typical_error_ + ((now - typical_error_) >> 5), 16));
  }

  static constexpr T kWidest = 1 << 25;
  static uint32_t small(int64_t x) { return static_cast<uint32_t>(std::min<int64_t>(x, 0x7FFFFFF0)); }
  static uint32_t half(int32_t x) { return static_cast<uint32_t>(x) >> 1; }

  Port& port_;
  Nodes<C> nodes_;
  Stencil<C, T> stencil_;
  Guide guide_;
  Coder residuals_;
  std::optional<Echoes<C>> echoes_;
  std::array<Chance, 2 * 3 * 4 * 12> picks_;
  std::array<std::array<Chance, Stencil<C, T>::kMostMembers>, 3> indices_;
  std::array<int32_t, 16 * 3 * 2> tangents_;

  const T max_;
  const bool tangent_;
  bool damaged_ = false;
  int32_t typical_error_ = 64;
  Vec<C, int32_t> last_{};

  // Of the current site.
  Vec<C, int32_t> near_error_{}, errors_{};
  int32_t all_error_ = 0;
  std::array<int64_t, 3> normal_{};
  uint32_t members_context_ = 0;
  bool picked_ = false;
  bool bent_ = false;
};

}  // namespace tutte::values
