#include "gltf_ext/references.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace tutte {
namespace {

using Visit = std::function<void(Json&)>;

/// Extensions whose references we know, or that refer to neither accessors nor buffer views.
constexpr std::array<std::string_view, 33> kKnownExtensions = {"AGI_articulations",
                                                               "AGI_stk_metadata",
                                                               "CESIUM_primitive_outline",
                                                               "EXT_instance_features",
                                                               "EXT_lights_ies",
                                                               "EXT_lights_image_based",
                                                               "EXT_mesh_features",
                                                               "EXT_mesh_gpu_instancing",
                                                               "EXT_mesh_manifold",
                                                               "EXT_mesh_polygon",
                                                               "EXT_meshopt_compression",
                                                               "EXT_structural_metadata",
                                                               "EXT_texture_avif",
                                                               "EXT_texture_webp",
                                                               "FB_ngon_encoding",
                                                               "GODOT_single_root",
                                                               "KHR_animation_pointer",
                                                               "KHR_draco_mesh_compression",
                                                               "KHR_lights_punctual",
                                                               "KHR_mesh_quantization",
                                                               "KHR_meshopt_compression",
                                                               "KHR_node_visibility",
                                                               "KHR_texture_basisu",
                                                               "KHR_texture_transform",
                                                               "KHR_xmp",
                                                               "KHR_xmp_json_ld",
                                                               "MSFT_lod",
                                                               "MSFT_packing_normalRoughnessMetallic",
                                                               "MSFT_packing_occlusionRoughnessMetallic",
                                                               "MSFT_texture_dds",
                                                               "TUTTE_mesh_compression",
                                                               "VRM",
                                                               "VRMC_vrm"};

bool isKnown(std::string_view name) {
  if (name.starts_with("KHR_materials_") || name.starts_with("VRMC_")) return true;
  for (const std::string_view known : kKnownExtensions) {
    if (name == known) return true;
  }
  return false;
}

void visitMember(Json& object, const char* key, const Visit& visit) {
  if (!object.is_object()) return;
  const auto found = object.find(key);
  if (found != object.end() && asInteger(*found)) visit(*found);
}

void visitMembers(Json& object, const Visit& visit) {
  if (!object.is_object()) return;
  for (Json& value : object) {
    if (asInteger(value)) visit(value);
  }
}

/// Calls `work` for every element of the array `key`.
template <class Work>
void forEach(Json& object, const char* key, Work&& work) {
  if (!object.is_object()) return;
  const auto found = object.find(key);
  if (found == object.end() || !(found->is_array() || found->is_object())) return;
  for (Json& element : *found) work(element);
}

/// Calls `work` with the object at `key`.
template <class Work>
void within(Json& object, const char* key, Work&& work) {
  if (!object.is_object()) return;
  const auto found = object.find(key);
  if (found != object.end() && found->is_object()) work(*found);
}

template <class Work>
void withExtension(Json& object, const char* name, Work&& work) {
  within(object, "extensions", [&](Json& extensions) { within(extensions, name, work); });
}

void visitPrimitive(Json& primitive, const Visit& visit) {
  within(primitive, "attributes", [&](Json& attributes) { visitMembers(attributes, visit); });
  visitMember(primitive, "indices", visit);
  forEach(primitive, "targets", [&](Json& target) { visitMembers(target, visit); });
  withExtension(primitive, "EXT_mesh_polygon", [&](Json& polygon) {
    for (const char* key : {"loopIndices", "loopIndicesOffsets", "indicesOffsets"}) visitMember(polygon, key, visit);
  });
  withExtension(primitive, "CESIUM_primitive_outline", [&](Json& outline) { visitMember(outline, "indices", visit); });
}

void visitManifold(Json& mesh, const Visit& visit) {
  withExtension(mesh, "EXT_mesh_manifold", [&](Json& manifold) {
    within(manifold, "manifoldPrimitive", [&](Json& primitive) { visitPrimitive(primitive, visit); });
    visitMember(manifold, "mergeIndices", visit);
    visitMember(manifold, "mergeValues", visit);
  });
}

void collectIntegers(const Json& value, Suspects& suspects) {
  if (const auto number = asInteger(value)) suspects.numbers.insert(*number);
  if (!value.is_structured()) return;
  for (const Json& element : value) collectIntegers(element, suspects);
}

void collectSuspects(const Json& value, Suspects& suspects) {
  if (!value.is_structured()) return;
  for (auto it = value.begin(); it != value.end(); ++it) {
    if (!value.is_object() || it.key() != "extensions" || !it->is_object()) {
      if (value.is_object() && it.key() == "extras") continue;
      collectSuspects(*it, suspects);
      continue;
    }
    for (auto extension = it->begin(); extension != it->end(); ++extension) {
      if (isKnown(extension.key())) {
        collectSuspects(*extension, suspects);
      } else {
        suspects.any = true;
        collectIntegers(*extension, suspects);
      }
    }
  }
}

std::vector<size_t> countUses(Json& json, const char* array, void (*walk)(Json&, const Visit&)) {
  std::vector<size_t> uses(countOf(json, array));
  walk(json, [&](Json& reference) {
    const uint64_t index = *asInteger(reference);
    if (index < uses.size()) ++uses[index];
  });
  return uses;
}

/// Removes the marked elements of an array and renumbers what refers to the others.
void removeElements(Json& json, const char* array, const std::vector<bool>& removed,
                    void (*walk)(Json&, const Visit&)) {
  if (std::find(removed.begin(), removed.end(), true) == removed.end()) return;
  std::vector<uint64_t> moved(removed.size());
  Json kept = Json::array();
  for (size_t i = 0; i < removed.size(); ++i) {
    moved[i] = kept.size();
    if (!removed[i]) kept.push_back(std::move(json[array][i]));
  }
  if (kept.empty()) {
    json.erase(array);
  } else {
    json[array] = std::move(kept);
  }
  walk(json, [&](Json& reference) {
    const uint64_t index = *asInteger(reference);
    if (index < moved.size()) reference = moved[index];
  });
}

/// Which of the candidates have no use and are not suspected to have one.
std::vector<bool> idle(const std::set<uint64_t>& candidates, const std::vector<size_t>& uses,
                       const Suspects& suspects) {
  std::vector<bool> result(uses.size());
  for (const uint64_t index : candidates) {
    if (index < uses.size()) result[index] = uses[index] == 0 && !suspects.numbers.count(index);
  }
  return result;
}

/// A buffer view cannot have no bytes: it keeps one.
void emptyView(Json& view) {
  view["byteLength"] = 1;
  for (const char* key : {"byteStride", "target", "extensions"}) view.erase(key);
}

}  // namespace

void forEachAccessorReference(Json& json, const Visit& visit) {
  forEach(json, "meshes", [&](Json& mesh) {
    forEach(mesh, "primitives", [&](Json& primitive) { visitPrimitive(primitive, visit); });
    visitManifold(mesh, visit);
  });
  forEach(json, "skins", [&](Json& skin) { visitMember(skin, "inverseBindMatrices", visit); });
  forEach(json, "animations", [&](Json& animation) {
    forEach(animation, "samplers", [&](Json& sampler) {
      visitMember(sampler, "input", visit);
      visitMember(sampler, "output", visit);
    });
  });
  forEach(json, "nodes", [&](Json& node) {
    withExtension(node, "EXT_mesh_gpu_instancing", [&](Json& instancing) {
      within(instancing, "attributes", [&](Json& attributes) { visitMembers(attributes, visit); });
    });
  });
}

void forEachViewReference(Json& json, const Visit& visit) {
  forEach(json, "accessors", [&](Json& accessor) {
    visitMember(accessor, "bufferView", visit);
    within(accessor, "sparse", [&](Json& sparse) {
      for (const char* key : {"indices", "values"}) {
        within(sparse, key, [&](Json& part) { visitMember(part, "bufferView", visit); });
      }
    });
  });
  forEach(json, "images", [&](Json& image) { visitMember(image, "bufferView", visit); });
  forEach(json, "meshes", [&](Json& mesh) {
    forEach(mesh, "primitives", [&](Json& primitive) {
      withExtension(primitive, "KHR_draco_mesh_compression",
                    [&](Json& draco) { visitMember(draco, "bufferView", visit); });
    });
  });
  withExtension(json, "EXT_structural_metadata", [&](Json& metadata) {
    forEach(metadata, "propertyTables", [&](Json& table) {
      forEach(table, "properties", [&](Json& property) {
        for (const char* key : {"values", "arrayOffsets", "stringOffsets"}) visitMember(property, key, visit);
      });
    });
  });
  withExtension(json, "EXT_lights_ies", [&](Json& lights) {
    forEach(lights, "lights", [&](Json& light) { visitMember(light, "bufferView", visit); });
  });
}

Suspects suspectsOf(const Json& json) {
  Suspects suspects;
  collectSuspects(json, suspects);
  return suspects;
}

std::vector<size_t> accessorUses(Json& json) { return countUses(json, "accessors", forEachAccessorReference); }

std::vector<size_t> viewUses(Json& json) { return countUses(json, "bufferViews", forEachViewReference); }

void removeUnusedAccessors(Asset& asset, const std::set<uint64_t>& candidates) {
  Json& json = asset.json;
  const Suspects suspects = suspectsOf(json);
  const std::vector<bool> unused = idle(candidates, accessorUses(json), suspects);
  if (suspects.numbers.empty()) return removeElements(json, "accessors", unused, forEachAccessorReference);
  for (size_t i = 0; i < unused.size(); ++i) {
    if (!unused[i]) continue;
    json["accessors"][i].erase("bufferView");
    json["accessors"][i].erase("sparse");
  }
}

void removeUnusedViews(Asset& asset, const std::set<uint64_t>& candidates) {
  Json& json = asset.json;
  const Suspects suspects = suspectsOf(json);
  const std::vector<bool> unused = idle(candidates, viewUses(json), suspects);
  if (suspects.numbers.empty()) return removeElements(json, "bufferViews", unused, forEachViewReference);
  for (size_t i = 0; i < unused.size(); ++i) {
    if (unused[i]) emptyView(json["bufferViews"][i]);
  }
}

}  // namespace tutte
