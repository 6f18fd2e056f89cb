#pragma once
// `tutte bench --lossless`: sizes without loss, beside meshoptimizer's lossless codecs.

#include <cstdint>
#include <string>

#include "gltf_ext/scene.h"
#include "tools/bench.h"

namespace tutte {

/// Bytes and seconds of a file, or of several in sum.
struct LosslessFigures {
  std::string file;
  uint64_t vertices = 0, faces = 0;
  uint64_t raw_bytes = 0;  ///< the triangles' indices in 2 or 4 bytes and all attributes
  uint64_t connectivity_bytes = 0, seam_bytes = 0, value_bytes = 0;
  uint64_t total_bytes = 0;    ///< the payloads: polygons and values
  uint64_t meshopt_bytes = 0;  ///< the triangles and values (meshopt_baseline.h); 0: built without zstd
  double encode_seconds = 0, decode_seconds = 0;

  LosslessFigures& operator+=(const LosslessFigures& other);
};

/// Measures every mesh of the scene that has polygons, with the plan's options but without any quantisation.
Outcome<LosslessFigures> measureLossless(const std::string& file, const Scene& scene, const BenchPlan& plan);

void printLosslessHead();
void printLossless(const LosslessFigures& figures);
void printLosslessJson(const LosslessFigures& figures);

}  // namespace tutte
