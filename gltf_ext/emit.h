#pragma once
// A payload as buffer views and accessors.

#include <optional>
#include <vector>

#include "codec/arrays.h"
#include "gltf_ext/accessors.h"
#include "gltf_ext/asset.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/pack.h"
#include "gltf_ext/polygon_mesh.h"
#include "gltf_ext/polygons.h"

namespace tutte {

/// A decoded mesh as the codec's derived arrays want it. The mesh must outlive it.
ArraySource arraySourceOf(const PolygonMesh& mesh);

/// How one primitive's faces are to be written.
struct GroupWish {
  PolygonNotation notation = PolygonNotation::kTriangles;
};

/// What became of it: accessors, not yet in the asset.
struct EmittedGroup {
  Json indices;        ///< accessor of the triangles
  bool fans = false;   ///< FB_ngon_encoding may be written, and was asked for
  Json index_offsets;  ///< accessors of EXT_mesh_polygon; null without it
  Json loops;
  Json loop_offsets;
  uint64_t polygons = 0;  ///< count of EXT_mesh_polygon
};

struct EmittedPayload {
  std::vector<Json> attributes;  ///< accessors, in the payload's order
  std::vector<EmittedGroup> groups;
};

/// Writes payloads into an asset: their bytes, buffer views with the extension, and the placeholder (or fallback)
/// buffer that these views describe.
class PayloadEmitter {
 public:
  /// The asset must outlive the emitter.
  PayloadEmitter(Asset& asset, bool fallback) : asset_(asset), fallback_(fallback) {}

  /// Adds a payload that decodes to `decoded`. Every group must have a triangle; `index_bytes` is the least width of
  /// indices. Groups that ask for fans but are none get EXT_mesh_polygon.
  Outcome<EmittedPayload> add(Bytes payload, const PolygonMesh& decoded, const std::vector<GroupWish>& wishes,
                              uint64_t index_bytes);

  /// Completes the placeholder and the lists of extensions, when anything was added.
  void finish();

 private:
  struct View {
    uint64_t index = 0;
    uint64_t stride = 0;
  };

  Json indexAccessor(const DerivedArray& array, const View& view, size_t group) const;
  size_t addView(CompressedView view, std::span<const uint8_t> decoded, uint64_t target);
  Outcome<View> addIndices(const PayloadRange& payload, Mode mode, const DerivedArray& array, uint64_t stride);
  Json addAttribute(const PayloadRange& payload, const PolygonMesh& mesh, size_t index);
  Outcome<Done> addPolygons(const PayloadRange& payload, const ArraySource& source, uint64_t index_bytes,
                            EmittedPayload& emitted, const std::vector<bool>& wanted);

  Asset& asset_;
  bool fallback_;
  std::optional<uint64_t> placeholder_;
  uint64_t placeholder_bytes_ = 0;
};

}  // namespace tutte
