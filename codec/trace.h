#pragma once
// Decoding, symbol by symbol: for people who want to see what a connectivity section says.

#include <cstdint>
#include <functional>
#include <span>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// One symbol of the traversal, and where it stands. Fields that its kind does not name are 0.
struct TraceEvent {
  enum class Kind : uint8_t {
    kComponent,  ///< another component begins
    kEnd,        ///< there is no other component
    kFace,       ///< a face of `degree` is attached: degree, dummy, closed, known_edges, degree_behind, gap
    kVertex,     ///< the current face's next vertex is new: valence, missing, known_vertices, valence_sum
    kSplit,      ///< the current face's next vertex is in the region already: gap, slots_after, missing
  };
  Kind kind = Kind::kEnd;

  // Running numbers: of the component; of the face, where a dummy face has the number of the next that is none; of the
  // next new umbrella.
  Index component = 0, face = 0, umbrella = 0;

  Index degree = 0;
  bool dummy = false;
  bool closed = false;      ///< the region knows all edges of the face: nothing was coded
  bool seed = false;        ///< the first face of its component
  Index known_edges = 0;    ///< edges that the face shares with the region
  Index degree_behind = 0;  ///< of the face behind the edge where it is attached; 0: a dummy face, or a seed

  Index valence = 0;
  Index missing = 0;         ///< vertices that the face lacked, this one included
  Index known_vertices = 0;  ///< vertices of the face that were known
  uint64_t valence_sum = 0;  ///< their valences

  Index gap = 0;          ///< where the face is attached, or which gap is split
  Index slots_after = 0;  ///< of the gap that is split, on the side of its leaving edge
};

using TraceSink = std::function<void(const TraceEvent&)>;

/// Decodes a connectivity section as decode() does, and calls `sink`, which must not be empty, once per symbol of the
/// traversal until the end or the first error. A split is two symbols on paper (the valence says "split"), but one
/// event. Any bytes may be passed; the errors are those of decode().
Error trace(std::span<const uint8_t> bytes, const Limits& limits, const TraceSink& sink);

}  // namespace tutte
