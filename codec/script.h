#pragma once
// The symbols of the connectivity section, written once for both directions: each member asks the oracle (which knows
// in the encoder and is blind in the decoder), codes the answer through a port, and returns what was coded.
//
// Statistics: sections 3.4.1 and 3.4.2 of Khodakovsky, Alliez, Desbrun, Schroeder 2002.

#include <array>

#include "codec/gaps.h"
#include "codec/model.h"
#include "codec/section.h"
#include "codec/walk.h"

namespace tutte {

/// The oracle of a decoder.
struct Blind {
  static bool component() { return false; }
  static void seed() {}
  static void start(const Gap&) {}
  static void step() {}
  static void cross(Gap&, Index) {}
  static FaceAnswer face() { return {}; }
  static Index vertex() { return 0; }
  static SplitAnswer split(const Gaps&) { return {}; }
};

/// Watches nothing.
struct NoObserver {
  static void face(const FaceAnswer&, Index) {}
  static void vertex(Index, Index) {}
  static void split(const SplitAnswer&) {}
};

/// The context of a face's degree: the degree of the face behind its first edge, and whether the valences at the ends
/// of that edge are together below, at, or above what is regular there. 0 to 6.
inline Index faceContext(const FaceQuestion& question, const Gaps& gaps) {
  if (question.gap == kNone) return 0;
  const Index behind = gaps[question.gap].degree_behind;
  if (behind != 3 && behind != 4) return 0;
  const Index regular = behind == 3 ? 12 : 8;
  const Index sum = gaps[question.gap].valence + gaps[question.far_gap].valence;
  return (behind == 3 ? 2 : 5) + (sum > regular) - (sum < regular);
}

/// The context of a vertex's valence: the degree of its face, and whether the face's known vertices have valences
/// below, at, or above the regular one on average. 0 to 7.
inline Index vertexContext(const VertexQuestion& question) {
  const Index degree = question.face.dummy ? 0 : question.face.degree;
  if (degree == 5) return 1;
  if (degree != 3 && degree != 4) return 0;
  const uint64_t regular = uint64_t{question.known_vertices} * (degree == 3 ? 6 : 4);
  const uint64_t sum = question.valence_sum;
  return (degree == 3 ? 3 : 6) + (sum > regular) - (sum < regular);
}

/// Codes a mesh's symbols through two ports, one for valences and splits, one for degrees.
template <class Port, class Oracle, class Observer = NoObserver>
class Script {
 public:
  Script(const SectionHeader& header, Port& valences, Port& degrees, Oracle& oracle, Observer observer = {})
      : header_(header), valences_(valences), degrees_(degrees), oracle_(oracle), observer_(observer) {}

  bool component() { return component_.code(valences_, oracle_.component()); }

  FaceAnswer face(const FaceQuestion& question, const Gaps& gaps) {
    const Index context = faceContext(question, gaps);
    const FaceAnswer answer = codeFace(question, context, oracle_.face());
    observer_.face(answer, context);
    return answer;
  }

  Index vertex(const VertexQuestion& question) {
    const Index context = vertexContext(question);
    const Index valence = codeVertex(context, oracle_.vertex());
    observer_.vertex(valence, context);
    return valence;
  }

  SplitAnswer split(const Gaps& gaps, bool last) {
    SplitAnswer answer = oracle_.split(gaps);
    answer.gap = valences_.uniform(gaps.highWater(), answer.gap);
    // At least one slot remains before the face, and one after its last vertex.
    const Index slots = gaps[answer.gap].free_slots, least = last ? 1 : 0;
    if (slots < 2 + least) return {};
    answer.slots_after = least + valences_.uniform(slots - 1 - least, answer.slots_after - least);
    observer_.split(answer);
    return answer;
  }

  bool overrun() const { return valences_.overrun() || degrees_.overrun(); }

  void seed() { oracle_.seed(); }
  void start(const Gap& gap) { oracle_.start(gap); }
  void step() { oracle_.step(); }
  void cross(Gap& gap, Index number) { oracle_.cross(gap, number); }

 private:
  static constexpr Index kSplit = 0, kEscape = 1, kDummy = 2, kSymbols = 16;

  FaceAnswer codeFace(const FaceQuestion& question, Index context, const FaceAnswer& truth) {
    FaceAnswer answer{question.closed ? question.known_edges : header_.uniform_degree, false};
    if (answer.degree != 0) {
      answer.dummy = !header_.closed && question.gap != kNone && dummy_[context].code(degrees_, truth.dummy);
      if (answer.dummy && !question.closed) answer.degree = 3 + dummy_degree_.code(degrees_, truth.degree - 3);
      return answer;
    }
    const Index large = truth.degree >= kSymbols ? kEscape : truth.degree;
    const Index symbol = degree_[context].code(degrees_, truth.dummy ? kDummy : large);
    if (symbol == kDummy) return {3 + dummy_degree_.code(degrees_, truth.degree - 3), true};
    if (symbol == kEscape) return {kSymbols + large_degree_.code(degrees_, truth.degree - kSymbols), false};
    return {symbol, false};
  }

  Index codeVertex(Index context, Index truth) {
    const Index symbol = valence_[context].code(valences_, truth >= kSymbols ? kEscape : truth);
    return symbol == kEscape ? kSymbols + large_valence_.code(valences_, truth - kSymbols) : symbol;
  }

  const SectionHeader& header_;
  Port& valences_;
  Port& degrees_;
  Oracle& oracle_;
  Observer observer_;
  Bit component_;
  std::array<SymbolModel<kSymbols>, 8> valence_;
  std::array<SymbolModel<kSymbols>, 7> degree_;
  std::array<Bit, 7> dummy_;
  NumberModel large_valence_, large_degree_, dummy_degree_;
};

}  // namespace tutte
