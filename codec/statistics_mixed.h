#pragma once
// The profiles that mix contexts. They differ only in their lists of contexts.

#include <array>

#include "codec/contexts.h"
#include "codec/gaps.h"
#include "codec/match.h"
#include "codec/model.h"
#include "codec/predictor.h"
#include "codec/section.h"
#include "codec/walk.h"

namespace tutte {

template <auto... contexts>
struct ContextList {
  static constexpr int kCount = sizeof...(contexts);
  template <class Features>
  [[gnu::always_inline]] static std::array<uint64_t, kCount> keys(const Features& features) {
    return keysOf<contexts...>(features);
  }
};

/// One context each, nothing to mix.
struct FastProfile {
  using Vertex = ContextList<VertexContext::kPredicted>;
  using Face = ContextList<FaceContext::kEnds>;
  static constexpr bool kRich = false;
};

struct DefaultProfile {
  using Vertex =
      ContextList<VertexContext::kPredicted, VertexContext::kHeadRing, VertexContext::kNothing, VertexContext::kEnds,
                  VertexContext::kSlots, VertexContext::kHistory, VertexContext::kSums>;
  using Face = ContextList<FaceContext::kEnds, FaceContext::kNearAngle, FaceContext::kHistory, FaceContext::kAround>;
  static constexpr bool kRich = false;
};

struct SmallProfile {
  using Vertex = ContextList<VertexContext::kPredicted, VertexContext::kHeadRing, VertexContext::kNothing,
                             VertexContext::kEnds, VertexContext::kSlots, VertexContext::kHistory, VertexContext::kSums,
                             VertexContext::kPredictedSums, VertexContext::kBeyond, VertexContext::kCurrentRing,
                             VertexContext::kDegrees, VertexContext::kEndsAndSlots, VertexContext::kDegreeAfter,
                             VertexContext::kSumsAndSlots, VertexContext::kPredictedSlots>;
  using Face = ContextList<FaceContext::kEnds, FaceContext::kNearAngle, FaceContext::kHistory, FaceContext::kAround,
                           FaceContext::kEdge, FaceContext::kLeast, FaceContext::kAngles, FaceContext::kDegrees,
                           FaceContext::kBehind, FaceContext::kSums, FaceContext::kSlots, FaceContext::kBoth,
                           FaceContext::kEdgeAndDegrees, FaceContext::kDummies, FaceContext::kNothing>;
  static constexpr bool kRich = true;
};

/// The usual valence of a face degree's vertices: the most frequent so far, at least 3.
class UsualValence {
 public:
  UsualValence() {
    for (Index i = 0; i < 16; ++i) usual_[i] = i == 3 ? 6 : 4;
  }

  Index of(Index degree_class) const { return usual_[degree_class]; }

  void add(Index degree_class, Index valence) {
    if (valence < 3 || valence > 15) return;
    auto& counts = counts_[degree_class];
    if (++counts[valence] > counts[usual_[degree_class]]) usual_[degree_class] = valence;
  }

 private:
  std::array<std::array<Index, 16>, 16> counts_{};
  std::array<Index, 16> usual_;
};

template <class Profile>
class MixedStatistics {
 public:
  static constexpr bool kGathers = Profile::Vertex::kCount > 1;

  explicit MixedStatistics(const SectionHeader& header)
      : header_(header),
        vertices_(header.table_bits),
        faces_(header.degreesKnown() ? 1 : header.table_bits),
        match_(header.match) {}

  template <class Port>
  FaceAnswer face(Port& port, const FaceQuestion& question, const Gaps& gaps, const FaceAnswer& truth) {
    const FaceAnswer answer = codeFace(port, question, gaps, truth);
    history_.addDegree(answer.dummy ? 1 : answer.degree);
    if (!header_.degreesKnown()) match_.add(128 + (answer.dummy ? 1 : std::min(answer.degree, Index{100})));
    return answer;
  }

  template <class Port>
  [[gnu::always_inline]] Index vertex(Port& port, const VertexQuestion& question, const Gaps& gaps, Index truth) {
    return question.head == kNone ? codeVertex(std::true_type(), port, question, gaps, truth)
                                  : codeVertex(std::false_type(), port, question, gaps, truth);
  }

 private:
  static constexpr Index kLongest = 24;

  template <class Seed, class Port>
  Index codeVertex(Seed seed, Port& port, const VertexQuestion& question, const Gaps& gaps, Index truth) {
    const Index face = question.dummy ? 1 : std::min(question.degree, Index{15});
    const Index usual = usual_.of(face);
    vertices_.enter(Profile::Vertex::keys(VertexFeatures(seed, question, gaps, face, usual, history_)));
    const Index expected = match_.expected();
    expected_ = expected < 128 ? expected : MatchModel::kNoSymbol;
    const int situation = static_cast<int>(face * 4 + (question.missing > 1) * 2 + (question.index > 0));
    const auto decide = [&](int node, int step, bool matched, bool value) {
      return this->decide(port, vertices_, {node, situation + 64 * step}, matched, value);
    };
    const Index valence = decide(0, 0, expected == usual, truth == usual)
                              ? usual
                              : codeUnusual(port, usual, Seed::value, truth, expected, decide);
    usual_.add(face, valence);
    history_.addValence(valence);
    match_.add(std::min(valence, Index{100}));
    return valence;
  }

  template <class Port>
  FaceAnswer codeFace(Port& port, const FaceQuestion& question, const Gaps& gaps, const FaceAnswer& truth) {
    const Index known = question.closed ? question.known_edges : header_.uniform_degree;
    const bool may_be_dummy = header_.hasDummyFaces() && question.gap != kNone && !touchesDummy(question, gaps);
    if (known != 0 && !may_be_dummy) return {known, false};
    return codeUnknownFace(port, question, gaps, truth, known, may_be_dummy);
  }

  // `known`: its degree, or 0.
  template <class Port>
  FaceAnswer codeUnknownFace(Port& port, const FaceQuestion& question, const Gaps& gaps, const FaceAnswer& truth,
                             Index known, bool may_be_dummy) {
    const FaceFeatures features(question, gaps, history_);
    faces_.enter(Profile::Face::keys(features));
    const Index symbol = match_.expected(), expected = symbol - 128;
    expected_ = symbol >= 128 ? symbol : MatchModel::kNoSymbol;
    const int situation = static_cast<int>(features.behind * 3 + std::min(features.known, 3u) - (features.known > 0));
    port.about(Topic::kHoles);
    if (may_be_dummy && decide(port, faces_, {0, situation}, expected == 1, truth.dummy)) {
      return {question.closed ? known : 3 + dummy_degree_.code(port, truth.degree - 3), true};
    }
    if (known != 0) return {known, false};
    port.about(Topic::kDegrees);
    const Index least = std::max(header_.leastDegree(), question.known_edges + 1);
    Index degree = least;
    for (; degree < least + kLongest - 4; ++degree) {
      const int node = static_cast<int>(std::min(degree - 2, Index{kNodes - 1}));
      const int step = static_cast<int>(1 + std::min(degree - least, Index{2}));
      if (decide(port, faces_, {node, situation + 64 * step}, expected == degree, truth.degree == degree)) {
        return {degree, false};
      }
    }
    return {degree + large_degree_.code(port, truth.degree - degree), false};
  }

  template <class Port, class Decide>
  [[gnu::noinline]] Index codeUnusual(Port& port, Index usual, bool seed, Index truth, Index expected,
                                      Decide&& decide) {
    if (decide(1, 1, expected < usual, truth < usual)) {
      for (Index v = usual - 1; v >= 3; --v) {
        if (decide(static_cast<int>(std::min(1 + usual - v, Index{6})), 2, expected == v, truth == v)) return v;
      }
      return seed || decide(7, 3, expected == 2, truth == 2) ? 2 : 0;
    }
    Index v = usual + 1;
    for (; v <= usual + kLongest; ++v) {
      const int node = static_cast<int>(std::min(7 + v - usual, Index{kNodes - 1}));
      if (decide(node, 4, expected == v, truth == v)) return v;
    }
    return v + large_valence_.code(port, truth - v);
  }

  // `matched`: what the expected symbol, if there is one, says to the decision.
  template <class Port, class Stream>
  [[gnu::always_inline]] bool decide(Port& port, Stream& stream, const Selectors& selectors, bool matched, bool value) {
    if (!Stream::kMixes || expected_ == MatchModel::kNoSymbol) return stream.code(port, selectors, nullptr, 0, value);
    return decideMatched(port, stream, selectors, matched, value);
  }

  template <class Port, class Stream>
  bool decideMatched(Port& port, Stream& stream, const Selectors& selectors, bool matched, bool value) {
    const bool bit = stream.code(port, selectors, &match_.opinion(matched), match_.lengthClass(), value);
    if (bit != matched) expected_ = MatchModel::kNoSymbol;
    return bit;
  }

  static bool touchesDummy(const FaceQuestion& question, const Gaps& gaps) {
    return gaps[question.gap].dummy || gaps[question.far_gap].dummy || gaps[question.head].dummy ||
           gaps[question.tail].dummy;
  }

  const SectionHeader& header_;
  Predictor<Profile::Vertex::kCount, Profile::kRich> vertices_;
  Predictor<Profile::Face::kCount, Profile::kRich> faces_;
  MatchModel match_;
  History history_;
  UsualValence usual_;
  NumberModel large_valence_, large_degree_, dummy_degree_;
  Index expected_ =
      MatchModel::kNoSymbol;  // what the match expects of the current symbol, until a decision contradicts it
};

}  // namespace tutte
