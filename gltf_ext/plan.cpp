#include "gltf_ext/plan.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "gltf_ext/accessors.h"
#include "gltf_ext/polygons.h"

namespace tutte {
namespace {

/// Extensions of primitives that refer to vertices only through attributes, and to faces not at all.
constexpr std::array<std::string_view, 6> kOrderFree = {"EXT_mesh_polygon",       "EXT_structural_metadata",
                                                        "FB_ngon_encoding",       "KHR_draco_mesh_compression",
                                                        "KHR_materials_variants", "KHR_texture_transform"};

/// Extensions of meshes that refer to neither.
constexpr std::array<std::string_view, 3> kOrderFreeOfMeshes = {"KHR_xmp", "KHR_xmp_json_ld", "MOZ_hubs_components"};

template <size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A feature ID set without attribute and texture numbers the vertices by their position in the file.
bool hasImplicitFeatures(const Json& features) {
  const Json* sets = member(features, "featureIds");
  if (!sets || !sets->is_array()) return true;
  for (const Json& set : *sets) {
    if (!member(set, "attribute") && !member(set, "texture")) return true;
  }
  return false;
}

class Planner {
 public:
  Planner(const Asset& asset, Purpose purpose, std::vector<Failure>& warnings)
      : asset_(asset), purpose_(purpose), warnings_(warnings) {}

  Outcome<std::vector<PayloadPlan>> run() {
    for (size_t m = 0; m < countOf(asset_.json, "meshes"); ++m) {
      const auto mesh = elementOf(asset_.json, "meshes", m);
      if (!mesh) return mesh.error();
      const Json* primitives = member(**mesh, "primitives");
      if (!primitives || !primitives->is_array()) {
        return invalid(pointerTo("meshes", m), "the mesh has no array of primitives");
      }
      for (size_t p = 0; p < primitives->size(); ++p) {
        const auto planned = plan(**mesh, (*primitives)[p], {m, p});
        if (!planned && planned.error().kind != FailureKind::kUnsupported) return planned.error();
        if (!planned) warnings_.push_back(planned.error());
      }
    }
    return std::move(plans_);
  }

 private:
  Outcome<Done> plan(const Json& mesh, const Json& primitive, PrimitivePlace place) {
    const std::string where = place.pointer();
    const auto mode = integerMember(primitive, "mode", kModeTriangles, where);
    if (!mode) return mode.error();
    if (*mode > kModeFan) return invalid(where + "/mode", "this mode is unknown");
    if (*mode < kModeTriangles) return unsupported(where, "points and lines stay as they are");
    const std::string dependency = orderDependency(mesh, primitive);
    if (purpose_ == Purpose::kCompress && !dependency.empty())
      return unsupported(where, dependency + ": the primitive stays as it is");
    return join(primitive, place);
  }

  /// Adds the primitive to the plan of those with the same attributes.
  Outcome<Done> join(const Json& primitive, PrimitivePlace place) {
    const Json* attributes = objectMember(primitive, "attributes");
    const Json* targets = member(primitive, "targets");
    const std::string key = (attributes ? attributes->dump() : "") + (targets ? targets->dump() : "");
    const auto known = plan_of_.find(key);
    if (known != plan_of_.end()) {
      plans_[known->second].primitives.push_back(place);
      return Done{};
    }
    auto plan = makePlan(attributes, targets, place.pointer());
    if (!plan) return plan.error();
    plan->primitives.push_back(place);
    plan_of_[key] = plans_.size();
    plans_.push_back(*std::move(plan));
    return Done{};
  }

  Outcome<PayloadPlan> makePlan(const Json* attributes, const Json* targets, const std::string& where) {
    if (!attributes || !member(*attributes, "POSITION")) {
      return unsupported(where, "a primitive without POSITION stays as it is");
    }
    PayloadPlan plan;
    std::set<uint64_t> seen;
    const Json position = {{"POSITION", (*attributes)["POSITION"]}};
    for (const Json* list : {&position, attributes}) {
      const auto added = addAll(*list, "", plan, seen, where + "/attributes");
      if (!added) return added.error();
    }
    for (size_t t = 0; targets && targets->is_array() && t < targets->size(); ++t) {
      const auto added = addAll((*targets)[t], "@" + std::to_string(t), plan, seen, where + "/targets");
      if (!added) return added.error();
    }
    return plan;
  }

  Outcome<Done> addAll(const Json& list, const std::string& suffix, PayloadPlan& plan, std::set<uint64_t>& seen,
                       const std::string& where) {
    if (!list.is_object()) return invalid(where, "this is not an object");
    for (const auto& [name, reference] : list.items()) {
      const auto accessor = asInteger(reference);
      if (!accessor) return invalid(where + "/" + name, "this is not the index of an accessor");
      if (!seen.insert(*accessor).second) continue;
      const auto checked = check(name, *accessor, plan);
      if (!checked && checked.error().kind == FailureKind::kUnsupported && purpose_ == Purpose::kRead) continue;
      if (!checked) return checked.error();
      plan.attributes.push_back({name + suffix, *accessor});
    }
    return Done{};
  }

  /// POSITION comes first and decides how many vertices there are.
  Outcome<Done> check(const std::string& name, uint64_t accessor, PayloadPlan& plan) {
    const std::string where = pointerTo("accessors", accessor);
    const auto shape = accessorShape(asset_.json, accessor);
    if (!shape) return shape.error();
    if (plan.attributes.empty()) plan.wedge_count = shape->count;
    if (plan.attributes.empty() && (shape->isMatrix() || shape->components != 3)) {
      return invalid(where, "POSITION must be a VEC3");
    }
    if (shape->count != plan.wedge_count) return invalid(where, "the attributes have different counts");
    if (shape->isMatrix()) return unsupported(where, name + " is a matrix: the primitive stays as it is");
    return Done{};
  }

  const Asset& asset_;
  Purpose purpose_;
  std::vector<Failure>& warnings_;
  std::vector<PayloadPlan> plans_;
  std::map<std::string, size_t> plan_of_;
};

}  // namespace

std::string PrimitivePlace::pointer() const {
  return pointerTo("meshes", mesh) + "/primitives/" + std::to_string(primitive);
}

std::string orderDependency(const Json& mesh, const Json& primitive) {
  if (const Json* extensions = objectMember(mesh, "extensions")) {
    for (const auto& [name, value] : extensions->items()) {
      if (!contains(kOrderFreeOfMeshes, name)) return name + " may refer to vertices or faces by their order";
    }
  }
  const Json* extensions = objectMember(primitive, "extensions");
  if (!extensions) return "";
  for (const auto& [name, value] : extensions->items()) {
    if (name == "EXT_mesh_features") {
      if (hasImplicitFeatures(value)) return name + " numbers the vertices by their order";
    } else if (!contains(kOrderFree, name)) {
      return name + " may refer to vertices or faces by their order";
    }
  }
  return "";
}

Outcome<std::vector<PayloadPlan>> planPayloads(const Asset& asset, Purpose purpose, std::vector<Failure>& warnings) {
  return Planner(asset, purpose, warnings).run();
}

}  // namespace tutte
