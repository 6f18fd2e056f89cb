#include "gltf_ext/site_layouts.h"

namespace tutte {
namespace {

/// True when all numbers are below a limit, which is below 2^31; with `spare` 1, they may also be kNone.
bool allBelow(std::span<const Index> numbers, Index limit, Index spare = 0) {
  Index below = ~0u;  // its top bit; without decisions, so that compilers make vectors of it
  for (const Index number : numbers) below &= (number + spare - (limit + spare)) & ~(number + spare);
  return below >> 31 != 0;
}

}  // namespace

bool isConsistent(const AttributeTopology& topology) {
  if (topology.trusted) return true;
  const Connectivity& mesh = topology.connectivity;
  const size_t corners = mesh.umbrellas.size();
  uint64_t sum = 0;
  for (const Index degree : mesh.face_degrees) sum += degree;
  if (sum != corners || mesh.twins.size() != corners || topology.wedges.size() != corners) return false;
  if (!allBelow(mesh.umbrellas, mesh.umbrella_count) || !allBelow(topology.wedges, topology.wedge_count)) return false;
  if (!allBelow(mesh.twins, static_cast<Index>(corners), 1)) return false;
  if (!allBelow(mesh.vertices, mesh.vertex_count)) return false;
  if (mesh.vertices.empty() ? mesh.umbrella_count > mesh.vertex_count : mesh.vertices.size() != mesh.umbrella_count) {
    return false;
  }
  return std::ranges::all_of(topology.seams, [&](auto seams) { return seams.empty() || seams.size() == corners; });
}

}  // namespace tutte
