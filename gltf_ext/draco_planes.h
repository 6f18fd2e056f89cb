#pragma once
// Planes of whole numbers through Draco's attribute coders, over our connectivity. Free of Draco itself.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/attributes.h"

namespace tutte {

/// Whether this build has Draco. Without it the two functions below fail, whatever they are given.
bool hasDraco();

/// The planes in their order, as Draco codes an attribute encoder's values, without any of Draco's headers. The stream
/// depends on the topology and on kind, components and max of the planes, which the decoder must know.
/// Fails when a plane has two values where the topology has one, or the topology contradicts itself.
Outcome<std::vector<uint8_t>> encodePlanes(const AttributeTopology& topology, std::span<const Plane> planes);

/// Fills the planes' values. Any bytes may be passed; false when they are no such stream. Never throws; takes memory
/// in proportion to wedges, corners and bytes.
bool decodePlanes(const AttributeTopology& topology, std::span<const uint8_t> bytes, std::span<Plane> planes);

}  // namespace tutte
