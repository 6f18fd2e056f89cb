#pragma once
// Codes the values of one attribute site by site: predicts, corrects, and says how large the residual may be.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "codec/value_graph.h"
#include "codec/value_guides.h"
#include "codec/value_model.h"
#include "codec/value_stencil.h"
#include "codec/value_tables.h"

namespace tutte::values {

/// `C` components, `kInputs` mixed contexts (1, 2, 3 or 5). Values lie in [0, max]. With `tangent`, three components
/// are points of a surface, and the third is corrected towards its tangent plane.
template <class Port, int C, int kInputs, class Guide>
class SitePredictor {
 public:
  SitePredictor(Port& port, const ValueGraph& graph, std::span<const int32_t> places, int32_t max, bool tangent)
      : port_(port),
        nodes_(graph.siteCount()),
        stencil_(graph, nodes_),
        guide_(graph, nodes_, places, max),
        residuals_(lines()),
        max_(max),
        tangent_(tangent) {
    picks_.fill(Chance(6160));
    tangents_.fill(2048);
    last_.fill(0);
  }

  /// Codes one site's value; a writer takes it from `value`, a reader stores it there. The order of the calls is the
  /// order of the bytes.
  void code(Index site, std::span<int32_t, C> value) {
    stencil_.gather(site, last_, tangent_);
    guide_.refine(site, stencil_);
    estimateScale();
    const bool picked = pick(value);
    codeComponents(value);
    Node<C>& node = nodes_[site];
    for (int i = 0; i < C; ++i) node.value[i] = value[i];
    for (int i = 0; i < C; ++i) node.error[i] = static_cast<uint32_t>(errors_[i]);
    guide_.learn(site, node.value);
    node.known = true;
    node.picked = picked;
    for (int i = 0; i < C; ++i) last_[i] = value[i];
    adaptTypicalError();
  }

  /// True when a value left [0, max]: the bytes are damaged. Such values are clamped.
  bool damaged() const { return damaged_; }

 private:
  static constexpr int64_t kOne = 1 << kFraction;
  static constexpr int64_t kLargestError = 1 << 20;

  static constexpr std::array<uint32_t, kInputs> lines() {
    constexpr std::array<uint32_t, kMostInputs> all = {64 * 3 * 4, 15 * 4 * 19, 12 * 16 * 19, 3 * 4 * 19 * 32,
                                                       32 * 19 * 3};
    std::array<uint32_t, kInputs> used{};
    std::copy_n(all.begin(), kInputs, used.begin());
    return used;
  }

  bool parallelograms() const { return stencil_.member_count > 0; }

  // From the errors at the known neighbours.
  void estimateScale() {
    if (stencil_.neighbours == 0) {
      near_error_.fill(typical_error_);
      all_error_ = typical_error_;
      return;
    }
    all_error_ = 0;
    for (int i = 0; i < C; ++i) {
      near_error_[i] = mean(stencil_.error_sum[i], stencil_.neighbours);
      all_error_ += near_error_[i];
    }
    all_error_ = C == 3 ? all_error_ * 21845 >> 16 : all_error_ / C;
    if (stencil_.neighbours == 1) all_error_ = (all_error_ + typical_error_) >> 1;
  }

  // One parallelogram instead of the average: explicit, where there are several.
  bool pick(std::span<const int32_t, C> value) {
    picked_ = false;
    members_context_ = static_cast<uint32_t>(std::min(stencil_.member_count, 3));
    if (stencil_.member_count < 2) return false;
    int64_t spread = 0;
    for (int i = 0; i < C; ++i) spread += stencil_.spread[i];
    const int level = std::min(quarterLog(small(spread)) / 4, 11);
    const uint32_t count = static_cast<uint32_t>(std::min(stencil_.member_count, 4)) - 2;
    const uint32_t around = std::min(stencil_.picked_neighbours, 3u);
    const uint32_t within = stencil_.source == Source::kWithin ? 1 : 0;
    Chance& chance = picks_[((within * 3 + count) * 4 + around) * 12 + static_cast<uint32_t>(level)];
    int choice = 0;
    if constexpr (Port::kWriting) choice = bestMember(value, chance);
    if (!chance.code(port_, choice > 0)) return false;
    int m = 0;
    std::array<Chance, Stencil<C>::kMostMembers>& row = indices_[count];
    while (m + 1 < stencil_.member_count && !row[m].code(port_, choice - 1 == m)) ++m;
    stencil_.base = stencil_.members[m];
    members_context_ = 0;
    picked_ = true;
    return true;
  }

  // 0: the average; m + 1: parallelogram m. Costs are in quarters of bits.
  int bestMember(std::span<const int32_t, C> value, const Chance& chance) const {
    const auto cost = [&](const Vec<C>& prediction) {
      int64_t sum = 0;
      for (int i = 0; i < C; ++i) {
        const int64_t off = value[i] * kOne - prediction[i];
        sum += quarterLog(small((off < 0 ? -off : off) + 8));
      }
      return sum;
    };
    int best = 0;
    int64_t least = cost(stencil_.base) - 4;
    const int64_t price = -chance.stretched() / 44 + (stencil_.member_count > 2 ? 4 : 2);
    for (int m = 0; m < stencil_.member_count; ++m) {
      const int64_t here = cost(stencil_.members[m]) + price;
      if (here >= least) continue;
      least = here;
      best = m + 1;
    }
    return best;
  }

  void codeComponents(std::span<int32_t, C> value) {
    const std::array<int, C> order = componentOrder();
    int64_t so_far = 0;
    for (int rank = 0; rank < C; ++rank) {
      const int i = order[rank];
      int64_t prediction = stencil_.base[i];
      const bool correct = rank == 2 && bent_;
      int64_t correction = 0;
      if (correct) {
        correction = tangentCorrection(order);
        prediction += tangentGain() * correction >> 12;
      }
      const int64_t rounded = std::clamp<int64_t>((prediction + 8) >> kFraction, 0, max_);
      const ResidualContext context = contextOf(i, std::min(rank, 2), so_far, prediction);
      int64_t coded = rounded + residuals_.code(port_, context, value[i] - rounded);
      if (coded < 0 || coded > max_) {
        damaged_ = true;
        coded = std::clamp<int64_t>(coded, 0, max_);
      }
      value[i] = static_cast<int32_t>(coded);
      raw_[i] = coded * kOne - stencil_.base[i];
      const int64_t off = coded * kOne - prediction;
      errors_[i] = std::min(off < 0 ? -off : off, kLargestError);
      so_far += errors_[i];
      if (correct) adaptTangent(raw_[i], correction);
    }
  }

  // With a normal, the component that the surface's plane determines best comes last.
  std::array<int, C> componentOrder() {
    std::array<int, C> order{};
    for (int i = 0; i < C; ++i) order[i] = i;
    bent_ = false;
    if constexpr (C == 3) {
      if (!tangent_) return order;
      std::array<uint64_t, 3> size;
      for (int i = 0; i < 3; ++i)
        size[i] = static_cast<uint64_t>(stencil_.normal[i] < 0 ? -stencil_.normal[i] : stencil_.normal[i]);
      const auto sortPair = [&](int a, int b) {
        if (size[order[a]] > size[order[b]]) std::swap(order[a], order[b]);
      };
      sortPair(0, 1);
      sortPair(1, 2);
      sortPair(0, 1);
      const int shift = static_cast<int>(std::bit_width(size[order[2]])) - 12;
      for (int i = 0; i < 3; ++i) normal_[i] = shift > 0 ? stencil_.normal[i] >> shift : stencil_.normal[i];
      bent_ = normal_[order[2]] != 0;
    }
    return order;
  }

  // What the third component's residual would be if the point stayed in the plane.
  int64_t tangentCorrection(const std::array<int, C>& order) {
    const int64_t sum = normal_[order[0]] * raw_[order[0]] + normal_[order[1]] * raw_[order[1]];
    return -sum / normal_[order[2]];
  }

  int32_t& tangentGain() {
    const uint32_t source = parallelograms() ? stencil_.source == Source::kWithin ? 0 : 1 : 2;
    const uint32_t many = stencil_.member_count > 1;
    return tangents_[(static_cast<uint32_t>(std::min(bitLength(small(all_error_)), 15)) * 3 + source) * 2 + many];
  }

  void adaptTangent(int64_t off, int64_t correction) {
    const int64_t limit = 4 * all_error_ + 64;
    if (off > limit || off < -limit || correction > limit || correction < -limit) return;
    int32_t& gain = tangentGain();
    const int64_t error = off - (gain * correction >> 12);
    const int shift = 2 * bitLength(small(all_error_)) - 6;
    const int64_t product = error * correction;
    const int64_t step = std::clamp<int64_t>(shift >= 0 ? product >> shift : product << -shift, -512, 512);
    gain = static_cast<int32_t>(std::clamp<int64_t>(gain + step, -512, 4608));
  }

  ResidualContext contextOf(int i, int rank, int64_t so_far, int64_t prediction) const {
    const int64_t near = near_error_[i], all = all_error_, spread = stencil_.spread[i];
    int64_t estimate = rank == 0   ? (2 * all + near) / 3
                       : rank == 1 ? (all + near + 2 * so_far) >> 2
                                   : (all + near + so_far) >> 2;
    if (C == 1) estimate = near;
    if (stencil_.member_count > 1) {
      estimate = (estimate + spread) >> 1;
    } else if (parallelograms()) {
      estimate = (7 * estimate + std::min(spread, 2 * estimate)) >> 3;
    }
    if (picked_) estimate >>= 1;
    const int level = std::min(quarterLog(small(estimate >> 1)), 63);
    const int expected = std::min(bitLength(small(estimate * 3 >> 6)), kLongest);

    ResidualContext context;
    context.component = rank;
    context.expected = expected;
    const int64_t side = C == 3 && bent_ ? normal_[i] : stencil_.lean[i] - prediction;
    const int lean = (side > 0) - (side < 0);
    context.sign = static_cast<int>((prediction & 15) >> 1) * 3 + lean + 1;
    const auto component = static_cast<uint32_t>(rank);
    const auto e = static_cast<uint32_t>(expected);
    if constexpr (kInputs == 1) {
      context.line[0] = (static_cast<uint32_t>(level / 2) * 3 + component) * 4 + members_context_;
    } else {
      context.line[0] = (static_cast<uint32_t>(level) * 3 + component) * 4 + members_context_;
      const auto ratio = static_cast<uint32_t>(std::clamp((quarterLog(small(spread >> 1)) - level) / 2, -7, 7) + 7);
      context.line[1] = (ratio * 4 + members_context_) * 19 + e;
    }
    if constexpr (kInputs >= 3) {
      const int64_t widest = *std::max_element(stencil_.spread.begin(), stencil_.spread.end());
      const auto own = static_cast<uint32_t>(std::clamp((quarterLog(small(near >> 1)) - level) / 2, -5, 6) + 5);
      const auto wide = static_cast<uint32_t>(std::clamp((quarterLog(small(widest >> 1)) - level) / 2, -7, 8) + 7);
      context.line[2] = (own * 16 + wide) * 19 + e;
    }
    if constexpr (kInputs >= 5) {
      const uint32_t source = parallelograms() ? stencil_.source == Source::kWithin ? 0 : 1 : 2;
      context.line[3] = ((source * 4 + members_context_) * 19 + e) * 32 + log32(all >> 1);
      context.line[4] = (log32(so_far) * 19 + e) * 3 + component;
    }
    return context;
  }

  void adaptTypicalError() {
    int64_t sum = 0;
    for (int i = 0; i < C; ++i) sum += errors_[i];
    const int64_t now = std::min(sum / C, 4 * typical_error_);
    typical_error_ = std::max<int64_t>(typical_error_ + ((now - typical_error_) >> 5), 16);
  }

  static uint32_t small(int64_t x) { return static_cast<uint32_t>(std::min<int64_t>(x, 0x7FFFFFFF)); }
  static uint32_t log32(int64_t x) { return static_cast<uint32_t>(std::min(quarterLog(small(x)) / 2, 31)); }

  Port& port_;
  std::vector<Node<C>> nodes_;
  Stencil<C> stencil_;
  Guide guide_;
  ResidualCoder<kInputs> residuals_;
  std::array<Chance, 2 * 3 * 4 * 12> picks_;
  std::array<std::array<Chance, Stencil<C>::kMostMembers>, 3> indices_;
  std::array<int32_t, 16 * 3 * 2> tangents_;

  const int64_t max_;
  const bool tangent_;
  bool damaged_ = false;
  int64_t typical_error_ = 64;
  Vec<C> last_;

  // Of the current site.
  Vec<C> near_error_{};
  int64_t all_error_ = 0;
  Vec<C> raw_{}, errors_{};
  std::array<int64_t, 3> normal_{};
  uint32_t members_context_ = 0;
  bool picked_ = false;
  bool bent_ = false;
};

}  // namespace tutte::values
