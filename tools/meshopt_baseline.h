#pragma once
// What meshoptimizer makes of the same mesh without loss: what `tutte bench --lossless` compares with.

#include <cstdint>

#include "gltf_ext/polygon_mesh.h"

namespace tutte {

struct MeshoptFigures {
  uint64_t raw_bytes = 0;         ///< indices in 2 or 4 bytes and all attributes
  uint64_t compressed_bytes = 0;  ///< 0 when this program was built without zstd
};

/// A mesh's triangles (it must have a triangulation) and attributes as EXT_meshopt_compression stores them without
/// filters, in the order that suits its codecs best, all streams together through zstd -19. Attributes apart or
/// interleaved, whichever is smaller.
MeshoptFigures meshoptLossless(const PolygonMesh& mesh);

}  // namespace tutte
