#pragma once
// Which umbrellas an edge joins.

#include <numeric>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// The umbrellas at the far ends of each umbrella's edges. At most 8 bytes per corner, built in O(corners).
class UmbrellaNeighbors {
 public:
  explicit UmbrellaNeighbors(const Connectivity& mesh) : end_(mesh.umbrella_count + size_t{1}, 0) {
    forEdges(mesh, [&](Index a, Index b) { ++end_[a + 1], ++end_[b + 1]; });
    std::partial_sum(end_.begin(), end_.end(), end_.begin());
    neighbors_.resize(end_.back());
    std::vector<Index> at(end_.begin(), end_.end() - 1);
    forEdges(mesh, [&](Index a, Index b) { neighbors_[at[a]++] = b, neighbors_[at[b]++] = a; });
  }

  /// One per edge, in the order of the edges' first corners.
  std::span<const Index> of(Index umbrella) const {
    return {neighbors_.data() + end_[umbrella], end_[umbrella + 1] - end_[umbrella]};
  }

 private:
  // An edge belongs to its first corner.
  template <class Visit>
  static void forEdges(const Connectivity& mesh, Visit visit) {
    const Index* const twins = mesh.twins.data();
    const Index* const umbrellas = mesh.umbrellas.data();
    Index first = 0;
    for (const Index degree : mesh.face_degrees) {
      if (degree == 0) continue;
      const Index last = first + degree - 1;
      for (Index corner = first; corner < last; ++corner) {
        if (twins[corner] > corner) visit(umbrellas[corner], umbrellas[corner + 1]);
      }
      if (twins[last] > last) visit(umbrellas[last], umbrellas[first]);
      first = last + 1;
    }
  }

  std::vector<size_t> end_;  // of the umbrella before
  std::vector<Index> neighbors_;
};

}  // namespace tutte
