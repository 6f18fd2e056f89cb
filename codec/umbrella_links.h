#pragma once
// Steps from corner to corner around an umbrella.

#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Where each corner's neighbours around its vertex are. Every edge with two faces has two *ends*; the end at corner
/// c's vertex of the edge from c to the next corner of its face joins c with across[c]. So edge-ends are named by
/// corners, and the other end of the same edge is twins[c]. 16 bytes per corner, built in O(corners).
struct UmbrellaLinks {
  std::vector<Index> across;  ///< per corner: the corner on the other side of its edge to the next; kNone at a boundary
  std::vector<Index> back;    ///< the inverse: across[back[c]] == c
  std::vector<Index> next;    ///< per corner: the one after it in its face
  std::vector<Index> prev;    ///< per corner: the one before it in its face
  std::vector<uint8_t> open;  ///< per umbrella: 1 when its corners form a fan, 0 when they form a cycle

  explicit UmbrellaLinks(const Connectivity& mesh)
      : across(mesh.umbrellas.size(), kNone),
        back(mesh.umbrellas.size(), kNone),
        next(mesh.umbrellas.size()),
        prev(mesh.umbrellas.size()),
        open(mesh.umbrella_count, 0) {
    Index first = 0;
    for (const Index degree : mesh.face_degrees) {
      for (Index corner = first; corner < first + degree; ++corner) {
        next[corner] = corner + 1 == first + degree ? first : corner + 1;
        prev[next[corner]] = corner;
        leave(mesh, corner);
      }
      first += degree;
    }
  }

 private:
  void leave(const Connectivity& mesh, Index corner) {
    const Index twin = mesh.twins[corner];
    if (twin == kNone) {
      open[mesh.umbrellas[corner]] = 1;
    } else {
      across[twin] = next[corner];
      back[next[corner]] = twin;
    }
  }
};

}  // namespace tutte
