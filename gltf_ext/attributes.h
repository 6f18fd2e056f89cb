#pragma once
// Attributes coded over the decoded connectivity. The door behind which the Draco mode stands (and others will).

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "codec/mesh.h"
#include "codec/mesh_ways.h"
#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/pack.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// What both sides know before attributes are coded.
struct AttributeTopology {
  const Connectivity& connectivity;
  std::span<const Index> wedges;  ///< per coded corner (order of connectivity.umbrellas): its wedge
  Index wedge_count = 0;          ///< wedges that no corner uses come last
  /// Per attribute, per coded corner: 1 when the edge from that corner to the next of its face is a seam of the
  /// attribute (its values differ at an end). An empty span: no seams. Attribute 0 is POSITION and has none.
  std::vector<std::span<const uint8_t>> seams;
  bool trusted = false;  ///< is as encoders and decoders make it; otherwise that is checked first
  /// If trusted, and if they are there: the connectivity's, and as in Seams. Without ways there are no seams.
  const MeshWays* ways = nullptr;
  std::span<const Index> parted_umbrellas{};
};

/// Codes the attributes (given in coded wedge order). The bytes decode with decodeAttributes() over an equal topology.
Outcome<std::vector<uint8_t>> encodeAttributes(const AttributeTopology& topology, std::span<const Attribute> attributes,
                                               const PackOptions& options);

/// The attribute descriptions (everything but `data`) at the head of the section, so that seams can be read before
/// values. Any bytes may be passed; at most 4096 attributes.
Outcome<std::vector<Attribute>> describeAttributes(std::span<const uint8_t> bytes);

/// How each of them was brought to whole numbers: as describeAttributes(), in the same order.
Outcome<std::vector<AttributeCoding>> describeCodings(std::span<const uint8_t> bytes);

/// All attributes, or a Failure. Any bytes may be passed: nothing escapes but the Outcome, and memory is in proportion
/// to attributes * wedges, corners and bytes.
Outcome<std::vector<Attribute>> decodeAttributes(const AttributeTopology& topology, std::span<const uint8_t> bytes);

/// What one attribute takes of the section.
struct AttributeSize {
  std::string name;
  uint32_t head_bytes = 0;            ///< its description
  std::vector<uint32_t> plane_bytes;  ///< its values, one number per plane (see planesOf()); numerals: one

  uint32_t bytes() const;
};

/// Per attribute; in sum the section less its first two or three bytes. Decodes everything, with the errors of
/// decodeAttributes().
Outcome<std::vector<AttributeSize>> attributeSizes(const AttributeTopology& topology, std::span<const uint8_t> bytes);

}  // namespace tutte
