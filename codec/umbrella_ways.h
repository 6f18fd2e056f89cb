#pragma once
// Steps from corner to corner around an umbrella.

#include "codec/face_ways.h"
#include "codec/mesh.h"

namespace tutte {

/// Where each corner's neighbours around its vertex are. Every edge with two faces has two *ends*; the end at corner
/// c's vertex of the edge from c to the next corner of its face joins c with across(c). So edge-ends are named by
/// corners, and the other end of the same edge is twins[c]. The mesh must outlive it.
class UmbrellaWays : public FaceWays {
 public:
  explicit UmbrellaWays(const Connectivity& mesh) : FaceWays(mesh), mesh_(mesh) {}

  const Connectivity& mesh() const { return mesh_; }
  Index twin(Index corner) const { return mesh_.twins[corner]; }
  Index umbrella(Index corner) const { return mesh_.umbrellas[corner]; }

  /// The corner on the other side of its edge to the next; kNone at a boundary, and for kNone.
  Index across(Index corner) const {
    const Index twin = corner == kNone ? kNone : mesh_.twins[corner];
    return twin == kNone ? kNone : next(twin);
  }
  /// The inverse: across(back(c)) == c.
  Index back(Index corner) const { return corner == kNone ? kNone : mesh_.twins[prev(corner)]; }

 private:
  const Connectivity& mesh_;
};

}  // namespace tutte
