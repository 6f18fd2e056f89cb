#pragma once
// Codes the values of one attribute site by site: predicts, corrects, and says how large the residual may be.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "codec/apart.h"
#include "codec/value_copies.h"
#include "codec/value_echoes.h"
#include "codec/value_graph.h"
#include "codec/value_guides.h"
#include "codec/value_model.h"
#include "codec/value_picks.h"
#include "codec/value_residuals.h"
#include "codec/value_scale.h"
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

    bool angular() const { return kind == ValueKind::kAngular; }
    bool points() const { return kind == ValueKind::kPoints || angular(); }
  };

  SitePredictor(Port& port, const ValueGraph& graph, std::span<const int32_t> places, const Options& options,
                Residuals& residuals)
      : port_(port),
        finder_(graph, wanted(options)),
        nodes_(graph.siteCount()),
        stencil_(nodes_, options.max, options.angular() ? siteValences(graph) : std::vector<uint8_t>()),
        guide_(graph, nodes_, places, options.max, options.kind, options.weighting),
        residuals_(residuals),
        count_(options.components),
        scale_(count_),
        max_(options.max),
        tangent_(options.points() && !options.fast) {
    if (options.echoes) echoes_.emplace(graph, nodes_, count_);
    if (options.copies) copies_.emplace(graph, nodes_, sizeof(T) == 4 && count_ == 3);
  }

  /// Codes the value of the next site; a writer takes it from `values`, which has all sites', a reader stores it there.
  TUTTE_APART void code(std::span<int32_t> values) {
    const Surroundings around = finder_.next();
    const std::span<int32_t> value = values.subspan(size_t{around.site()} * count_, static_cast<size_t>(count_));
    if (guide_.predictsAlone()) {
      stencil_.gatherErrors(around);
    } else {
      stencil_.gather(around, wanted_, tangent_);
    }
    guide_.refine(around, wanted_, stencil_);
    scale_.estimate(stencil_.neighbours, stencil_.error_sum);
    if (copies_ && copies_->look(around.site(), stencil_.base)) followOriginal();
    if constexpr (Port::kWriting) std::ranges::copy(value, wanted_.begin());
    if (!echo(around.site())) {
      pick();
      codeComponents();
    }
    if constexpr (!Port::kWriting) {
      store(value);
    }
    nodes_.add({wanted_, errors_});
    guide_.learn(around.site(), wanted_);
    if (echoes_) echoes_->learn(around.site());
    if (copies_) copies_->learn(wanted_);
    scale_.adapt(errors_);
  }

  /// True when a value left [0, max]: the bytes are damaged. Such values are clamped.
  bool damaged() const { return damaged_; }

 private:
  using Values = Vec<C, T>;
  static constexpr T kOne = 1 << kFraction;

  static SurroundingsFinder::Wanted wanted(const Options& options) {
    SurroundingsFinder::Wanted wanted = Guide::wanted(options.kind);
    wanted.far &= !options.fast;
    // What is far beyond a point's parallelogram says less than what is beside.
    wanted.beside = options.components == 3;
    return wanted;
  }

  int width() const { return C == 2 ? C : count_; }

  // Three are the usual number.
  void store(std::span<int32_t> value) const {
    if (C == 4 && count_ == 3) [[likely]] {
      for (size_t i = 0; i < 3; ++i) value[i] = wanted_[i];
    } else {
      for (int i = 0; i < width(); ++i) value[i] = wanted_[i];
    }
  }

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

  void followOriginal() {
    stencil_.replace(copies_->prediction());
    scale_.set(std::min(copies_->scale(width()), kLargestError));
  }

  // One parallelogram instead of the average.
  void pick() {
    several_ = stencil_.member_count > 1 ? -1 : 0;
    picked_ = 0;
    members_context_ = static_cast<uint32_t>(std::min(stencil_.member_count, 3));
    if (!several_ || !picks_.code(port_, stencil_, wanted_, width())) return;
    members_context_ = 0;
    picked_ = 1;
  }

  void codeComponents() {
    if constexpr (C == 4) {
      if (tangent_) plane_.turn(stencil_.normal);
    }
    lookAhead();
    residuals_.withCoder([&](auto&& coder) { codeComponents(coder); });
  }

  // What expectations of all components need.
  void lookAhead() {
    const int32_t all = scale_.all(), several = several_;
    const Vec<C, int32_t>& near = scale_.near();
    const Values& spread = stencil_.spread;
    spread_ = eachOf<C, int32_t>([&](size_t i) {
      return static_cast<int32_t>(sizeof(T) == 4 ? spread[i] : std::min<T>(spread[i], kMostSpread));
    });
    const auto usual = eachOf<C, int32_t>([&](size_t i) { return all + near[i]; });
    share_ = eachOf<C, int32_t>([&](size_t i) { return usual[i] + ((4 * spread_[i]) & several); });
    first_usual_ = usual[plane_.component(0)];
    if (plane_.bent()) {
      if constexpr (C == 4) side_ = plane_.normal();
    } else {
      const Values &lean = stencil_.lean, &base = stencil_.base;
      side_ = eachOf<C, int32_t>([&](size_t i) {
        const T apart = lean[i] - base[i];
        return static_cast<int32_t>(sizeof(T) == 4 ? apart : std::clamp<T>(apart, -kWidest, kWidest));
      });
    }
    share_digits_ = 2 - several + picked_;
  }

  // Unrolled, except where a program's size counts.
  template <class Coder>
  TUTTE_APART void codeComponents(Coder& coder) {
    SoFar so_far;
#if defined(TUTTE_COMPACT)
    for (size_t place = 0; place < static_cast<size_t>(width()); ++place) codeComponent(coder, place, so_far);
#else
    codeComponent(coder, 0, so_far);
    if (width() > 1) codeComponent(coder, 1, so_far);
    if (C == 2 || width() < 3) return;
    codeComponent(coder, 2, so_far);
    if (width() > 3) codeComponent(coder, 3, so_far);
#endif
  }

  /// About the components of the current site that are known.
  struct SoFar {
    T first = 0, second = 0;  ///< how far they are from the base
    int32_t errors = 0, weighed = 0;
  };

  template <class Coder>
  [[gnu::always_inline]] void codeComponent(Coder& coder, size_t place, SoFar& so_far) {
    const size_t i = plane_.component(place);
    T prediction = stencil_.base[i];
    const bool corrected = place == 2 && plane_.bent();
    if (corrected) {
      const uint32_t situation = source() * 2 + (stencil_.member_count > 1);
      prediction += static_cast<T>(plane_.correction(so_far.first, so_far.second, scale_.all(), situation));
    }
    // Turned round, where values are likelier below the prediction.
    const T down = coder.wantsAll() ? 0 : downwards(side_[i], prediction);
    const T turned = ((prediction ^ down) - down) + 8;
    const Expectation about = expect(i, place, so_far, prediction, static_cast<uint32_t>(turned), coder.wantsAll());
    const auto rounded = static_cast<int32_t>(turned >> kFraction), sign = static_cast<int32_t>(down);
    int32_t coded = rounded + coder.code(port_, about, Port::kWriting ? ((wanted_[i] ^ sign) - sign) - rounded : 0);
    coded = (coded ^ sign) - sign;
    if (static_cast<uint32_t>(coded) > static_cast<uint32_t>(max_)) [[unlikely]] {
      damaged_ = true;
      coded = std::clamp(coded, 0, static_cast<int32_t>(max_));
    }
    wanted_[i] = coded;
    const T off = T{coded} * kOne - prediction;
    const auto error = static_cast<int32_t>(std::min<T>(off < 0 ? -off : off, kLargestError));
    errors_[i] = error;
    so_far.errors += error;
    so_far.weighed = place == 0 ? 2 * error : (so_far.weighed >> 1) + error;
    if (place == 0) so_far.first = off;
    if (place == 1) so_far.second = off;
    if (corrected) plane_.learn(off);
  }

  // -1: below the prediction; 0: above it.
  static T downwards(int32_t side, T prediction) {
    return (2 * side + static_cast<int32_t>((prediction + 8) >> 3 & 1) - 1) >> 31;
  }

  uint32_t source() const { return stencil_.member_count == 0 ? 2 : stencil_.source == Source::kWithin ? 0 : 1; }

  [[gnu::always_inline]] Expectation expect(size_t i, size_t place, const SoFar& so_far, T prediction,
                                            uint32_t fraction, bool wants_all) const {
    Expectation about;
    about.near = scale_.near()[i];
    about.spread = spread_[i];
    about.members = members_context_;
    about.rank = static_cast<int>(std::min<size_t>(place, 2));
    about.fraction = fraction;
    about.side = side_[i];
    about.estimate = (share_[i] + (place == 0 ? first_usual_ : so_far.weighed)) >> share_digits_;
    if (wants_all) {
      about.all = scale_.all();
      about.so_far = so_far.errors;
      about.widest = static_cast<int32_t>(std::min(*std::ranges::max_element(stencil_.spread), kWidest));
      about.source = source();
      const T apart = stencil_.lean[i] - prediction;
      about.apart = static_cast<int32_t>(std::min<T>(apart < 0 ? -apart : apart, kWidest));
    }
    return about;
  }

  static constexpr T kWidest = 1 << 25;
  static constexpr int32_t kMostSpread = 1 << 28;  // numbers of 32 bits never reach it

  Port& port_;
  SurroundingsFinder finder_;
  Nodes<C> nodes_;
  Stencil<C, T> stencil_;
  Guide guide_;
  Residuals& residuals_;
  std::optional<Echoes<C>> echoes_;
  std::optional<Copies<C, T>> copies_;
  Picks<C, T> picks_;
  TangentPlane plane_;

  const int count_;  // of components
  ErrorScale<C> scale_;
  const T max_;
  const bool tangent_;
  bool damaged_ = false;

  // Of the current site.
  Vec<C, int32_t> wanted_{}, errors_{};          // `wanted_` is the value
  Vec<C, int32_t> spread_{}, share_{}, side_{};  // what lookAhead() found
  int32_t first_usual_ = 0;
  int share_digits_ = 2;
  uint32_t members_context_ = 0;
  int32_t several_ = 0;  // parallelograms: -1; 0: none or one
  int picked_ = 0;       // 1: one of them is the base
};

}  // namespace tutte::values
