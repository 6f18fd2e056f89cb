#pragma once
// Which way the quads of a mesh are cut into triangles.

#include <algorithm>
#include <array>
#include <vector>

#include "codec/mesh.h"
#include "codec/model.h"

namespace tutte {

/// Guesses a quad's diagonal from the quads around it that are known: does theirs touch the shared edge's origin or
/// its end? In a regular grid all diagonals are parallel, so those of neighbours touch opposite ends.
class DiagonalModel {
 public:
  explicit DiagonalModel(const Connectivity& mesh) : mesh_(mesh), touched_(mesh.twins.size(), kUnknown) {}

  /// The lower of the two corners (0 or 1) that the diagonal of a quad joins. Flipping a quad does not change it.
  template <class Port>
  Index code(Port& port, Index first_corner, Index apex) {
    const Index* const twins = &mesh_.twins[first_corner];
    const uint32_t votes = votesFor(twins[0]) + votesFor(twins[2]) + swapped(votesFor(twins[1]) + votesFor(twins[3]));
    const uint32_t first = votes % 8, second = votes / 8;
    const uint32_t context = std::min(first, 2u) * 3 + std::min(second, 2u);
    const bool diagonal = models_[context * 2 + last_wrong_].code(port, apex != 0);
    last_wrong_ = diagonal != (second > first);
    static constexpr std::array<uint8_t, 5> kTouches{kTouched, kUntouched, kTouched, kUntouched, kTouched};
    std::copy_n(&kTouches[diagonal], 4, &touched_[first_corner]);
    return diagonal;
  }

 private:
  // Per corner, as the vote of the quad beyond an even edge: for the first diagonal in bits 0 to 2, for the second one
  // in bits 3 to 5.
  static constexpr uint8_t kUnknown = 0, kUntouched = 8, kTouched = 1;

  uint32_t votesFor(Index twin) const { return twin == kNone ? kUnknown : touched_[twin]; }

  // As votes of quads beyond odd edges.
  static uint32_t swapped(uint32_t vote) { return vote / 8 + vote % 8 * 8; }

  const Connectivity& mesh_;
  std::vector<uint8_t> touched_;  ///< per corner: by a diagonal; kUnknown but in quads that were coded as fans
  std::array<Bit, 18> models_;
  bool last_wrong_ = false;
};

}  // namespace tutte
