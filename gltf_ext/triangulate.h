#pragma once
// A triangulation for polygons that come without one.

#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// Fills `mesh.triangulation` when it is empty; leaves it alone otherwise.
///
/// A face of degree n gets n - 2 triangles (none below degree 3), two more for every corner of its interior rings and
/// two for each of those rings. A face's triangles are, in this order of preference: the fan from its first corner,
/// the fan from another corner (which FB_ngon_encoding can express), clipped ears.
/// A fan is taken only where it covers the polygon without overlap, seen along the polygon's normal. Without POSITION,
/// with positions that are not finite, and for polygons without area, every face gets the fan from its preferred
/// corner.
///
/// The mesh's indices must be in range. Time: O(n) for convex faces; see clipEars() for the others.
void triangulate(PolygonMesh& mesh);

}  // namespace tutte
