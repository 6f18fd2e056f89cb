#pragma once
// The triangles that polygons are drawn with.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// Triangles of every polygon, in face order. Empty `counts` means: none given, choose. What is decoded has none only
/// where all faces are triangles.
struct Triangulation {
  std::vector<Index> counts;   ///< per face: its triangles; 0 for interior rings (their exterior ring has them)
  std::vector<Index> corners;  ///< three per triangle: indices into Polygons::corners
};

/// No face has another degree than 3.
inline bool onlyTriangles(std::span<const Index> face_degrees) {
  Index others = 0;  // without decisions, so that compilers make vectors of it
  for (const Index degree : face_degrees) others |= degree ^ 3;
  return others == 0;
}

/// Every polygon as a fan from its first corner; interior rings (ring_owners[face] != kNone; the span may be empty) and
/// faces of degree below 3 have no triangles. Holes stay covered: a mesh with rings needs a triangulator.
Triangulation fanTriangulation(PolygonView mesh, std::span<const Index> ring_owners);

/// Codes the triangles of a mesh whose faces are `mesh`'s (in either orientation: flipped faces keep their first
/// corner). What decodes has the same triangles per polygon up to their order and to which corner a triangle starts
/// at. Returns nothing when the triangulation is fanTriangulation(). Errors: kCountMismatch, kIndexOutOfRange (a
/// triangle uses a corner of another polygon), kMalformed (triangles of an interior ring or of a face whose polygon,
/// holes included, has fewer than 3 corners).
Result<std::optional<std::vector<uint8_t>>> encodeTriangulation(const Connectivity& mesh,
                                                                std::span<const Index> ring_owners,
                                                                const Triangulation& triangulation);

/// Any bytes may be passed; `ring_owners` is empty or valid. At most `max_triangles` are made (kLimitExceeded). Other
/// errors: kTruncated, kTrailingBytes. Every triangle uses corners of its own polygon.
Result<Triangulation> decodeTriangulation(const Connectivity& mesh, std::span<const Index> ring_owners,
                                          std::span<const uint8_t> bytes, Index max_triangles);

}  // namespace tutte
