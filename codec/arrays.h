#pragma once
// The arrays that buffer views hold, derived from one decoded mesh.
//
// All of them follow one order of polygons: by group, and within a group in coded order. What belongs to a group is
// contiguous in every array, so that a glTF primitive's accessor is a slice of the buffer view: elements
// group_starts[g] to group_starts[g + 1]. Offsets stored in an array (EXT_mesh_polygon's indicesOffsets and
// loopIndicesOffsets) count elements from the start of the group's own slice of the array that they point into, as the
// draft demands of a primitive's accessors.

#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"
#include "codec/triangulation.h"

namespace tutte {

/// What arrays are derived from. Spans may be empty where PolygonMesh's vectors may; all must be consistent, as they
/// are after unpack().
struct ArraySource {
  PolygonView polygons;
  std::span<const Index> wedges;  ///< per corner; empty: the vertex
  Index wedge_count = 0;
  std::span<const Index> groups;  ///< per face; empty: all 0
  Index group_count = 1;
  std::span<const Index> ring_owners;  ///< per face; empty: no interior rings
  const Triangulation& triangulation;  ///< given for all faces; empty: these are triangles

  Index triangleCount(Index face) const { return triangulation.counts.empty() ? 1 : triangulation.counts[face]; }
  Index wedgeOf(Index corner) const { return wedges.empty() ? polygons.corners[corner] : wedges[corner]; }
};

/// An array and where each group's slice starts; one entry more than groups.
struct DerivedArray {
  std::vector<Index> values;
  std::vector<Index> group_starts;
};

/// Three wedges per triangle. The triangles of a polygon follow each other, and those of a fan all start with its apex.
/// Which corner a triangle or quad starts at is chosen so that consecutive polygons of a group start at different
/// wedges: then FB_ngon_encoding is true of the group.
struct TriangleArray : DerivedArray {
  /// Per group: 1 when FB_ngon_encoding holds, that is, when cutting the triangles wherever the first wedge changes
  /// gives exactly the group's polygons. 0 when a polygon has holes, no triangles or is no fan, or when neighbours in
  /// the order cannot be told apart.
  std::vector<uint8_t> ngon_encoding;
};
TriangleArray triangleIndices(const ArraySource& mesh);

/// indicesOffsets: per polygon, the element of triangleIndices() where its triangles start.
DerivedArray polygonIndexOffsets(const ArraySource& mesh);

/// loopIndices: per polygon the wedges of its exterior ring, then those of its interior rings in coded order. Between
/// two rings of a group, of one polygon or of two, stands kNone (the restart value); none stands at the end of a group.
DerivedArray polygonLoops(const ArraySource& mesh);

/// loopIndicesOffsets: per polygon, the element of polygonLoops() where its exterior ring starts.
DerivedArray polygonLoopOffsets(const ArraySource& mesh);

/// Per ring its degree, in the order of polygonLoops().
DerivedArray ringDegrees(const ArraySource& mesh);

/// Per wedge the first wedge of its vertex; unused wedges are their own. `group_starts` is {0, wedge_count}.
DerivedArray weldedWedges(const ArraySource& mesh);

/// Little-endian integers of `stride` (1, 2 or 4) bytes; kNone becomes the largest value of the type. Errors:
/// kCountMismatch for another stride; kTooLarge when another value is not below that.
Result<std::vector<uint8_t>> packIndices(std::span<const Index> values, uint32_t stride);

}  // namespace tutte
