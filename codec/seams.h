#pragma once
// Seams: where vertices that are coded as one and the wedges of a vertex part, and which attributes differ there.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/mesh_ways.h"
#include "codec/result.h"

namespace tutte {

/// The values of one attribute, `stride` bytes per coded wedge. Two values are equal when all bytes are.
struct ValueView {
  std::span<const uint8_t> data;
  uint32_t stride = 0;
};

/// The wedge structure, in coded order (codec/wedges.h).
struct Seams {
  std::vector<Index> wedges;  ///< per coded corner; empty: its umbrella
  Index wedge_count = 0;
  /// Per coded corner: its vertex, in a welded mesh, whose connectivity has one vertex (called a *point* then) for
  /// several in the same place. Empty otherwise: vertices are those of the connectivity.
  std::vector<Index> vertices;
  Index vertex_count = 0;
  /// Per attribute slot, per coded corner: 1 when the edge from the corner to the next one of its face is a seam, that
  /// is, when the attribute differs across the edge at one of its ends. Both corners of an edge say the same; 0 on
  /// boundaries. Empty when the attribute never differs; slot 0 is always empty.
  std::vector<std::vector<uint8_t>> attribute_seams;
  /// In ascending order, all umbrellas whose corners have different wedges. Edges without an end there are no seams.
  std::vector<Index> parted_umbrellas;
  std::unique_ptr<const MeshWays> ways;  ///< the connectivity's, so that nobody has to make them again; may be null
};

/// The vertex of each coded corner in the connectivity.
std::vector<Index> verticesOf(const Connectivity& mesh);

/// Codes vertices and wedges that numberParts() has put in order. `vertices` is empty unless the mesh is welded.
/// `attributes` are all attributes: slot 0 (positions) is equal for all wedges of a vertex and of a point, and is not
/// looked at. O(corners * attributes) time.
std::vector<uint8_t> encodeSeams(const Connectivity& mesh, std::span<const Index> vertices,
                                 std::span<const Index> wedges, std::span<const ValueView> attributes);

/// What a mesh has whose payload has no seams.
Seams withoutSeams(const Connectivity& mesh, Index attribute_count);

/// Decodes any bytes over a valid connectivity: the result is a wedge structure that holds together, or an error
/// (kMalformed, kTruncated, kTrailingBytes). O(corners * attributes) time; memory for seams only of attributes that
/// have some.
Result<Seams> decodeSeams(const Connectivity& mesh, bool welded, std::span<const uint8_t> bytes, Index attribute_count);

}  // namespace tutte
