#pragma once
// The profiles that mix contexts. They differ only in their lists of contexts.

#include <array>

#include "codec/contexts.h"
#include "codec/gaps.h"
#include "codec/match.h"
#include "codec/model.h"
#include "codec/plain_faces.h"
#include "codec/predictor.h"
#include "codec/section.h"
#include "codec/walk.h"

namespace tutte {

template <auto... contexts>
struct ContextList {
  static constexpr int kCount = sizeof...(contexts);
  /// `shared`: what all keys hold, above bit 43.
  template <class Features>
  [[gnu::always_inline]] static std::array<uint64_t, kCount> keys(const Features& features, uint64_t shared) {
    return {(keyOf<contexts>(features) | shared << 44)...};
  }
};

/// A profile has lists of contexts, and says whether it is rich (see Predictor), whether the most frequent degree is
/// asked for first (that takes fewer decisions, and a few bytes more), whether any context looks at the history, and
/// how many more bits than the header says the tables of valences and degrees have: contexts of degrees are few.

/// One context each, nothing to mix.
struct FastProfile {
  using Vertex = ContextList<VertexContext::kPredicted>;
  using Face = ContextList<FaceContext::kEnds>;
  static constexpr bool kRich = false, kUsualDegree = true, kHistory = false;
  static constexpr int kVertexBits = 0, kFaceBits = 0;
};

struct DefaultProfile {
  using Vertex =
      ContextList<VertexContext::kPredicted, VertexContext::kHeadRing, VertexContext::kNothing, VertexContext::kEnds,
                  VertexContext::kSlots, VertexContext::kHistory, VertexContext::kSums>;
  using Face = ContextList<FaceContext::kEnds, FaceContext::kNearAngle, FaceContext::kEdge>;
  static constexpr bool kRich = false, kUsualDegree = true, kHistory = true;
  static constexpr int kVertexBits = 2, kFaceBits = 0;
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
  static constexpr bool kRich = true, kUsualDegree = false, kHistory = true;
  static constexpr int kVertexBits = 3, kFaceBits = 1;
};

/// The usual valence of a face degree's vertices, or the usual degree: the most frequent so far, at least 3.
class UsualSymbol {
 public:
  UsualSymbol() {
    for (Index i = 0; i < 16; ++i) usual_[i] = i == 3 ? 6 : 4;
  }

  Index of(Index symbol_class) const { return usual_[symbol_class]; }

  /// It was the usual one.
  void addUsual(Index symbol_class) { ++counts_[symbol_class][usual_[symbol_class]]; }

  /// It was another one.
  void add(Index symbol_class, Index symbol) {
    if (symbol < 3 || symbol > 15) return;
    auto& counts = counts_[symbol_class];
    if (++counts[symbol] > counts[usual_[symbol_class]]) usual_[symbol_class] = symbol;
  }

 private:
  std::array<std::array<Index, 16>, 16> counts_{};
  std::array<Index, 16> usual_;
};

/// What MixedStatistics lie in, for the most part.
struct StatisticsMemory {
  TableMemory vertices, faces;
  MatchMemory match;
};

/// `degree`: of all faces, when none is a dummy and nothing is matched; 0: any mesh.
template <class Profile, Index degree>
class MixedStatistics {
 public:
  static constexpr bool kGathers = Profile::Vertex::kCount > 1, kSums = false;
  static constexpr Index kDegree = degree;

  MixedStatistics(const SectionHeader& header, StatisticsMemory& memory)
      : header_(header),
        vertices_(header.table_bits + Profile::kVertexBits, header.table_bits, memory.vertices),
        faces_(header.degreesKnown() ? 0 : header.table_bits + Profile::kFaceBits, 1, memory.faces),
        match_(header.match, memory.match) {}

  template <class Port>
  FaceAnswer face(Port& port, const FaceQuestion& question, const FaceAnswer& truth) {
    const FaceAnswer answer = codeFace(port, question, truth);
    if (Profile::kHistory) history_.addDegree(answer.dummy ? 1 : answer.degree);
    if (!plainly_) match_.add(128 + (answer.dummy ? 1 : std::min(answer.degree, Index{100})));
    return answer;
  }

  /// `seed`: whether the face is a component's first; bool, or a constant that is one.
  template <class Port, class Seed>
  [[gnu::always_inline]] Index vertex(Port& port, const VertexQuestion& question, Index truth, Seed seed) {
    const Index face = question.dummy ? 1 : std::min(question.degree, Index{15});
    const Index usual = usual_.of(face);
    const VertexFeatures features(seed, question, history_);
    const uint64_t shared = face | features.missing << 4 | usual << 7;
    const Index expected = match_.expected();
    expected_ = expected < 128 ? expected : MatchModel::kNoSymbol;
    const int situation =
        Profile::kRich ? static_cast<int>(face * 4 + (question.missing > 1) * 2 + (question.index > 0)) : 0;
    bool is_usual;
    const bool is_sure = vertices_.isSure(keyOf<VertexContext::kSums>(features) | shared << 44);
    if (is_sure) {
      is_usual = vertices_.codeSure(port, truth == usual);
      if (!is_usual) vertices_.enter(Profile::Vertex::keys(features, shared));
      if (!is_usual && expected == usual) expected_ = MatchModel::kNoSymbol;
    } else {
      vertices_.enter(Profile::Vertex::keys(features, shared));
      is_usual = decide(port, vertices_, {0, situation}, expected == usual, truth == usual);
      vertices_.noteFirst(is_usual);
    }
    Index valence = usual;
    if (is_usual) {
      usual_.addUsual(face);
    } else {
      valence = codeUnusual(port, usual, seed, truth, expected, situation);
      usual_.add(face, valence);
    }
    if (Profile::kHistory) history_.addValence(valence);
    if (Profile::kRich || !is_sure || !is_usual) match_.add(std::min(valence, Index{100}));
    return valence;
  }

 private:
  static constexpr Index kLongest = 24;

  // Nobody else looks at situations.
  static int situationAt(int situation, int step) { return Profile::kRich ? situation + 64 * step : 0; }

  template <class Port>
  [[gnu::always_inline]] FaceAnswer codeFace(Port& port, const FaceQuestion& question, const FaceAnswer& truth) {
    const Index known = question.closed ? question.known_edges : header_.uniform_degree;
    const bool may_be_dummy = header_.hasDummyFaces() && question.gap != nullptr && !touchesDummy(question);
    plainly_ = false;
    if (known != 0 && !may_be_dummy) return {known, false};
    FaceBounds bounds{known, std::max(header_.leastDegree(), question.known_edges + 1), may_be_dummy};
    const Index expected = known != 0 ? known : usual_degree_.of(0);
    const bool may_be_plain = known != 0 || expected >= bounds.least;
    if (may_be_plain) {
      bounds.not_plain = plain_.isSure(question, expected, may_be_dummy) && matchAllows(expected);
      port.about(known == 0 ? Topic::kDegrees : Topic::kHoles);
      if (bounds.not_plain && plain_.code(port, !truth.dummy && truth.degree == expected)) {
        if (known == 0) usual_degree_.addUsual(0);
        plainly_ = true;
        return {expected, false};
      }
    }
    const FaceAnswer answer = codeUnknownFace(port, question, truth, bounds);
    if (may_be_plain && !bounds.not_plain) plain_.note(!answer.dummy && answer.degree == expected);
    return answer;
  }

  // What is known of a face: its degree, or 0; the least that it can be; and that it is not plain.
  struct FaceBounds {
    Index known, least;
    bool may_be_dummy, not_plain = false;
  };

  // Does the match expect no other face than one of this degree?
  bool matchAllows(Index expected) const {
    const Index symbol = match_.expected();
    return symbol == MatchModel::kNoSymbol || symbol < 128 || symbol == 128 + expected;
  }

  // The most frequent degree, if it is possible, is asked for first.
  template <class Port>
  [[gnu::noinline]] FaceAnswer codeUnknownFace(Port& port, const FaceQuestion& question, FaceAnswer truth,
                                               FaceBounds bounds) {
    const FaceFeatures features(question, history_);
    const Index known = bounds.known, least = bounds.least;
    const Index usual = Profile::kUsualDegree ? usual_degree_.of(0) : 0;
    faces_.enter(Profile::Face::keys(features, std::min(usual, Index{15})));
    const Index symbol = match_.expected(), expected = symbol - 128;
    expected_ = symbol >= 128 ? symbol : MatchModel::kNoSymbol;
    const int situation =
        Profile::kRich ? static_cast<int>(features.behind * 3 + std::min(features.known, 3u) - (features.known > 0))
                       : 0;
    const auto decide = [&](int node, int step, bool matched, bool value) {
      return this->decide(port, faces_, {node, situationAt(situation, step)}, matched, value);
    };
    port.about(Topic::kDegrees);
    if (known == 0 && usual >= least && !bounds.not_plain &&
        decide(0, 0, expected == usual, !truth.dummy && truth.degree == usual)) {
      usual_degree_.addUsual(0);
      return {usual, false};
    }
    port.about(Topic::kHoles);
    const bool must_be_dummy = bounds.not_plain && known != 0;
    if (must_be_dummy || (bounds.may_be_dummy && decide(1, 1, expected == 1, truth.dummy))) {
      return {question.closed ? known : 3 + dummy_degree_.code(port, truth.degree - 3), true};
    }
    if (known != 0) return {known, false};
    port.about(Topic::kDegrees);
    const Index coded = codeUnusualDegree(port, usual, least, truth.degree, expected, decide);
    usual_degree_.add(0, coded);
    return {coded, false};
  }

  template <class Port, class Decide>
  Index codeUnusualDegree(Port& port, Index usual, Index least, Index truth, Index expected, Decide&& decide) {
    if (usual > least && decide(2, 2, expected < usual, truth < usual)) {
      for (Index d = usual - 1; d > least; --d) {
        if (decide(static_cast<int>(std::min(2 + usual - d, Index{6})), 3, expected == d, truth == d)) return d;
      }
      return least;
    }
    Index d = std::max(usual + 1, least);
    const Index most = d + kLongest - 5;
    for (; d <= most; ++d) {
      const int node = static_cast<int>(std::min(6 + d - usual, Index{kNodes - 1}));
      if (decide(node, 4, expected == d, truth == d)) return d;
    }
    return d + large_degree_.code(port, truth - d);
  }

  template <class Port>
  [[gnu::noinline]] Index codeUnusual(Port& port, Index usual, bool seed, Index truth, Index expected, int situation) {
    const auto decide = [&](int node, int step, bool matched, bool value) {
      return this->decide(port, vertices_, {node, situationAt(situation, step)}, matched, value);
    };
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
  [[gnu::always_inline]] bool decide(Port& port, Stream& stream, Selectors selectors, bool matched, bool value) {
    if constexpr (Stream::kMixes && degree == 0) {
      if (expected_ != MatchModel::kNoSymbol) return decideMatched(port, stream, selectors, matched, value);
    }
    return stream.code(port, selectors, value);
  }

  template <class Port, class Stream>
  [[gnu::noinline]] bool decideMatched(Port& port, Stream& stream, Selectors selectors, bool matched, bool value) {
    const bool bit = stream.code(port, selectors, match_.opinion(matched), match_.lengthClass(), value);
    if (bit != matched) expected_ = MatchModel::kNoSymbol;
    return bit;
  }

  static bool touchesDummy(const FaceQuestion& question) {
    return question.gap->dummy | question.far_gap->dummy | question.head->dummy | question.tail->dummy;
  }

  const SectionHeader& header_;
  Predictor<Profile::Vertex::kCount, Profile::kRich> vertices_;
  Predictor<Profile::Face::kCount, Profile::kRich> faces_;
  std::conditional_t<degree == 0, MatchModel, NoMatch> match_;
  History history_;
  UsualSymbol usual_;         // valences, by the face's degree
  UsualSymbol usual_degree_;  // all degrees in one class
  PlainFaces<Profile::kRich ? 127 : 63> plain_;
  bool plainly_ = false;  // nothing but a flag of plain_ was coded of the last face
  NumberModel large_valence_, large_degree_, dummy_degree_;
  Index expected_ =
      MatchModel::kNoSymbol;  // what the match expects of the current symbol, until a decision contradicts it
};

}  // namespace tutte
