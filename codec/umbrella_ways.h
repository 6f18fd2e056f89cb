#pragma once
// Steps from corner to corner around an umbrella.

#include "codec/mesh.h"
#include "codec/mesh_ways.h"

namespace tutte {

/// Where each corner's neighbours around its vertex are. Every edge with two faces has two *ends*; the end at corner
/// c's vertex of the edge from c to the next corner of its face joins c with across(c). So edge-ends are named by
/// corners, and the other end of the same edge is twins[c]. Mesh and ways must outlive it.
class UmbrellaWays {
 public:
  UmbrellaWays(const Connectivity& mesh, const MeshWays& ways) : mesh_(mesh), ways_(ways) {}

  const Connectivity& mesh() const { return mesh_; }
  Index next(Index corner) const { return ways_.faces.next(corner); }
  Index prev(Index corner) const { return ways_.faces.prev(corner); }
  Index degree(Index corner) const { return ways_.faces.degree(corner); }
  Index twin(Index corner) const { return mesh_.twins[corner]; }
  Index umbrella(Index corner) const { return mesh_.umbrellas[corner]; }

  /// The corner on the other side of its edge to the next; kNone at a boundary, and for kNone.
  Index across(Index corner) const {
    const Index twin = corner == kNone ? kNone : mesh_.twins[corner];
    return twin == kNone ? kNone : next(twin);
  }
  /// The inverse: across(back(c)) == c.
  Index back(Index corner) const { return corner == kNone ? kNone : mesh_.twins[prev(corner)]; }

  /// The one that goRound() begins with: of an open umbrella, that whose own edge is a boundary; the lowest otherwise.
  Index first(Index umbrella) const { return ways_.firsts[umbrella]; }

  /// Calls visit(corner) for all corners of an umbrella, each followed by what is back from it.
  template <class Visit>
  void goRound(Index umbrella, Visit visit) const {
    const Index begin = first(umbrella);
    Index corner = begin;
    do {
      visit(corner);
      corner = back(corner);
    } while (corner != kNone && corner != begin);
  }

 private:
  const Connectivity& mesh_;
  const MeshWays& ways_;
};

}  // namespace tutte
