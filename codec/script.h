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
#include "codec/statistics_mixed.h"
#include "codec/statistics_paper.h"
#include "codec/walk.h"

namespace tutte {

/// The oracle of a decoder.
struct Blind {
  static bool component() { return false; }
  static Index original() { return kNone; }
  static void seed() {}
  static void start(Index) {}
  static void step() {}
  static void cross(Index) {}
  static FaceAnswer face() { return {}; }
  static VertexAnswer vertex() { return {}; }
  static SplitAnswer split(const Gaps&) { return {}; }
};

/// Codes a mesh's symbols through two ports, one for valences and splits, one for degrees. The statistics decide how.
template <class Statistics, class Port, class Oracle>
class Script {
 public:
  static constexpr bool kGathers = Statistics::kGathers;

  Script(const SectionHeader& header, Port& valences, Port& degrees, Oracle& oracle)
      : header_(header),
        statistics_(header),
        log_(header.copies),
        valences_(valences),
        degrees_(degrees),
        oracle_(oracle) {}

  bool component() {
    valences_.about(Topic::kComponents);
    if (!component_.code(valences_, oracle_.component())) return false;
    valences_.about(Topic::kCopies);
    damaged_ |= !log_.begin(valences_, oracle_.original());
    return true;
  }

  FaceAnswer face(const FaceQuestion& question, const Gaps& gaps) {
    const FaceAnswer truth = oracle_.face();
    degrees_.about(Topic::kDegrees);
    if (log_.replaying()) {
      const Index symbol = log_.next();
      return {symbol >> 1, (symbol & 1) != 0};
    }
    const FaceAnswer answer = statistics_.face(degrees_, question, gaps, truth);
    log_.add(answer.degree << 1 | static_cast<Index>(answer.dummy));
    return answer;
  }

  VertexAnswer vertex(const VertexQuestion& question, const Gaps& gaps) {
    const VertexAnswer truth = oracle_.vertex();
    valences_.about(Topic::kValences);
    if (log_.replaying()) {
      const Index symbol = log_.next();
      return {symbol >> 1, (symbol & 1) != 0};
    }
    VertexAnswer answer{statistics_.vertex(valences_, question, gaps, truth.valence), false};
    if (header_.hasDummyUmbrellas() && answer.valence != 0) {
      valences_.about(Topic::kHoles);
      answer.dummy = dummy_[std::min(answer.valence, Index{15})].code(valences_, truth.dummy);
    }
    log_.add(answer.valence << 1 | static_cast<Index>(answer.dummy));
    return answer;
  }

  SplitAnswer split(const VertexQuestion& question, const Gaps& gaps) {
    const SplitAnswer truth = oracle_.split(gaps);
    if (log_.replaying()) {
      const Index gap = log_.next();
      return {gap, log_.next()};
    }
    valences_.about(Topic::kSplits);
    const SplitAnswer answer = splits_.code(valences_, question, gaps, truth);
    log_.add(answer.gap);
    log_.add(answer.slots_after);
    return answer;
  }

  /// Why the walk must stop: the streams ended before the mesh did, or named what does not exist.
  Error fault() const {
    if (damaged_) return Error::kMalformed;
    return valences_.overrun() || degrees_.overrun() ? Error::kTruncated : Error::kNone;
  }

  void seed() { oracle_.seed(); }
  void start(Index gap) { oracle_.start(gap); }
  void step() { oracle_.step(); }
  void cross(Index gap) { oracle_.cross(gap); }

 private:
  const SectionHeader& header_;
  Statistics statistics_;
  ComponentLog log_;
  Port& valences_;
  Port& degrees_;
  Oracle& oracle_;
  Bit component_;
  std::array<Bit, 16> dummy_;  // by valence
  SplitCoder splits_;
  bool damaged_ = false;
};

/// Runs `use` with the statistics class that the header names, as a type: use(std::type_identity<Statistics>).
template <class Use>
auto withStatistics(const SectionHeader& header, Use&& use) {
  switch (header.profile) {
    case Profile::kFast: return use(std::type_identity<MixedStatistics<FastProfile>>());
    case Profile::kDefault: return use(std::type_identity<MixedStatistics<DefaultProfile>>());
    case Profile::kSmall: return use(std::type_identity<MixedStatistics<SmallProfile>>());
    default: return use(std::type_identity<PaperStatistics>());
  }
}

}  // namespace tutte
