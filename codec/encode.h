#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "codec/mesh.h"
#include "codec/profile.h"
#include "codec/result.h"

namespace tutte {

/// How the encoder works. No choice changes what is decoded, only how many bytes it takes.
struct EncodeOptions {
  /// Statistics; by default chosen by size, see profileFor().
  std::optional<Profile> profile;
  /// How long to search for choices that make fewer bytes: 0 not at all, 1 while it costs little, 2 as long as files
  /// are worth it, 3 as long as anybody might wait.
  int effort = 1;
  /// Values will be coded vertex by vertex in the order of the walk: prefer one that suits them.
  bool values_follow = false;
};

/// What the encoder made of one mesh.
struct Encoded {
  std::vector<uint8_t> bytes;       ///< the connectivity section (EXTENSION_SPEC.md, "Connectivity")
  Connectivity connectivity;        ///< exactly what decode() makes of `bytes`
  std::vector<Index> vertex_order;  ///< coded vertex -> input vertex: code per-vertex values in this order
  std::vector<Index> face_order;    ///< coded face -> input face
  std::vector<Index> corner_order;  ///< coded corner -> input corner
  Index splits = 0;                 ///< how many vertices were met a second time
};

/// Codes the connectivity of any polygon mesh without loss. O(n log n) time, O(n) memory.
/// Errors: kIndexOutOfRange, kCountMismatch, kTooLarge, kOutOfMemory.
Result<Encoded> encode(PolygonView mesh, const EncodeOptions& options = {}) noexcept;

struct EncoderMemory;

/// Encodes many meshes, one after the other: keeps the memory that walks take beside their result. Different objects
/// may be used by different threads at once.
class Encoder {
 public:
  Encoder();
  ~Encoder();
  Encoder(Encoder&&) noexcept;
  Encoder& operator=(Encoder&&) noexcept;

  /// As the function encode().
  Result<Encoded> encode(PolygonView mesh, const EncodeOptions& options = {}) noexcept;

 private:
  std::unique_ptr<EncoderMemory> memory_;
};

}  // namespace tutte
