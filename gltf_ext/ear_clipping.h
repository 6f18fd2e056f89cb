#pragma once
// Triangles for one polygon in the plane, whatever its shape.

#include <span>
#include <vector>

#include "codec/mesh.h"
#include "gltf_ext/point_grid.h"

namespace tutte {

/// Twice the signed area of a triangle: positive when it turns to the left.
inline double cross(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Cuts a polygon into triangles by clipping ears. `points` holds the exterior ring (counter-clockwise) and then any
/// interior rings (clockwise), `ring_sizes` their lengths, each at least 3.
///
/// Appends points.size() + 2 * (rings - 1) - 2 triangles (three indices into `points` each), always: rings that cross
/// themselves or each other get triangles that overlap. For rings that do not cross, the triangles cover the polygon
/// exactly; some have no area where points coincide or lie on a line. `tolerance` is the doubled area below which a
/// triangle counts as flat. Usually about O(n sqrt n) time; never more than a fixed multiple of n log n + 10^7 steps,
/// after which ears are no longer examined.
void clipEars(std::span<const Point2> points, std::span<const Index> ring_sizes, double tolerance,
              std::vector<Index>& triangles);

}  // namespace tutte
