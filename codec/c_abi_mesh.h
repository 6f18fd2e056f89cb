#pragma once
// What is behind the handle of the C interface, for the files that implement it. Not for its users.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <vector>

#include "codec/arrays.h"
#include "codec/c_abi.h"
#include "codec/payload_mesh.h"
#include "codec/result.h"

/// One handle for all meshes: what it was not made with stays empty.
struct tutte_mesh {
  enum class Origin { kEncoded, kSection, kPayload };

  Origin origin = Origin::kSection;
  tutte::PayloadMesh mesh;
  std::vector<uint8_t> section_bytes;
  std::vector<tutte::Index> vertex_order, face_order, corner_order;
  /// Of the arrays that derive from others, those that were asked for.
  std::array<std::optional<tutte::DerivedArray>, TUTTE_ARRAY_COUNT - TUTTE_TRIANGLE_INDICES> derived;
};

namespace tutte {

inline int32_t statusOf(Error error) { return -static_cast<int32_t>(error); }

/// Whether an array of `count` elements of `size` bytes can be at `data`, as far as that can be told.
inline bool isSpan(const void* data, size_t count, size_t size) {
  return count <= std::numeric_limits<ptrdiff_t>::max() / size && (data != nullptr || count == 0);
}

/// Whether the system would give that much. It is given back at once; `volatile` keeps compilers, which may assume that
/// memory is endless, from leaving out the question. WebAssembly's memory cannot be given back, so there it is only
/// asked how much it may grow.
inline bool canAllocate(uint64_t bytes) {
#if defined(__wasm__)
  return bytes <= (uint64_t{65536} - __builtin_wasm_memory_size(0)) * 65536;
#else
  if (bytes > static_cast<uint64_t>(std::numeric_limits<ptrdiff_t>::max())) return false;
  void* volatile const memory = std::malloc(static_cast<size_t>(bytes));
  const bool given = memory != nullptr;
  std::free(memory);
  return given;
#endif
}

}  // namespace tutte
