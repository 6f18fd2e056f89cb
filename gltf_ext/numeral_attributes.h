#pragma once
// Attributes of floats through the codec's coder of numerals, over our connectivity.

#include <cstdint>
#include <span>
#include <vector>

#include "codec/bytes.h"
#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/attributes.h"
#include "gltf_ext/site_layouts.h"

namespace tutte {

/// Appends the attributes whose coding is kNumerals, one after the other: a varint length and the bytes. Fails when an
/// attribute has two values where the topology has one, or the topology contradicts itself.
Outcome<Done> encodeNumeralAttributes(const AttributeTopology& topology, std::span<const Attribute> attributes,
                                      std::span<const AttributeCoding> codings, ByteWriter& out);

/// The bytes of attribute `index` alone.
Outcome<std::vector<uint8_t>> encodeNumeralAttribute(const AttributeTopology& topology, const Attribute& attribute,
                                                     size_t index, const NumeralFormat& format);

/// Reads them and fills in their data; sizes[i] becomes what attribute i took of the bytes, 0 for those with another
/// coding. `layouts` are the topology's. Any bytes may be passed; false when they are no such streams. Takes memory in
/// proportion to the wedges and corners.
bool decodeNumeralAttributes(const AttributeTopology& topology, SiteLayouts& layouts,
                             std::span<const AttributeCoding> codings, ByteReader& in, std::span<Attribute> attributes,
                             std::vector<uint32_t>& sizes);

}  // namespace tutte
