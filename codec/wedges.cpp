#include "codec/wedges.h"

namespace tutte {
namespace {

/// Per wedge of the caller its vertex, and how many wedges each vertex has.
struct Owners {
  std::vector<Index> vertex_of;
  std::vector<Index> wedges_of;
};

Result<Owners> findOwners(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count) {
  Owners owners{std::vector<Index>(wedge_count, kNone), std::vector<Index>(mesh.vertex_count, 0)};
  for (Index corner = 0; corner < wedges.size(); ++corner) {
    if (wedges[corner] >= wedge_count) return Error::kIndexOutOfRange;
    Index& vertex = owners.vertex_of[wedges[corner]];
    if (vertex == mesh.vertexOf(corner)) continue;
    if (vertex != kNone) return Error::kMalformed;
    vertex = mesh.vertexOf(corner);
    ++owners.wedges_of[vertex];
  }
  return owners;
}

}  // namespace

Result<WedgeNumbering> numberWedges(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count) {
  if (wedges.size() != mesh.umbrellas.size()) return Error::kCountMismatch;
  Result<Owners> owners = findOwners(mesh, wedges, wedge_count);
  if (!owners) return owners.error();
  std::vector<Index>& free = owners->wedges_of;
  Index total = 0;
  for (Index& slot : free) {
    const Index count = slot == 0 ? 1 : slot;
    slot = total;
    total += count;
  }

  WedgeNumbering numbering{std::vector<Index>(wedges.size()), std::vector<Index>(total, kNone)};
  std::vector<Index> coded(wedge_count, kNone);
  for (Index corner = 0; corner < wedges.size(); ++corner) {
    Index& wedge = coded[wedges[corner]];
    if (wedge == kNone) {
      wedge = free[mesh.vertexOf(corner)]++;
      numbering.order[wedge] = wedges[corner];
    }
    numbering.wedges[corner] = wedge;
  }
  return numbering;
}

}  // namespace tutte
