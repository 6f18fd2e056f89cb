#pragma once
// Codes the values of one attribute site by site: predicts, corrects, and says how large the residual may be.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "codec/value_copies.h"
#include "codec/value_echoes.h"
#include "codec/value_graph.h"
#include "codec/value_guides.h"
#include "codec/value_model.h"
#include "codec/value_residuals.h"
#include "codec/value_stencil.h"
#include "codec/value_tables.h"
#include "codec/value_tangent.h"

namespace tutte::values {

/// Up to `C` components in numbers of type `T` (value_nodes.h). Values lie in [0, max]. With `points`, three components
/// are points of a surface, and the third is corrected towards its tangent plane. `fast` does without that, and without
/// most predictions from far away. With `echoes`, values may come again (value_echoes.h), and with `copies`, components
/// follow their originals (value_copies.h).
template <class Port, int C, class T, class Guide>
class SitePredictor {
 public:
  struct Options {
    int components;
    int32_t max;
    ValueKind kind;
    bool fast;
    bool echoes;
    bool copies;
    Weighting weighting;

    bool points() const { return kind == ValueKind::kPoints; }
  };

  SitePredictor(Port& port, const ValueGraph& graph, std::span<const int32_t> places, const Options& options,
                Residuals& residuals)
      : port_(port),
        finder_(graph, Guide::wantsEdges(options.kind), !options.fast),
        nodes_(graph.siteCount()),
        stencil_(nodes_, options.max),
        guide_(graph, nodes_, places, options.max, options.kind, options.weighting),
        residuals_(residuals),
        count_(options.components),
        max_(options.max),
        tangent_(options.points() && !options.fast) {
    if (options.echoes) echoes_.emplace(graph, nodes_, count_);
    if (options.copies) copies_.emplace(graph, nodes_, sizeof(T) == 4 && count_ == 3);
    picks_.fill(Chance(6160));
  }

  /// Codes the value of the next site; a writer takes it from `values`, which has all sites', a reader stores it there.
  void code(std::span<int32_t> values) {
    const Surroundings& around = finder_.next();
    const std::span<int32_t> value = values.subspan(size_t{around.site} * count_, static_cast<size_t>(count_));
    stencil_.gather(around, last_, tangent_);
    guide_.refine(around, stencil_);
    estimateScale();
    if (copies_ && copies_->look(around.site, stencil_.base)) followOriginal();
    if constexpr (Port::kWriting) std::ranges::copy(value, wanted_.begin());
    if (!echo(around.site)) {
      pick();
      codeComponents();
    }
    last_ = wanted_;
    if constexpr (!Port::kWriting) {
      for (int i = 0; i < width(); ++i) value[i] = last_[i];
    }
    nodes_.add({last_, errors_});
    guide_.learn(around.site, last_);
    if (echoes_) echoes_->learn(around.site);
    if (copies_) copies_->learn(last_);
    adaptTypicalError();
  }

  /// True when a value left [0, max]: the bytes are damaged. Such values are clamped.
  bool damaged() const { return damaged_; }

 private:
  using Values = Vec<C, T>;
  static constexpr size_t kLanes = C;  // those that are not used stay 0
  static constexpr T kOne = 1 << kFraction;

  bool parallelograms() const { return stencil_.member_count > 0; }

  int width() const { return C == 2 ? C : count_; }

  // The value of an earlier site; the residuals are what they would have been.
  bool echo(Index site) {
    if (!echoes_) return false;
    const Index earlier = echoes_->code(port_, site, stencil_.neighbours > 0, wanted_);
    if (earlier == kNone) return false;
    wanted_ = nodes_[earlier].value;
    for (int i = 0; i < width(); ++i) {
      const T off = wanted_[i] * kOne - stencil_.base[i];
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
    const uint64_t reciprocal = kReciprocal[count];
    near_error_ = eachOf<C, int32_t>([&](size_t i) {
      return static_cast<int32_t>(static_cast<uint32_t>(stencil_.error_sum[i]) * reciprocal >> 16);
    });
    int32_t sum = 0;
    for (size_t i = 0; i < kLanes; ++i) sum += near_error_[i];
    all_error_ = perComponent(sum);
    if (count == 1) all_error_ = (all_error_ + typical_error_) >> 1;
  }

  void followOriginal() {
    stencil_.replace(copies_->prediction());
    all_error_ = std::min(copies_->scale(width()), kLargestError);
    near_error_.fill(all_error_);
  }

  // One parallelogram instead of the average: explicit, where there are several.
  void pick() {
    several_ = picked_ = 0;
    members_context_ = static_cast<uint32_t>(std::min(stencil_.member_count, 3));
    if (stencil_.member_count < 2) return;
    several_ = -1;
    T spread = 0;
    for (size_t i = 0; i < kLanes; ++i) spread += stencil_.spread[i];
    const int level = std::min((bitLength(small(spread) + 4) - 3) >> 1, 5);
    const uint32_t count = static_cast<uint32_t>(std::min(stencil_.member_count, 4)) - 2;
    const uint32_t within = stencil_.source == Source::kWithin ? 1 : 0;
    Chance& chance = picks_[((within * 3 + count) * 2 + last_picked_) * 6 + static_cast<uint32_t>(level)];
    int choice = 0;
    if constexpr (Port::kWriting) choice = bestMember(chance);
    last_picked_ = chance.code(port_, choice > 0);
    if (!last_picked_) return;
    int m = 0;
    std::array<Chance, Stencil<C, T>::kMostMembers>& row = indices_[count];
    while (m + 1 < stencil_.member_count && !row[m].code(port_, choice - 1 == m)) ++m;
    stencil_.base = stencil_.members[m];
    members_context_ = 0;
    picked_ = 1;
  }

  // 0: the average; m + 1: parallelogram m. Costs are in quarters of bits.
  int bestMember(const Chance& chance) const {
    const auto cost = [&](const Values& prediction) {
      int32_t sum = 0;
      for (int i = 0; i < width(); ++i) {
        const T off = wanted_[i] * kOne - prediction[i];
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

  void codeComponents() {
    if constexpr (C == 4) plane_.turn(stencil_.normal);
    residuals_.withCoder([&](auto& coder) {
      SoFar so_far;
      for (size_t place = 0; place < static_cast<size_t>(width()); ++place) codeComponent(coder, place, so_far);
    });
  }

  /// About the components of the current site that are known.
  struct SoFar {
    Values raw{};  ///< how far they are from the base
    int32_t errors = 0, weighed = 0;
  };

  template <class Coder>
  [[gnu::always_inline]] void codeComponent(Coder& coder, size_t place, SoFar& so_far) {
    const size_t i = plane_.component(place);
    T prediction = stencil_.base[i];
    const bool corrected = place == 2 && plane_.bent();
    if (corrected) {
      const uint32_t situation = source() * 2 + (stencil_.member_count > 1);
      prediction += static_cast<T>(plane_.correction(so_far.raw, all_error_, situation));
    }
    const auto rounded = static_cast<int32_t>(std::clamp<T>((prediction + 8) >> kFraction, 0, max_));
    const Expectation about = expect(i, place, so_far, prediction, coder.wantsAll());
    int32_t coded = rounded + coder.code(port_, about, wanted_[i] - rounded);
    if (static_cast<uint32_t>(coded) > static_cast<uint32_t>(max_)) [[unlikely]] {
      damaged_ = true;
      coded = std::clamp(coded, 0, static_cast<int32_t>(max_));
    }
    wanted_[i] = coded;
    so_far.raw[i] = T{coded} * kOne - stencil_.base[i];
    const T off = T{coded} * kOne - prediction;
    const auto error = static_cast<int32_t>(std::min<T>(off < 0 ? -off : off, kLargestError));
    errors_[i] = error;
    so_far.errors += error;
    so_far.weighed = place == 0 ? 2 * error : (so_far.weighed >> 1) + error;
    if (corrected) plane_.learn(so_far.raw[i]);
  }

  uint32_t source() const { return parallelograms() ? stencil_.source == Source::kWithin ? 0 : 1 : 2; }

  [[gnu::always_inline]] Expectation expect(size_t i, size_t place, const SoFar& so_far, T prediction,
                                            bool wants_all) const {
    Expectation about;
    about.near = near_error_[i];
    about.spread =
        static_cast<int32_t>(sizeof(T) == 4 ? stencil_.spread[i] : std::min<T>(stencil_.spread[i], kMostSpread));
    about.members = members_context_;
    about.rank = static_cast<int>(std::min<size_t>(place, 2));
    about.fraction = static_cast<uint32_t>(prediction & 15);
    const T apart = stencil_.lean[i] - prediction;
    about.side =
        plane_.bent() ? plane_.normal(i) : static_cast<int32_t>(sizeof(T) == 4 ? apart : std::clamp<T>(apart, -1, 1));
    const int32_t usual = all_error_ + about.near;
    const int32_t around = (usual + (place == 0 ? usual : so_far.weighed)) >> 2;
    // Nothing is decided, because whether there are several parallelograms is hard to foresee.
    about.estimate = (around + (((about.spread - around) & several_) >> 1)) >> picked_;
    if (wants_all) {
      about.all = all_error_;
      about.so_far = so_far.errors;
      about.widest = static_cast<int32_t>(std::min(*std::ranges::max_element(stencil_.spread), kWidest));
      about.source = source();
      about.apart = static_cast<int32_t>(std::min<T>(apart < 0 ? -apart : apart, kWidest));
    }
    return about;
  }

  void adaptTypicalError() {
    int32_t sum = 0;
    for (size_t i = 0; i < kLanes; ++i) sum += errors_[i];
    const int32_t now = std::min(perComponent(sum), 4 * typical_error_);
    typical_error_ = std::max(typical_error_ + ((now - typical_error_) >> 5), 16);
  }

  // Of a sum over them, which is below 2^23.
  int32_t perComponent(int32_t sum) const {
    constexpr std::array<int64_t, 5> kShares = {0, 65536, 32768, 21845, 16384};
    return static_cast<int32_t>(sum * (C == 2 ? kShares[2] : kShares[static_cast<size_t>(count_)]) >> 16);
  }

  static constexpr T kWidest = 1 << 25;
  static constexpr int32_t kMostSpread = 1 << 28;  // numbers of 32 bits never reach it
  static uint32_t small(int64_t x) { return static_cast<uint32_t>(std::min<int64_t>(x, 0x7FFFFFF0)); }

  Port& port_;
  SurroundingsFinder finder_;
  Nodes<C> nodes_;
  Stencil<C, T> stencil_;
  Guide guide_;
  Residuals& residuals_;
  std::optional<Echoes<C>> echoes_;
  std::optional<Copies<C, T>> copies_;
  std::array<Chance, 2 * 3 * 2 * 6> picks_;
  std::array<std::array<Chance, Stencil<C, T>::kMostMembers>, 3> indices_;
  TangentPlane plane_;

  const int count_;  // of components
  const T max_;
  const bool tangent_;
  bool damaged_ = false;
  bool last_picked_ = false;  // a single parallelogram, at the last site that had several
  int32_t typical_error_ = 64;
  Vec<C, int32_t> last_{};

  // Of the current site.
  Vec<C, int32_t> wanted_{}, near_error_{}, errors_{};  // `wanted_` is the value
  int32_t all_error_ = 0;
  uint32_t members_context_ = 0;
  int32_t several_ = 0;  // parallelograms: -1; 0: none or one
  int picked_ = 0;       // 1: one of them is the base
};

}  // namespace tutte::values
