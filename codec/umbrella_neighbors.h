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
    Index first = 0;
    for (const Index degree : mesh.face_degrees) {
      for (Index corner = first; corner < first + degree; ++corner) {
        const Index next = corner + 1 == first + degree ? first : corner + 1;
        if (mesh.twins[corner] > corner) visit(mesh.umbrellas[corner], mesh.umbrellas[next]);
      }
      first += degree;
    }
  }

  std::vector<size_t> end_;  // of the umbrella before
  std::vector<Index> neighbors_;
};

}  // namespace tutte
