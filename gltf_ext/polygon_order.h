#pragma once
// An order of faces in which most vertices can be predicted well, and fans that suit it.

#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// What both sides derive from the connectivity before positions are coded.
struct PolygonOrder {
  std::vector<Index> faces;    ///< all faces of degree 3 or more
  std::vector<Index> anchors;  ///< per face: the corner, counted within the face, at which its fan of triangles starts
};

/// Grows regions face by face; a vertex is known once a face of it was taken. The next face is one beside a taken face
/// that has no unknown vertex; failing that, one of degree above 3 with one unknown vertex, or a triangle whose unknown
/// vertex had been met before from another side; failing that, a triangle with one unknown vertex; failing that, any
/// beside a taken face; failing that, the first that is left. Among equals the last met comes first, and a taken face
/// meets its neighbours from the last edge to the first. The rank of a face is that of the moment it was met.
///
/// The anchor is the first known corner after an unknown one, so that each unknown vertex is the last of a triangle
/// over vertices before it; 0 when all or none are known. O(corners) time and memory.
PolygonOrder orderPolygons(const Connectivity& mesh);

}  // namespace tutte
