#pragma once
// Everything in a payload but the attributes' values, decoded and put together.

#include <string_view>
#include <vector>

#include "codec/arrays.h"
#include "codec/decode.h"
#include "codec/mesh.h"
#include "codec/payload.h"
#include "codec/result.h"
#include "codec/seams.h"
#include "codec/triangulation.h"

namespace tutte {

/// A decoded payload. Corners are numbered as in `polygons`, that is, in the faces' original orientation; what the
/// attribute coders walk over (`connectivity`, `seams`) is numbered in coded orientation.
struct PayloadMesh {
  PayloadCounts counts;  ///< true of the mesh
  Connectivity connectivity;
  Seams seams;
  Polygons polygons;
  std::vector<Index> coded_corners;  ///< per corner: the coded corner
  std::vector<Index> wedges;         ///< per corner; empty: the vertex
  std::vector<Index> groups;         ///< per face; empty: all 0
  std::vector<Index> ring_owners;    ///< per face; empty: no interior rings
  Triangulation triangulation;       ///< of all faces; empty: these are triangles

  /// A view of the mesh, for the arrays that derive from it.
  ArraySource arraySource() const;
};

/// Whether a mesh of that size may be built; triangles and wedges are held against the limit of corners.
bool isWithin(const PayloadCounts& counts, const Limits& limits);

/// Why a payload was refused, and where.
struct PayloadFailure {
  Error error = Error::kNone;
  std::string_view where = "header";  ///< or the section's name
};

/// Decodes a parsed payload. Its counts are checked against `limits` before anything is decoded, and against what was
/// decoded: kCountMismatch. Time and memory are O(counts + bytes).
Result<PayloadMesh, PayloadFailure> decodePayloadMesh(const PayloadView& payload, const Limits& limits);

/// The same, for one payload after the other.
Result<PayloadMesh, PayloadFailure> decodePayloadMesh(const PayloadView& payload, const Limits& limits,
                                                      Decoder& decoder);

/// The same in two steps, for those who want few things in memory at once. First what attributes are coded over, and
/// what belongs to faces: `polygons`, `coded_corners`, `wedges` and `triangulation` stay empty.
Result<PayloadMesh, PayloadFailure> decodeSections(const PayloadView& payload, const Limits& limits, Decoder& decoder);

/// Fills in what decodeSections() left out, but for `coded_corners`, and gives up `connectivity` and `seams`. Fails
/// with the errors of the section TRIANGULATION, or with kCountMismatch because of the number of triangles.
Error turnIntoPolygons(const PayloadView& payload, PayloadMesh& mesh);

}  // namespace tutte
