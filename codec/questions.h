#pragma once
// What the walk asks, and what it is told.
//
// A *Script* answers them: it offers
//   static constexpr Index kDegree         all faces' degree, when none is a dummy; 0: faces are asked for theirs
//   bool component()                       is there another component?
//   Index original() const                 the number of the one that it repeats, or kNone
//   FaceAnswer face(const FaceQuestion&)
//   VertexAnswer vertex(const VertexQuestion&)
//   SplitAnswer split(const VertexQuestion&, const Gaps&)
//   static constexpr bool kGathers         do its answers depend on what Gap gathers of the surroundings?
//   static constexpr bool kSums            ... on sums of valences?
//   bool faulty()                          must the walk stop? To be asked now and then
//   Error fault()                          why
// and follows, where it stands on an input mesh, the position of the walk:
//   void seed()                  before the first face of a component
//   void start(const Gap& gap)   at the far end of the edge that leaves the gap, in the face outside
//   void step()                  on to the next corner of the face
//   void cross(const Gap& gap)   the gap's leaving edge becomes the edge from the next corner back to this one

#include <array>
#include <cstdint>

#include "codec/gaps.h"
#include "codec/mesh.h"

namespace tutte {

/// What is known of a face before its degree is.
struct FaceQuestion {
  const Gap* gap = nullptr;      ///< where it is attached; null for the first face of a component
  const Gap* far_gap = nullptr;  ///< the gap at the far end of that edge
  const Gap* head = nullptr;     ///< the first vertex of the face on the boundary
  const Gap* tail = nullptr;     ///< the last one
  Index known_edges = 0;         ///< edges that it shares with the region
  bool closed = false;           ///< all its edges are known: its degree is known_edges
};

/// A face's degree. A dummy face closes a hole and is not part of the mesh.
struct FaceAnswer {
  Index degree = 0;
  bool dummy = false;
};

/// What is known of a missing vertex of the current face.
struct VertexQuestion {
  Index degree = 0;                  ///< of the face
  bool dummy = false;                ///< it is a dummy
  const Gap* head = nullptr;         ///< where the face's missing vertices end; null in the first face of a component
  const Gap* current = nullptr;      ///< the vertex before this one; null for the first vertex of a component
  const Gap* before_tail = nullptr;  ///< the vertex before the first missing one's predecessor; null likewise
  Index index = 0;                   ///< missing vertices of the face that were coded before
  Index missing = 0;                 ///< vertices of the face that are still missing, this one included
  uint64_t valence_sum = 0;          ///< sum of the valences of those that are known, if the statistics ask for it
  int64_t angle = 0;                 ///< sum over them of 1 - 2 / valence, in 1/65536

  Index knownVertices() const { return degree - missing; }
};

/// A missing vertex. In the dual of a mesh with holes it may stand for a dummy face.
struct VertexAnswer {
  Index valence = 0;  ///< 2 or more; 0: a split
  bool dummy = false;
};

/// A vertex that the region has already: one of its gaps, and how many of that gap's free slots remain on the side of
/// its leaving edge.
struct SplitAnswer {
  Index gap = kNone;
  Index slots_after = 0;
};

inline constexpr std::array<int32_t, 64> kFlatAngles = [] {
  std::array<int32_t, 64> table{};
  for (int i = 1; i < 64; ++i) table[i] = 65536 - 131072 / i;
  return table;
}();

/// The angle of a regular polygon with `sides` sides, as a fraction of a half turn in 1/65536: 1 - 2 / sides.
inline int32_t flatAngle(Index sides) {
  return sides < kFlatAngles.size() ? kFlatAngles[sides] : 65536 - static_cast<int32_t>(131072 / sides);
}

}  // namespace tutte
