#pragma once
// What a decision of the connectivity coder is about. Whoever codes says so to the port (about()); the range coder's
// own ports do not listen, so it costs them nothing.

#include <cstdint>

namespace tutte {

enum class Topic : uint8_t {
  kComponents,  ///< whether another component follows
  kCopies,      ///< whether it repeats an earlier one, and which
  kValences,    ///< of new vertices (in a dual: of umbrellas that stand for faces)
  kSplits,      ///< that a vertex is in the region already, and where
  kDegrees,     ///< of faces (in a dual: of faces that stand for vertices)
  kHoles,       ///< which faces are dummies, and their degrees (in a dual: which umbrellas)
  kFlips,       ///< which faces were turned round
  kStrays,      ///< faces of degree 0, 1 and 2
  kJoins,       ///< which umbrellas share a vertex
  kIsolated,    ///< vertices without a corner
};
inline constexpr int kTopicCount = 10;

}  // namespace tutte
