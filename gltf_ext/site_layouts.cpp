#include "gltf_ext/site_layouts.h"

namespace tutte {

bool isConsistent(const AttributeTopology& topology) {
  const Connectivity& mesh = topology.connectivity;
  const size_t corners = mesh.umbrellas.size();
  uint64_t sum = 0;
  for (const Index degree : mesh.face_degrees) sum += degree;
  if (sum != corners || mesh.twins.size() != corners || topology.wedges.size() != corners) return false;
  for (size_t c = 0; c < corners; ++c) {
    const bool twin_exists = mesh.twins[c] == kNone || mesh.twins[c] < corners;
    if (!twin_exists || mesh.umbrellas[c] >= mesh.umbrella_count) return false;
    if (mesh.vertexOf(static_cast<Index>(c)) >= mesh.vertex_count || topology.wedges[c] >= topology.wedge_count)
      return false;
  }
  return std::ranges::all_of(topology.seams, [&](auto seams) { return seams.empty() || seams.size() == corners; });
}

}  // namespace tutte
