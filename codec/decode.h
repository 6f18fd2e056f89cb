#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// Decodes a connectivity section. `bytes` may be anything: the result is a valid mesh or an error, in
/// O(input + output) time and memory, never more than `limits` allow.
Result<Connectivity> decode(std::span<const uint8_t> bytes, const Limits& limits = {}) noexcept;

struct CodecMemory;

/// Decodes many connectivity sections, one after the other: keeps the memory that decoding takes beside its result.
/// Different objects may be used by different threads at once.
class Decoder {
 public:
  Decoder();
  ~Decoder();
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;

  /// As the function decode().
  Result<Connectivity> decode(std::span<const uint8_t> bytes, const Limits& limits = {}) noexcept;

 private:
  std::unique_ptr<CodecMemory> memory_;
};

/// The polygons of a decoded mesh in their original orientation. A flipped face keeps its first corner and has the
/// others reversed; `corner_of` (if given) receives, per corner of the result, the coded corner it came from.
Polygons polygonsOf(const Connectivity& connectivity, std::vector<Index>* corner_of = nullptr);

}  // namespace tutte
