#include "gltf_ext/asset_rules.h"

#include "gltf_ext/accessors.h"
#include "gltf_ext/references.h"
#include "gltf_ext/scene_nodes.h"

namespace tutte {
namespace {

/// Every sparse value takes bytes of its own in an honest asset; small ones may share some.
constexpr uint64_t kSparseSlack = 1 << 20;

Outcome<Done> checkViews(const Asset& asset) {
  for (size_t i = 0; i < countOf(asset.json, "bufferViews"); ++i) {
    const auto bytes = viewBytes(asset, i);
    if (!bytes && bytes.error().kind == FailureKind::kInvalid) return bytes.error();
  }
  return Done{};
}

Outcome<Done> checkAccessors(const Asset& asset) {
  uint64_t sparse_budget = kSparseSlack;
  for (const Bytes& bytes : asset.buffers) sparse_budget += bytes.size();
  for (size_t i = 0; i < countOf(asset.json, "accessors"); ++i) {
    const auto checked = checkAccessor(asset, i, sparse_budget);
    if (!checked && checked.error().kind == FailureKind::kInvalid) return checked;
  }
  return Done{};
}

Outcome<Done> checkReferences(Json json) {
  Outcome<Done> result = Done{};
  const auto require = [&](const char* array) {
    return [&result, array, count = countOf(json, array)](Json& reference) {
      const uint64_t index = *asInteger(reference);
      if (index >= count) result = invalid(pointerTo(array, index), "something refers to this, but it does not exist");
    };
  };
  forEachAccessorReference(json, require("accessors"));
  forEachViewReference(json, require("bufferViews"));
  return result;
}

}  // namespace

Outcome<Done> checkAsset(const Asset& asset) {
  return guarded<Done>([&]() -> Outcome<Done> {
    for (const auto& check : {checkViews, checkAccessors}) {
      const auto done = check(asset);
      if (!done) return done;
    }
    const auto references = checkReferences(asset.json);
    if (!references) return references;
    Scene nodes;
    return readNodes(asset.json, {}, nodes);
  });
}

}  // namespace tutte
