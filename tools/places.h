#pragma once
// Where the meshes of a scene stand.

#include <array>
#include <vector>

#include "gltf_ext/scene.h"

namespace tutte {

/// One appearance of a mesh.
struct Place {
  Index mesh = 0;
  Matrix matrix = kIdentity;  ///< from the mesh's space to the scene's
};

/// Every appearance of every mesh; a mesh that no node shows appears once, at the origin. O(nodes + places). Nodes that
/// are their own ancestors, against the rules of Scene, are left out.
std::vector<Place> placesOf(const Scene& scene);

/// The matrix times the point (x, y, z, 1).
std::array<double, 3> transformPoint(const Matrix& matrix, const std::array<double, 3>& point);

/// A normal under the matrix, of unit length again (or zero).
std::array<double, 3> transformNormal(const Matrix& matrix, const std::array<double, 3>& normal);

/// How much the matrix may lengthen a vector, at most.
double largestScale(const Matrix& matrix);

}  // namespace tutte
