#pragma once
// Profile `paper`: the symbols of section 3.4.1 and the contexts of section 3.4.2 of Khodakovsky, Alliez, Desbrun,
// Schroeder 2002.

#include <array>

#include "codec/gaps.h"
#include "codec/model.h"
#include "codec/section.h"
#include "codec/walk.h"

namespace tutte {

struct StatisticsMemory;

/// The context of a face's degree: the degree of the face behind its first edge, and whether the valences at the ends
/// of that edge are together below, at, or above what is regular there. 0 to 6.
inline Index paperFaceContext(const FaceQuestion& question) {
  if (question.gap == nullptr) return 0;
  const Index behind = question.gap->degree_behind;
  if (behind != 3 && behind != 4) return 0;
  const Index regular = behind == 3 ? 12 : 8;
  const Index sum = question.gap->valence + question.far_gap->valence;
  return (behind == 3 ? 2 : 5) + (sum > regular) - (sum < regular);
}

/// The context of a vertex's valence: the degree of its face, and whether the face's known vertices have valences
/// below, at, or above the regular one on average. 0 to 7.
inline Index paperVertexContext(const VertexQuestion& question) {
  const Index degree = question.dummy ? 0 : question.degree;
  if (degree == 5) return 1;
  if (degree != 3 && degree != 4) return 0;
  const uint64_t regular = uint64_t{question.knownVertices()} * (degree == 3 ? 6 : 4);
  const uint64_t sum = question.valence_sum;
  return (degree == 3 ? 3 : 6) + (sum > regular) - (sum < regular);
}

/// What a Statistics class offers: coding of one symbol, given the truth (in the encoder) and a port. Degrees that
/// are known (header) are not asked for. kGathers: it reads what gaps gather of their surroundings; kSums: sums of
/// valences.
class PaperStatistics {
 public:
  static constexpr bool kGathers = false, kSums = true;
  static constexpr Index kDegree = 0;

  PaperStatistics(const SectionHeader& header, StatisticsMemory&) : header_(header) {}

  template <class Port>
  FaceAnswer face(Port& port, const FaceQuestion& question, const FaceAnswer& truth) {
    const Index context = paperFaceContext(question);
    FaceAnswer answer{question.closed ? question.known_edges : header_.uniform_degree, false};
    if (answer.degree != 0) {
      port.about(Topic::kHoles);
      answer.dummy = header_.hasDummyFaces() && question.gap != nullptr && dummy_[context].code(port, truth.dummy);
      if (answer.dummy && !question.closed) answer.degree = 3 + dummy_degree_.code(port, truth.degree - 3);
      return answer;
    }
    const Index large = truth.degree >= kSymbols ? kEscape : truth.degree;
    const Index symbol = degree_[context].code(port, truth.dummy ? kDummy : large);
    if (symbol == kDummy) return {3 + dummy_degree_.code(port, truth.degree - 3), true};
    if (symbol == kEscape) return {kSymbols + large_degree_.code(port, truth.degree - kSymbols), false};
    return {symbol, false};
  }

  template <class Port>
  Index vertex(Port& port, const VertexQuestion& question, Index truth, bool /*seed*/) {
    const Index context = paperVertexContext(question);
    const Index symbol = valence_[context].code(port, truth >= kSymbols ? kEscape : truth);
    return symbol == kEscape ? kSymbols + large_valence_.code(port, truth - kSymbols) : symbol;
  }

 private:
  static constexpr Index kSplit = 0, kEscape = 1, kDummy = 2, kSymbols = 16;

  const SectionHeader& header_;
  std::array<SymbolModel<kSymbols>, 8> valence_;
  std::array<SymbolModel<kSymbols>, 7> degree_;
  std::array<Bit, 7> dummy_;
  NumberModel large_valence_, large_degree_, dummy_degree_;
};

}  // namespace tutte
