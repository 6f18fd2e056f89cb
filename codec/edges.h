#pragma once
// Which edges of which faces lie on each other.

#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Faces as corner ranges: the corners of face f are first[f] to first[f + 1] - 1, and corner c names vertex[c]. The
/// edge of a corner runs to the next corner of its face.
struct FaceCorners {
  std::vector<Index> first;
  std::vector<Index> vertex;
  std::vector<Index> face;  ///< per corner, unless all faces are triangles
  bool triangles = false;   ///< all faces are

  Index faceCount() const { return static_cast<Index>(first.size()) - 1; }
  Index faceOf(Index corner) const { return triangles ? corner / 3 : face[corner]; }
  Index next(Index corner) const {
    if (triangles) return corner % 3 == 2 ? corner - 2 : corner + 1;
    const Index f = face[corner];
    return corner + 1 == first[f + 1] ? first[f] : corner + 1;
  }
  Index prev(Index corner) const {
    if (triangles) return corner % 3 == 0 ? corner + 2 : corner - 1;
    const Index f = face[corner];
    return corner == first[f] ? first[f + 1] - 1 : corner - 1;
  }

  /// Other faces than triangles can follow.
  void listFaces();
};

/// Which edges are paired.
struct EdgePairs {
  std::vector<Index> twin;  ///< per corner: the corner whose edge lies on this corner's edge; kNone: nobody's
  bool conflicts = false;   ///< some paired edges run in the same direction
};

/// Pairs each edge with another of a different face between the same vertices: opposite ones first, where there are
/// several those closest in corner order that are not two sides of one face; where `allow_conflicts`, also the only two
/// edges between two vertices although they run in the same direction. Faces marked in `isolated` (may be empty) stay
/// unpaired. O(n log n), and O(n) for meshes.
EdgePairs pairEdges(const FaceCorners& faces, Index vertex_count, std::span<const uint8_t> isolated,
                    bool allow_conflicts);

}  // namespace tutte
