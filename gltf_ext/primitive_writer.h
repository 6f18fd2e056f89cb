#pragma once
// Primitives that show a payload's arrays in place of their old accessors.

#include <map>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/emit.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/plan.h"
#include "gltf_ext/polygons.h"

namespace tutte {

/// Points the primitives of one payload to new accessors. Old ones stay in the asset until nobody uses them.
class PrimitiveWriter {
 public:
  /// Both must outlive the writer.
  PrimitiveWriter(Asset& asset, std::vector<Failure>& warnings) : asset_(asset), warnings_(warnings) {}

  /// Adds the accessors of the payload's attributes, with the names and extras of those that they replace. Bounds are
  /// given where glTF demands them or the old accessor has them.
  void replaceAttributes(const PayloadPlan& plan, const EmittedPayload& emitted);

  /// Rewrites one primitive, which shows face group `number`.
  void write(PrimitivePlace place, size_t number, const EmittedGroup& group, PolygonNotation wish);

 private:
  uint64_t addAttribute(uint64_t replaced, const Json& emitted, bool is_position);
  const Json& membersOf(const Json& primitive, size_t number, const EmittedGroup& group);

  Asset& asset_;
  std::vector<Failure>& warnings_;
  std::map<uint64_t, uint64_t> replaced_;  ///< old accessor -> new accessor
  std::map<size_t, Json> members_;         ///< per group: `indices` and, with polygons, the object `polygon`
};

}  // namespace tutte
