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
    const uint32_t votes = votesFor(first_corner, 0) + swapped(votesFor(first_corner, 1)) + votesFor(first_corner, 2) +
                           swapped(votesFor(first_corner, 3));
    const uint32_t first = votes % 8, second = votes / 8;
    const uint32_t context = std::min(first, 2u) * 3 + std::min(second, 2u);
    const bool diagonal = models_[context * 2 + last_wrong_].code(port, apex != 0);
    last_wrong_ = diagonal != (second > first);
    const uint8_t even = diagonal ? kUntouched : kTouched, odd = diagonal ? kTouched : kUntouched;
    std::ranges::copy(std::array{even, odd, even, odd}, &touched_[first_corner]);
    return diagonal;
  }

 private:
  // Per corner, as the vote of the quad beyond an even edge: for the first diagonal in bits 0 to 2, for the second one
  // in bits 3 to 5.
  static constexpr uint8_t kUnknown = 0, kUntouched = 8, kTouched = 1;

  uint32_t votesFor(Index first_corner, Index i) const {
    const Index twin = mesh_.twins[first_corner + i];
    return twin == kNone ? kUnknown : touched_[twin];
  }

  // As the vote of the quad beyond an odd edge.
  static uint32_t swapped(uint32_t vote) { return vote / 8 + vote % 8 * 8; }

  const Connectivity& mesh_;
  std::vector<uint8_t> touched_;  ///< per corner: by a diagonal; kUnknown but in quads that were coded as fans
  std::array<Bit, 18> models_;
  bool last_wrong_ = false;
};

}  // namespace tutte
