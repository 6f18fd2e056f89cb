#include "gltf_ext/primitive_writer.h"

#include <string>
#include <utility>

#include "gltf_ext/accessors.h"

namespace tutte {
namespace {

void copyMembers(const Json& from, Json& to, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const Json* value = member(from, key)) to[key] = *value;
  }
}

void replaceAll(Json& references, const std::map<uint64_t, uint64_t>& replaced) {
  for (Json& reference : references) reference = replaced.at(*asInteger(reference));
}

/// "POSITION@3" is a position, too.
bool isPosition(const std::string& name) { return name.substr(0, name.find('@')) == "POSITION"; }

}  // namespace

void PrimitiveWriter::replaceAttributes(const PayloadPlan& plan, const EmittedPayload& emitted) {
  for (size_t i = 0; i < plan.attributes.size(); ++i) {
    const PlannedAttribute& planned = plan.attributes[i];
    replaced_[planned.accessor] = addAttribute(planned.accessor, emitted.attributes[i], isPosition(planned.name));
  }
}

uint64_t PrimitiveWriter::addAttribute(uint64_t replaced, const Json& emitted, bool is_position) {
  const Json& old = asset_.json["accessors"][replaced];
  Json accessor = emitted;
  if (!is_position && !old.contains("min") && !old.contains("max")) {
    accessor.erase("min");
    accessor.erase("max");
  }
  copyMembers(old, accessor, {"name", "extras", "extensions"});
  return appendElement(asset_.json, "accessors", std::move(accessor));
}

const Json& PrimitiveWriter::membersOf(const Json& primitive, size_t number, const EmittedGroup& group) {
  const auto [known, is_new] = members_.try_emplace(number, Json::object());
  if (!is_new) return known->second;
  Json indices = group.indices;
  const auto old = integerMember(primitive, "indices", "");
  if (old) copyMembers(asset_.json["accessors"][*old], indices, {"name", "extras"});
  Json& members = known->second;
  members["indices"] = appendElement(asset_.json, "accessors", std::move(indices));
  if (group.polygons == 0) return members;
  members["polygon"] = {{"count", group.polygons},
                        {"indicesOffsets", appendElement(asset_.json, "accessors", group.index_offsets)},
                        {"loopIndices", appendElement(asset_.json, "accessors", group.loops)},
                        {"loopIndicesOffsets", appendElement(asset_.json, "accessors", group.loop_offsets)}};
  return members;
}

void PrimitiveWriter::write(PrimitivePlace place, size_t number, const EmittedGroup& group, PolygonNotation wish) {
  Json& primitive = place.in(asset_.json);
  replaceAll(primitive["attributes"], replaced_);
  if (member(primitive, "targets")) {
    for (Json& target : primitive["targets"]) replaceAll(target, replaced_);
  }
  const Json& members = membersOf(primitive, number, group);
  primitive["indices"] = members["indices"];
  primitive.erase("mode");
  eraseExtension(primitive, "FB_ngon_encoding");
  if (group.fans) primitive["extensions"]["FB_ngon_encoding"] = Json::object();
  if (group.polygons > 0) {
    primitive["extensions"]["EXT_mesh_polygon"].update(members["polygon"]);
  } else {
    eraseExtension(primitive, "EXT_mesh_polygon");
  }
  if ((wish == PolygonNotation::kFb || wish == PolygonNotation::kBoth) && !group.fans) {
    warnings_.push_back(unsupported(
        place.pointer(), "not all polygons are fans that differ in their first vertex: EXT_mesh_polygon is used"));
  }
}

}  // namespace tutte
