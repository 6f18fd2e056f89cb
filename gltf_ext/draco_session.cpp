#include "gltf_ext/draco_session.h"

namespace tutte {

bool DracoSession::prepare(draco::Mesh& mesh) {
  mesh.set_num_points(topology_.wedge_count);
  for (size_t id = 0; id < planes_.size(); ++id) {
    const Plane& plane = planes_[id];
    const bool has_seams = plane.attribute < topology_.seams.size();
    plane_layouts_[id] =
        layouts_.get(has_seams ? topology_.seams[plane.attribute] : std::span<const uint8_t>{}, orderOf(plane.kind));
    if (!plane_layouts_[id]) return false;
    draco::GeometryAttribute description;
    description.Init(dracoType(plane.kind), nullptr, plane.components, draco::DT_INT32, false,
                     plane.components * static_cast<int>(sizeof(int32_t)), 0);
    mesh.AddAttribute(std::make_unique<draco::PointAttribute>(description));
  }
  return true;
}

void DracoSession::mapWedges(draco::PointAttribute& positions) const {
  positions.SetExplicitMapping(topology_.wedge_count);
  for (Index corner = 0; corner < triangles_.wedges.size(); ++corner) {
    const auto value = static_cast<uint32_t>(valueAt(0, corner));
    positions.SetPointMapEntry(draco::PointIndex(triangles_.wedges[corner]), draco::AttributeValueIndex(value));
  }
}

}  // namespace tutte
