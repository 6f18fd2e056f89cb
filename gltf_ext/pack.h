#pragma once
// A mesh to a payload and back: the codec's sections and the attributes together.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codec/decode.h"
#include "codec/encode.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// Who codes the attributes' numbers.
enum class AttributeCoder : uint8_t {
  kAuto,   ///< whichever takes fewer bytes; below effort 2, kTutte, which Draco's next to never beats
  kDraco,  ///< Draco's predictors and entropy coder over our connectivity
  kTutte,  ///< the codec's own predictors, which know polygons, and adaptive coder (codec/values.h)
};

/// How far a component of a decoded value may be from the original: 0: no bound, bits decide.
struct ErrorBound {
  double size = 0;        ///< in units of the attribute
  bool relative = false;  ///< `size` is a part of the attribute's largest extent
};

/// Bounds per kind of attribute, as quantisation bits are.
struct ErrorBounds {
  ErrorBound position, texcoord, color, generic;
};

/// A grid for positions that several meshes share: the points origin + k * step, k whole. Equal positions become equal
/// floats, whatever else is in a mesh.
struct PositionGrid {
  std::array<float, 3> origin{};
  float step = 0;
};

/// Quantisation in bits per component; 0 keeps an attribute as it is, without loss. Integer attributes, JOINTS and
/// WEIGHTS are always coded without loss.
struct PackOptions {
  int position_bits = 14;
  int normal_bits = 10;  ///< normals and tangents
  int texcoord_bits = 12;
  int color_bits = 8;
  int generic_bits = 12;               ///< custom float attributes and morph-target deltas of anything but positions
  ErrorBounds errors{};                ///< where one is given, it decides instead of the bits
  std::optional<PositionGrid> grid{};  ///< of POSITION, also of morph targets, instead of position_bits
  AttributeCoder attribute_coder = AttributeCoder::kAuto;
  EncodeOptions connectivity;  ///< profile and effort, which kTutte shares
  std::optional<bool> weld{};  ///< whether vertices in one place are coded as one; by default where it is shorter
};

/// The same options, but without any quantisation: every attribute comes back bit for bit.
PackOptions withoutLoss(PackOptions options);

/// A payload and how it relates to the mesh that it was made from.
struct Packed {
  std::vector<uint8_t> bytes;
  std::vector<Index> face_order;    ///< coded face -> input face
  std::vector<Index> corner_order;  ///< coded corner (of the decoded mesh's `polygons.corners`) -> input corner
  std::vector<Index> wedge_order;   ///< coded wedge -> input wedge

  // For reports.
  Index splits = 0;
  uint32_t connectivity_bytes = 0;  ///< the connectivity section: header, valences, degrees, splits, joins
  uint32_t seam_bytes = 0;
  uint32_t attribute_bytes = 0;  ///< seams and attribute section
};

/// Codes a mesh that obeys the rules of gltf_ext/mesh_rules.h. Vertices whose positions are equal to the bit are coded
/// as one point where that takes fewer bytes; they come back as they were. A mesh without triangles gets those of
/// triangulate(): fans from the first coded corner where these are right, for they cost nothing. Also refused: a wedge
/// that belongs to two vertices, wedges of one vertex with different positions, and an unequal number of isolated
/// vertices and unused wedges.
Outcome<Packed> pack(const PolygonMesh& mesh, const PackOptions& options = {});

/// The mesh that pack() stored, in coded order; its triangulation is given unless all faces are triangles. Any bytes
/// may be passed.
Outcome<PolygonMesh> unpack(std::span<const uint8_t> payload, const Limits& limits = {});

/// The same, for one payload after the other.
Outcome<PolygonMesh> unpack(std::span<const uint8_t> payload, const Limits& limits, Decoder& decoder);

/// The same without `attributes`, which are not decoded: for those who want indices only.
Outcome<PolygonMesh> unpackTopology(std::span<const uint8_t> payload, const Limits& limits = {});

}  // namespace tutte
