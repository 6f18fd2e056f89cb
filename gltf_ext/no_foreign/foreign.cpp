// Other extensions' compression in a build without their libraries: such meshes stay as they are.

#include "gltf_ext/foreign.h"

#include "gltf_ext/json_access.h"

namespace tutte {
namespace {

void warnOf(const Asset& asset, const char* extension, std::vector<Failure>& warnings) {
  if (!listsExtension(asset.json, "extensionsUsed", extension)) return;
  warnings.push_back(unsupported("/extensionsUsed", std::string("this build cannot decode ") + extension));
}

}  // namespace

Outcome<Done> decodeMeshopt(Asset& asset, std::vector<Failure>& warnings) {
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) warnOf(asset, name, warnings);
  return Done{};
}

Outcome<Done> decodeDraco(Asset& asset, std::vector<Failure>& warnings) {
  warnOf(asset, "KHR_draco_mesh_compression", warnings);
  return Done{};
}

}  // namespace tutte
