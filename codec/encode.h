#pragma once

#include <cstdint>
#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// How the encoder works. No choice changes what is decoded, only how many bytes it takes.
struct EncodeOptions {};

/// What the encoder made of one mesh.
struct Encoded {
  std::vector<uint8_t> bytes;         ///< the connectivity section (EXTENSION_SPEC.md, "Connectivity")
  Connectivity connectivity;          ///< exactly what decode() makes of `bytes`
  std::vector<Index> vertex_order;    ///< coded vertex -> input vertex: code per-vertex values in this order
  std::vector<Index> face_order;      ///< coded face -> input face
  std::vector<Index> corner_order;    ///< coded corner -> input corner

  // Where the bytes went, for reports.
  Index splits = 0;
  uint32_t valence_bytes = 0;         ///< the valence stream (with splits)
  uint32_t degree_bytes = 0;          ///< the degree stream; 0 when it is absent
};

/// Codes the connectivity of any polygon mesh without loss. O(n log n) time, O(n) memory.
/// Errors: kIndexOutOfRange, kCountMismatch, kTooLarge, kOutOfMemory.
Result<Encoded> encode(PolygonView mesh, const EncodeOptions& options = {}) noexcept;

}  // namespace tutte
