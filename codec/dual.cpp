#include "codec/dual.h"

namespace tutte {

DualTopology dualOf(const Topology& primal) {
  const FaceCorners& faces = primal.faces;
  const Index corners = static_cast<Index>(primal.twin.size());
  DualTopology dual;
  FaceCorners& dual_faces = dual.topology.faces;
  dual_faces.first.push_back(0);
  std::vector<Index> dual_corner(corners, kNone);
  dual.primal_corner.reserve(corners);
  for (Index c = 0; c < corners; ++c) {
    if (dual_corner[c] != kNone) continue;
    const Index dual_face = static_cast<Index>(dual.primal_umbrella.size());
    for (Index at = c; dual_corner[at] == kNone; at = primal.twin[faces.prev(at)]) {
      dual_corner[at] = static_cast<Index>(dual.primal_corner.size());
      dual.primal_corner.push_back(at);
      dual_faces.vertex.push_back(faces.faceOf(at));
      dual_faces.face.push_back(dual_face);
    }
    dual.primal_umbrella.push_back(faces.vertex[c]);
    dual_faces.first.push_back(static_cast<Index>(dual.primal_corner.size()));
  }
  // The dual edge of a corner crosses the primal edge that arrives there; its twin belongs to that edge's other end.
  dual.topology.twin.resize(corners);
  for (Index d = 0; d < corners; ++d) {
    const Index around = primal.twin[faces.prev(dual.primal_corner[d])];
    dual.topology.twin[d] = dual_corner[faces.next(around)];
  }
  dual.topology.real_faces = dual_faces.faceCount();
  for (Index f = 0; f < faces.faceCount(); ++f) dual.topology.valence.push_back(faces.first[f + 1] - faces.first[f]);
  if (primal.real_faces < faces.faceCount()) {
    dual.topology.dummy_umbrella.assign(faces.faceCount(), 0);
    for (Index f = primal.real_faces; f < faces.faceCount(); ++f) dual.topology.dummy_umbrella[f] = 1;
  }
  return dual;
}

}  // namespace tutte
