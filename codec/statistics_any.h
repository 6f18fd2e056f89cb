#pragma once
// All profiles as one class, which chooses at run time: for programs whose size counts (TUTTE_COMPACT), because what
// surrounds the statistics, the walk above all, is then there once and not once per profile.

#include <optional>

#include "codec/gaps.h"
#include "codec/section.h"
#include "codec/statistics_mixed.h"
#include "codec/statistics_paper.h"

namespace tutte {

class AnyStatistics {
 public:
  static constexpr bool kGathers = true;

  explicit AnyStatistics(const SectionHeader& header) : profile_(header.profile) {
    switch (profile_) {
      case Profile::kFast: fast_.emplace(header); break;
      case Profile::kDefault: default_.emplace(header); break;
      case Profile::kSmall: small_.emplace(header); break;
      default: paper_.emplace(header);
    }
  }

  template <class Port>
  FaceAnswer face(Port& port, const FaceQuestion& question, const Gaps& gaps, const FaceAnswer& truth) {
    return ask([&](auto& statistics) { return statistics.face(port, question, gaps, truth); });
  }

  template <class Port>
  Index vertex(Port& port, const VertexQuestion& question, const Gaps& gaps, Index truth) {
    return ask([&](auto& statistics) { return statistics.vertex(port, question, gaps, truth); });
  }

 private:
  template <class Question>
  [[gnu::always_inline]] auto ask(Question question) {
    switch (profile_) {
      case Profile::kFast: return question(*fast_);
      case Profile::kDefault: return question(*default_);
      case Profile::kSmall: return question(*small_);
      default: return question(*paper_);
    }
  }

  Profile profile_;
  std::optional<PaperStatistics> paper_;
  std::optional<MixedStatistics<FastProfile>> fast_;
  std::optional<MixedStatistics<DefaultProfile>> default_;
  std::optional<MixedStatistics<SmallProfile>> small_;
};

}  // namespace tutte
