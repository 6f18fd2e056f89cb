#pragma once
// All profiles as one class, which chooses at run time: for programs whose size counts (TUTTE_COMPACT), because what
// surrounds the statistics, the walk above all, is then there once and not once per profile.

#include <optional>

#include "codec/section.h"
#include "codec/statistics_mixed.h"
#include "codec/statistics_paper.h"

namespace tutte {

class AnyStatistics {
 public:
  static constexpr bool kGathers = true, kSums = true;
  static constexpr Index kDegree = 0;

  AnyStatistics(const SectionHeader& header, StatisticsMemory& memory) : profile_(header.profile) {
    switch (profile_) {
      case Profile::kFast: fast_.emplace(header, memory); break;
      case Profile::kDefault: default_.emplace(header, memory); break;
      case Profile::kSmall: small_.emplace(header, memory); break;
      default: paper_.emplace(header, memory);
    }
  }

  template <class Port>
  [[gnu::noinline]] FaceAnswer face(Port& port, const FaceQuestion& question, const FaceAnswer& truth) {
    return ask([&](auto& statistics) { return statistics.face(port, question, truth); });
  }

  template <class Port>
  [[gnu::noinline]] Index vertex(Port& port, const VertexQuestion& question, Index truth, bool seed) {
    return ask([&](auto& statistics) { return statistics.vertex(port, question, truth, seed); });
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
  std::optional<MixedStatistics<FastProfile, 0>> fast_;
  std::optional<MixedStatistics<DefaultProfile, 0>> default_;
  std::optional<MixedStatistics<SmallProfile, 0>> small_;
};

/// What stands for a profile's own class.
#if defined(TUTTE_COMPACT)
template <class>
using StatisticsFor = AnyStatistics;
#else
template <class Statistics>
using StatisticsFor = Statistics;
#endif

}  // namespace tutte
