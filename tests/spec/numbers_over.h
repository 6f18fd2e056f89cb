#pragma once
// Numbers for test vectors.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "codec/mesh.h"
#include "tests/shapes/shapes.h"

namespace tutte {

/// Numbers over a mesh's vertices, smooth like coordinates: per component the distance from some vertex, and noise.
inline std::vector<int32_t> numbersOver(const Connectivity& mesh, int components, int32_t max, Index noise) {
  shapes::Random random(static_cast<uint64_t>(max) + noise);
  std::vector<int32_t> numbers(size_t{mesh.vertex_count} * components);
  for (int i = 0; i < components; ++i) {
    std::vector<int32_t> steps(mesh.vertex_count, 0);
    steps[random.below(mesh.vertex_count)] = 1;
    for (bool more = true; std::exchange(more, false);) {
      Index begin = 0;
      for (const Index degree : mesh.face_degrees) {
        for (Index c = 0; c < degree; ++c) {
          const int32_t here = steps[mesh.vertexOf(begin + c)];
          int32_t& beyond = steps[mesh.vertexOf(begin + (c + 1) % degree)];
          if (here == 0 || (beyond != 0 && beyond <= here + 1)) continue;
          beyond = here + 1;
          more = true;
        }
        begin += degree;
      }
    }
    for (Index v = 0; v < mesh.vertex_count; ++v) {
      const int64_t smooth = int64_t{steps[v]} * (max / 9 + 1) / 2 + random.below(noise + 1);
      numbers[size_t{v} * components + i] = static_cast<int32_t>(std::min<int64_t>(smooth, max));
    }
  }
  return numbers;
}

}  // namespace tutte
