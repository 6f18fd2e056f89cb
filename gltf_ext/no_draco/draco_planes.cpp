// The Draco mode of a build that leaves Draco out.

#include "gltf_ext/draco_planes.h"

namespace tutte {

bool hasDraco() { return false; }

Outcome<std::vector<uint8_t>> encodePlanes(const AttributeTopology&, std::span<const Plane>) {
  return Failure{FailureKind::kUnsupported, "", "this build leaves Draco out"};
}

bool decodePlanes(const AttributeTopology&, std::span<const uint8_t>, std::span<Plane>) { return false; }

}  // namespace tutte
