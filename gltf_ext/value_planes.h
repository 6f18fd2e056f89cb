#pragma once
// Planes of whole numbers through the codec's own value coder, over our connectivity.

#include <cstdint>
#include <span>
#include <vector>

#include "codec/values.h"
#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/attributes.h"
#include "gltf_ext/site_layouts.h"

namespace tutte {

/// The planes in their order, each with its own statistics. The stream depends on the topology and on kind, components
/// and max of the planes, which the decoder must know.
/// Fails when a plane has two values where the topology has one, or the topology contradicts itself.
Outcome<std::vector<uint8_t>> encodeValuePlanes(const AttributeTopology& topology, std::span<const Plane> planes,
                                                ValueProfile profile);

/// Fills the planes' values. `layouts` are the topology's. Any bytes may be passed; false when they are no such stream.
/// Takes memory in proportion to planes * wedges and corners.
bool decodeValuePlanes(const AttributeTopology& topology, SiteLayouts& layouts, std::span<const uint8_t> bytes,
                       std::span<Plane> planes);

}  // namespace tutte
