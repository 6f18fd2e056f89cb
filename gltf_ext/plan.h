#pragma once
// Which primitives become one payload, which cannot be compressed, and why.

#include <string>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/json_access.h"

namespace tutte {

/// Where a primitive is in the JSON.
struct PrimitivePlace {
  size_t mesh = 0;
  size_t primitive = 0;

  std::string pointer() const;
  Json& in(Json& json) const { return json["meshes"][mesh]["primitives"][primitive]; }
};

/// One attribute of a payload: an accessor, and the name under which it is used first ("POSITION@0" for morph targets).
struct PlannedAttribute {
  std::string name;
  uint64_t accessor = 0;
};

/// Primitives that share all their attributes.
struct PayloadPlan {
  std::vector<PlannedAttribute> attributes;  ///< POSITION first; each accessor once
  std::vector<PrimitivePlace> primitives;
  uint64_t wedge_count = 0;
};

/// What the plan is for.
enum class Purpose {
  kCompress,  ///< primitives whose order matters to something else are left out
  kRead,      ///< they are not; attributes of a MAT type are
};

/// Groups the primitives. What is left out goes to `warnings`. Errors: kInvalid for JSON that breaks glTF's rules.
Outcome<std::vector<PayloadPlan>> planPayloads(const Asset& asset, Purpose purpose, std::vector<Failure>& warnings);

/// Why this primitive's vertices and faces must keep their order, or "" when nothing refers to them.
std::string orderDependency(const Json& mesh, const Json& primitive);

}  // namespace tutte
