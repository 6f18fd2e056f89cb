#pragma once
// Which vertices of two scenes may be the same: by place, then by the faces around them.

#include <optional>
#include <string>
#include <vector>

#include "tools/flat_scene.h"

namespace tutte {

/// Labels of one scene's vertices and faces: equal in both scenes for what may be the same.
struct ClassLabels {
  std::vector<uint64_t> vertices;
  std::vector<uint64_t> faces;
};

/// Where two scenes first differ. Indices are kNone when there is no such thing.
struct Difference {
  std::string what;
  Index vertex_a = kNone, vertex_b = kNone;
  Index face_a = kNone, face_b = kNone;
};

struct ClassPair {
  ClassLabels a, b;
  std::optional<Difference> difference;  ///< something has no counterpart
};

/// Groups vertices by place: those that are within the tolerance of each other, or linked by others that are, share a
/// number. Coarse where tolerances exceed the distances of vertices. O(n log n).
struct PlaceNumbers {
  std::vector<Index> a, b;  ///< per vertex
  Index count = 0;
};
PlaceNumbers numberPlaces(const FlatScene& a, const FlatScene& b);

/// Labels by place and, where that leaves several vertices with one label, refined by the labels of the vertices around
/// them, in cyclic order, until nothing more can be told apart. The first stage at which the two scenes have different
/// labels gives the difference. With `vertices_matter` false, coincident vertices count as one.
/// O(n log n) per round, at most kMaxRounds rounds.
ClassPair classify(const FlatScene& a, const FlatScene& b, const PlaceNumbers& places, bool vertices_matter);
inline constexpr int kMaxRounds = 24;

}  // namespace tutte
