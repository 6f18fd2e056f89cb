#pragma once
// The JSON objects of TUTTE_mesh_compression, and the rules that they obey.

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/json_access.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

inline constexpr const char* kExtensionName = "TUTTE_mesh_compression";

/// What a compressed buffer view holds. The names in JSON are those of nameOf().
enum class Mode : uint8_t {
  kTriangles,            ///< indices of all triangles, group after group
  kPolygonLoops,         ///< EXT_mesh_polygon's loopIndices of all groups
  kPolygonLoopOffsets,   ///< EXT_mesh_polygon's loopIndicesOffsets
  kPolygonIndexOffsets,  ///< EXT_mesh_polygon's indicesOffsets
  kDegrees,              ///< corners of every face
  kAttribute,            ///< one attribute of all wedges
  kWeld,                 ///< per wedge, the first wedge of its vertex
};
inline constexpr int kModeCount = 7;

/// "TRIANGLES", "POLYGON_LOOPS", ...
const char* nameOf(Mode mode);

/// The bytes of one payload, as buffer views name them.
struct PayloadRange {
  uint64_t buffer = 0;
  uint64_t byte_offset = 0;
  uint64_t byte_length = 0;

  auto operator<=>(const PayloadRange&) const = default;
};

/// The extension object of a buffer view.
struct CompressedView {
  PayloadRange payload;
  uint64_t byte_stride = 0;  ///< bytes per element: 1, 2 or 4 for integers; a multiple of 4 for attributes
  uint64_t count = 0;        ///< elements
  Mode mode = Mode::kTriangles;
  uint64_t attribute = 0;  ///< with kAttribute: which one, in the payload's order

  bool operator==(const CompressedView&) const = default;
};

/// Reads the extension object at the JSON pointer `where`. Any JSON may be passed. Errors: kInvalid for a property that
/// is missing or out of range, kUnsupported for an unknown mode.
Outcome<CompressedView> parseCompressedView(const Json& object, const std::string& where);

Json toJson(const CompressedView& view);

/// The extension object of buffer view `index`, or nothing when the view is an ordinary one.
Outcome<std::optional<CompressedView>> compressedViewAt(const Json& json, uint64_t index);

/// True when any extension marks the buffer as a fallback, whose bytes nobody needs who has that extension.
bool isFallbackBuffer(const Json& buffer);

/// Every rule of the extension that can be checked without decoding: properties, ranges, payloads that overlap, views
/// that ask twice for the same array, lengths that contradict counts, placeholders, extensionsUsed and -Required.
/// An empty list means that all are obeyed.
std::vector<Failure> checkExtension(const Asset& asset);

}  // namespace tutte
