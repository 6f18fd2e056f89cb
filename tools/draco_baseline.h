#pragma once
// What Draco makes of the same mesh: the figures that `tutte bench` compares with.

#include <cstdint>

#include "gltf_ext/failure.h"
#include "gltf_ext/pack.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// One way to run Draco's edgebreaker.
struct DracoRun {
  /// 0 (fastest) to 10 (smallest), as draco_encoder's -cl; its speed is 10 less this.
  int compression_level = 10;
  /// Times are the best of so many runs, at least one.
  int repetitions = 1;
};

/// Bytes and seconds of one mesh. Encoding starts with the finished draco::Mesh, triangulated and welded, and ends
/// with the .drc bytes; decoding starts with these and ends with a draco::Mesh.
struct DracoFigures {
  uint64_t connectivity_bytes = 0;  ///< growth of the buffer inside the connectivity step (with seams of attributes)
  uint64_t attribute_bytes = 0;     ///< everything else but the 11 bytes of the header
  uint64_t total_bytes = 0;         ///< the whole .drc
  double encode_seconds = 0;
  double connectivity_encode_seconds = 0;  ///< of these, inside the connectivity step
  double decode_seconds = 0;
  double connectivity_decode_seconds = 0;
};

/// Draco's triangles. The mesh's own triangulation is used where it has one, fans otherwise. Equal positions (and
/// equal values of every attribute) are welded, as Draco's own tools do. Floats are quantised with the bits of
/// `options`; what our codec keeps without loss (0 bits, integers, JOINTS, WEIGHTS) is kept by Draco, too. Draco drops
/// degenerate triangles and isolated vertices.
/// Fails with Draco's message when it refuses the mesh, for instance because no triangle is left.
Outcome<DracoFigures> dracoTriangles(const PolygonMesh& mesh, const PackOptions& options, const DracoRun& run);

/// Draco's polygons: fans, and a generic attribute per corner that is 1 opposite to the edges that were added, as its
/// OBJ reader makes it when asked to preserve polygons (but for faces of any degree).
Outcome<DracoFigures> dracoPolygons(const PolygonMesh& mesh, const PackOptions& options, const DracoRun& run);

}  // namespace tutte
