#pragma once
// The symbols of the connectivity section, written once for both directions: each member asks the oracle (which knows
// in the encoder and is blind in the decoder), codes the answer through a port, and returns what was coded.

#include <algorithm>
#include <array>
#include <type_traits>

#include "codec/component_log.h"
#include "codec/gaps.h"
#include "codec/model.h"
#include "codec/result.h"
#include "codec/section.h"
#include "codec/split_coder.h"
#include "codec/statistics_any.h"
#include "codec/statistics_mixed.h"
#include "codec/statistics_paper.h"
#include "codec/walk.h"

namespace tutte {

/// The oracle of a decoder.
struct Blind {
  static bool component() { return false; }
  static Index original() { return kNone; }
  static void seed() {}
  static void start(const Gap&) {}
  static void step() {}
  static void cross(const Gap&) {}
  static FaceAnswer face() { return {}; }
  static VertexAnswer vertex() { return {}; }
  static SplitAnswer split(const Gaps&) { return {}; }
};

/// Codes a mesh's symbols through a port. The statistics decide how.
template <class Statistics, class Port, class Oracle>
class Script {
 public:
  static constexpr bool kGathers = Statistics::kGathers, kSums = Statistics::kSums;
  static constexpr Index kDegree = Statistics::kDegree;

  Script(const SectionHeader& header, Port& port, Oracle& oracle, StatisticsMemory& memory)
      : header_(header),
        degrees_known_(header.degreesKnown()),
        dummy_umbrellas_(header.hasDummyUmbrellas()),
        statistics_(header, memory),
        log_(header.copies),
        port_(port),
        oracle_(oracle) {}

  bool component() {
    port_.about(Topic::kComponents);
    if (!component_.code(port_, oracle_.component())) return false;
    port_.about(Topic::kCopies);
    damaged_ |= !log_.begin(port_, oracle_.original());
    return true;
  }

  Index original() const { return log_.original(); }

  [[gnu::always_inline]] FaceAnswer face(const FaceQuestion& question) {
    const FaceAnswer truth = oracle_.face();
    if (degrees_known_) return {question.closed ? question.known_edges : header_.uniform_degree, false};
    return coded(question, truth);
  }

  [[gnu::always_inline]] VertexAnswer vertex(const VertexQuestion& question) {
    const VertexAnswer truth = oracle_.vertex();
    if (kDegree == 0 && log_.replaying()) return replayedVertex();
    port_.about(Topic::kValences);
    return noted(statistics_.vertex(port_, question, truth.valence, std::false_type()), truth);
  }

  /// Of the first face of a component.
  VertexAnswer seedVertex(const VertexQuestion& question) {
    const VertexAnswer truth = oracle_.vertex();
    if (log_.replaying()) return replayedVertex();
    port_.about(Topic::kValences);
    return noted(statistics_.vertex(port_, question, truth.valence, std::true_type()), truth);
  }

  SplitAnswer split(const VertexQuestion& question, const Gaps& gaps) {
    const SplitAnswer truth = oracle_.split(gaps);
    if (log_.replaying()) {
      const Index gap = log_.next();
      return {gap, log_.next()};
    }
    port_.about(Topic::kSplits);
    const SplitAnswer answer = splits_.code(port_, question, gaps, truth);
    log_.add(answer.gap);
    log_.add(answer.slots_after);
    return answer;
  }

  /// Must the walk stop? The symbols ended before the mesh did, or named what does not exist.
  bool faulty() const { return damaged_ || port_.overrun(); }
  Error fault() const {
    if (port_.overrun()) return Error::kTruncated;
    return damaged_ ? Error::kMalformed : Error::kNone;
  }

  void seed() { oracle_.seed(); }
  void start(const Gap& gap) { oracle_.start(gap); }
  void step() { oracle_.step(); }
  void cross(const Gap& gap) { oracle_.cross(gap); }

 private:
  [[gnu::noinline]] FaceAnswer coded(const FaceQuestion& question, const FaceAnswer& truth) {
    if (log_.replaying()) {
      const Index symbol = replayed();
      return {symbol >> 1, (symbol & 1) != 0};
    }
    port_.about(Topic::kDegrees);
    const FaceAnswer answer = statistics_.face(port_, question, truth);
    log_.add(answer.degree << 1 | static_cast<Index>(answer.dummy));
    return answer;
  }

  [[gnu::noinline]] VertexAnswer replayedVertex() {
    const Index symbol = replayed();
    return {symbol >> 1, (symbol & 1) != 0};
  }

  Index replayed() {
    const Index symbol = log_.next();
    damaged_ |= symbol == kNone;
    return symbol;
  }

  // A valence that was coded, with what else there is to say.
  [[gnu::always_inline]] VertexAnswer noted(Index valence, const VertexAnswer& truth) {
    VertexAnswer answer{valence, false};
    if (kDegree != 0) return answer;
    if (dummy_umbrellas_ && valence != 0) {
      port_.about(Topic::kHoles);
      answer.dummy = dummy_[std::min(valence, Index{15})].code(port_, truth.dummy);
    }
    log_.add(valence << 1 | static_cast<Index>(answer.dummy));
    return answer;
  }

  const SectionHeader& header_;
  bool degrees_known_, dummy_umbrellas_;
  Statistics statistics_;
  ComponentLog log_;
  Port& port_;
  Oracle& oracle_;
  Bit component_;
  std::array<Bit, 16> dummy_;  // by valence
  SplitCoder splits_;
  bool damaged_ = false;
};

/// The degree of all faces, where it is one that the walk has a text of its own for: nothing is coded about faces then,
/// and no component is a copy. 0: any mesh.
inline Index plainDegree(const SectionHeader& header) {
  const bool plain = header.closed && !header.copies && !header.match;
  return plain && (header.uniform_degree == 3 || header.uniform_degree == 4) ? header.uniform_degree : 0;
}

/// Runs `use` with the statistics class that the header names, as a type: use(std::type_identity<Statistics>).
template <Index degree = 0, class Use>
auto withStatistics(const SectionHeader& header, Use&& use) {
  switch (header.profile) {
    case Profile::kFast: return use(std::type_identity<StatisticsFor<MixedStatistics<FastProfile, degree>>>());
    case Profile::kDefault: return use(std::type_identity<StatisticsFor<MixedStatistics<DefaultProfile, degree>>>());
    case Profile::kSmall: return use(std::type_identity<StatisticsFor<MixedStatistics<SmallProfile, degree>>>());
    default: return use(std::type_identity<StatisticsFor<PaperStatistics>>());
  }
}

/// The same, with statistics of their own for triangle and quad meshes: the quickest, but three times the program.
template <class Use>
auto withQuickStatistics(const SectionHeader& header, Use&& use) {
#if !defined(TUTTE_COMPACT)
  if (plainDegree(header) == 3) return withStatistics<3>(header, use);
  if (plainDegree(header) == 4) return withStatistics<4>(header, use);
#endif
  return withStatistics(header, use);
}

}  // namespace tutte
