#pragma once
// Any polygons -> a closed, oriented manifold that the walk can follow, and notes on what was done to make it one.

#include <vector>

#include "codec/edges.h"
#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// The manifold. Its faces are the input's faces of degree 3 and more (some turned round), then the dummy faces that
/// close its holes. Every edge has a twin; the corners around an umbrella form one closed ring.
///
/// What is cut: edges of more than two faces into pairs, edges whose two faces cannot be oriented alike (Moebius
/// strips), faces that repeat a vertex from everything else, and with them vertices into umbrellas.
struct Topology {
  FaceCorners faces;                 ///< `vertex` names umbrellas
  std::vector<Index> twin;           ///< per corner
  std::vector<Index> valence;        ///< per umbrella: corners around it, dummy faces' included
  std::vector<Index> vertex_of;      ///< per umbrella: input vertex; the first umbrella of vertex v has number v, and
                                     ///< umbrellas below the input's vertex count without corners do not occur
  std::vector<Index> source_corner;  ///< per real corner: input corner; empty: the same
  std::vector<Index> source_face;    ///< per real face: input face; empty: the same
  std::vector<uint8_t> flipped;      ///< per real face; empty: none
  std::vector<Index> strays;         ///< input faces of degree 0, 1 and 2
  Index real_faces = 0;              ///< dummy faces come after them
  std::vector<uint8_t> dummy_umbrella;  ///< per umbrella, only in a dual: it is a dummy face; empty: none is

  bool isDummy(Index face) const { return face >= real_faces; }
};

/// O(n log n) time, O(n) memory. Errors: kIndexOutOfRange, kCountMismatch, kTooLarge.
Result<Topology> buildTopology(PolygonView mesh);

}  // namespace tutte
