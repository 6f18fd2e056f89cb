#include "gltf_ext/foreign.h"

namespace tutte {

Outcome<Done> decodeForeign(Asset& asset, std::vector<Failure>& warnings) {
  const auto meshopt = decodeMeshopt(asset, warnings);
  if (!meshopt) return meshopt;
  return decodeDraco(asset, warnings);
}

}  // namespace tutte
