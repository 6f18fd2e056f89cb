#include "gltf_ext/numeral_attributes.h"

#include <algorithm>

#include "gltf_ext/attribute_words.h"

namespace tutte {
namespace {

bool anyNumerals(std::span<const AttributeCoding> codings) {
  return std::ranges::any_of(codings, [](const auto& coding) { return coding.kind == CodingKind::kNumerals; });
}

/// The floats' bits per site; empty when wedges of one site differ.
std::vector<uint32_t> siteFloats(const Attribute& attribute, const WedgeSites& wedges) {
  const size_t components = attribute.components;
  std::vector<uint32_t> floats(wedges.count * components);
  std::vector<uint8_t> known(wedges.count, 0);
  for (size_t w = 0; w < wedgeCount(wedges); ++w) {
    const Index site = siteOf(wedges, w);
    const uint8_t* const source = &attribute.data[w * attribute.stride()];
    for (size_t c = 0; c < components; ++c) {
      uint32_t& target = floats[site * components + c];
      const uint32_t bits = loadBytes(source + 4 * c, 4);
      if (known[site] && target != bits) return {};
      target = bits;
    }
    known[site] = 1;
  }
  return floats;
}

Failure contradiction() { return {FailureKind::kInvalid, "", "the attributes' topology contradicts itself"}; }

Outcome<std::vector<uint8_t>> encodeAt(const SiteLayout& layout, const Attribute& attribute,
                                       const NumeralFormat& format) {
  const std::vector<uint32_t> floats = siteFloats(attribute, layout.wedges);
  if (floats.empty() && layout.wedges.count > 0) {
    return Failure{FailureKind::kInvalid, "", "an attribute has two values where its seams allow one"};
  }
  return encodeNumerals(*layout.graph, format, floats);
}

void spreadFloats(std::span<const uint32_t> floats, const WedgeSites& wedges, Attribute& attribute) {
  const size_t components = attribute.components;
  attribute.data.resize(wedgeCount(wedges) * attribute.stride());
  uint8_t* target = attribute.data.data();
  for (size_t w = 0; w < wedgeCount(wedges); ++w, target += attribute.stride()) {
    const uint32_t* const source = &floats[siteOf(wedges, w) * components];
    for (size_t c = 0; c < components; ++c) storeFourBytes(target + 4 * c, source[c]);
  }
}

}  // namespace

Outcome<Done> encodeNumeralAttributes(const AttributeTopology& topology, std::span<const Attribute> attributes,
                                      std::span<const AttributeCoding> codings, ByteWriter& out) {
  if (!anyNumerals(codings)) return Done{};
  if (!isConsistent(topology)) return contradiction();
  SiteLayouts layouts(topology);
  for (size_t i = 0; i < attributes.size(); ++i) {
    if (codings[i].kind != CodingKind::kNumerals) continue;
    const auto bytes = encodeAt(layouts.get(i), attributes[i], codings[i].numerals);
    if (!bytes) return bytes.error();
    out.varint(static_cast<uint32_t>(bytes->size()));
    out.append(*bytes);
  }
  return Done{};
}

Outcome<std::vector<uint8_t>> encodeNumeralAttribute(const AttributeTopology& topology, const Attribute& attribute,
                                                     size_t index, const NumeralFormat& format) {
  if (!isConsistent(topology)) return contradiction();
  SiteLayouts layouts(topology);
  return encodeAt(layouts.get(index), attribute, format);
}

bool decodeNumeralAttributes(const AttributeTopology& topology, SiteLayouts& layouts,
                             std::span<const AttributeCoding> codings, ByteReader& in, std::span<Attribute> attributes,
                             std::vector<uint32_t>& sizes) {
  sizes.assign(attributes.size(), 0);
  if (!anyNumerals(codings)) return true;
  if (!isConsistent(topology)) return false;
  for (size_t i = 0; i < attributes.size(); ++i) {
    if (codings[i].kind != CodingKind::kNumerals) continue;
    SiteLayout& layout = layouts.get(i);
    const size_t before = in.remaining();
    const uint32_t size = in.varint();
    const auto bytes = in.take(size);
    sizes[i] = static_cast<uint32_t>(before - in.remaining());
    if (in.error() != Error::kNone) return false;
    const auto floats = decodeNumerals(*layout.graph, codings[i].numerals, bytes);
    if (!floats) return false;
    spreadFloats(*floats, layout.wedges, attributes[i]);
  }
  return true;
}

}  // namespace tutte
