#pragma once
// Where values sit on a mesh. Corners that share a value form a *site*: a vertex for positions; for an attribute with
// seams, the corners of a vertex between two seams.

#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// The sites of one attribute over a mesh, as predictors see them.
struct ValueGraph {
  /// The corners of a corner's face: [begin, end).
  struct Span {
    Index begin, end;
    Index degree() const { return end - begin; }
  };

  Index site_count = 0;
  std::vector<Index> sites;    ///< per corner
  std::vector<Index> twins;    ///< per corner: as Connectivity::twins, but kNone where the far side has other sites
  std::vector<Span> faces;     ///< per corner
  std::vector<Index> first;    ///< the corners of site s are corners[first[s]] ... corners[first[s + 1] - 1]; corners
  std::vector<Index> corners;  ///< of faces of degree below 3 are left out

  Index next(Index corner) const { return corner + 1 == faces[corner].end ? faces[corner].begin : corner + 1; }
  Index prev(Index corner) const { return corner == faces[corner].begin ? faces[corner].end - 1 : corner - 1; }
  std::span<const Index> cornersOf(Index site) const {
    return {corners.data() + first[site], first[site + 1] - first[site]};
  }
};

/// `sites` holds a number below `site_count` per corner. O(corners).
ValueGraph buildValueGraph(const Connectivity& mesh, std::vector<Index> sites, Index site_count);

/// The site of each wedge, numbered by the smallest wedge.
struct WedgeSites {
  std::vector<Index> site_of;
  Index count = 0;
};

/// Joins wedges that no seam parts: those of two faces that meet in an edge which is no seam. `wedges` are per corner,
/// below `wedge_count`; `seams` is per corner, 1 where the edge to the next corner is a seam, or empty. O(corners).
WedgeSites joinWedges(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count,
                      std::span<const uint8_t> seams);

/// Joins all wedges of a vertex. O(corners).
WedgeSites joinVertices(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count);

/// The order in which values are coded: always one of the sites with the most known surroundings, so that most values
/// are predicted by several parallelograms. A function of the graph alone. O(corners).
std::vector<Index> valueOrder(const ValueGraph& graph);

}  // namespace tutte
