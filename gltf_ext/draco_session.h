#pragma once
// What both directions share: Draco's view of planes on a mesh. Private to the Draco files.

#include <draco/mesh/mesh.h>

#include <memory>
#include <span>
#include <vector>

#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/draco_mesh.h"

namespace tutte {

/// Draco's stream begins with constants that we leave out: "DRACO", version 2.2, triangular mesh, a method of our own,
/// no flags, one attribute encoder.
inline constexpr uint8_t kDracoMethod = 0x7F;
inline constexpr uint8_t kDracoHeader[] = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, kDracoMethod, 0, 0, 1};

/// The order of a plane's values.
inline ValueOrder orderOf(PlaneKind kind) {
  const bool grown = kind == PlaneKind::kPosition || kind == PlaneKind::kSmooth;
  return grown ? ValueOrder::kGrown : ValueOrder::kDepthFirst;
}

inline draco::GeometryAttribute::Type dracoType(PlaneKind kind) {
  switch (kind) {
    case PlaneKind::kPosition: return draco::GeometryAttribute::POSITION;
    case PlaneKind::kTexcoord: return draco::GeometryAttribute::TEX_COORD;
    case PlaneKind::kNormal:
    case PlaneKind::kDirection: return draco::GeometryAttribute::NORMAL;
    default: return draco::GeometryAttribute::GENERIC;
  }
}

/// Planes as attributes of a Draco mesh without faces, one point per wedge.
class DracoSession {
 public:
  DracoSession(const AttributeTopology& topology, const TriangleTable& triangles, std::span<const Plane> planes)
      : topology_(topology),
        triangles_(triangles),
        planes_(planes),
        layouts_(triangles),
        plane_layouts_(planes.size()) {}

  /// Finds every plane's layout and describes the attributes. False when the seams do not fit.
  bool prepare(draco::Mesh& mesh);

  /// Tells the coded positions (plane 0) which of them each wedge has.
  void mapWedges(draco::PointAttribute& positions) const;

  const TriangleTable& triangles() const { return triangles_; }
  const Plane& plane(int id) const { return planes_[id]; }
  int planeCount() const { return static_cast<int>(planes_.size()); }
  const ValueLayout& layout(int id) const { return *plane_layouts_[id]; }
  int valueAt(int id, Index corner) const { return layouts_.valueAt(layout(id), corner); }
  bool hasParent() const { return !planes_.empty() && planes_[0].kind == PlaneKind::kPosition; }

 private:
  const AttributeTopology& topology_;
  const TriangleTable& triangles_;
  std::span<const Plane> planes_;
  ValueLayouts layouts_;
  std::vector<const ValueLayout*> plane_layouts_;
};

}  // namespace tutte
