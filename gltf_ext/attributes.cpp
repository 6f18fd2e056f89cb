#include "gltf_ext/attributes.h"

#include <algorithm>
#include <numeric>

#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/draco_planes.h"
#include "gltf_ext/guard.h"
#include "gltf_ext/numeral_attributes.h"
#include "gltf_ext/site_layouts.h"
#include "gltf_ext/value_planes.h"

namespace tutte {
namespace {

constexpr uint8_t kDracoCoder = 0, kValueCoder = 1;
constexpr uint32_t kMaxAttributes = 4096;

// The format byte: component type, components less one, normalized.
constexpr ComponentType kTypes[] = {ComponentType::kInt8,   ComponentType::kUint8,  ComponentType::kInt16,
                                    ComponentType::kUint16, ComponentType::kUint32, ComponentType::kFloat};
constexpr uint8_t kTypeMask = 7;
constexpr int kComponentShift = 3;
constexpr uint8_t kNormalizedFlag = 1 << 5;

struct Head {
  uint8_t coder = kDracoCoder;
  std::vector<Attribute> attributes;  ///< without data
  std::vector<AttributeCoding> codings;
  std::vector<uint32_t> sizes;          ///< of the attributes' descriptions, in bytes
  std::vector<uint32_t> numeral_sizes;  ///< once decoded: what attributes without planes took, else 0
  std::vector<Plane> planes;            ///< of all attributes, without values

  std::span<Plane> planesOf(size_t attribute) {
    const auto [first, last] = std::ranges::equal_range(planes, attribute, {}, &Plane::attribute);
    return {first, last};
  }
};

Failure thrown(const Thrown& thrown) {
  return {FailureKind::kUnsupported, "", std::string(thrown.what) + " while coding attributes"};
}

Failure damaged(const char* what) { return {FailureKind::kInvalid, "", what}; }

void addPlanes(Head& head) {
  for (size_t i = 0; i < head.attributes.size(); ++i) {
    for (Plane& plane : tutte::planesOf(head.attributes[i], head.codings[i], i))
      head.planes.push_back(std::move(plane));
  }
}

void writeAttribute(const Attribute& attribute, const AttributeCoding& coding, ByteWriter& out) {
  writeName(parseName(attribute.name), out);
  const auto type = std::ranges::find(kTypes, attribute.type) - std::begin(kTypes);
  out.byte(static_cast<uint8_t>(type | (attribute.components - 1) << kComponentShift |
                                (attribute.normalized ? kNormalizedFlag : 0)));
  writeCoding(coding, attribute, out);
}

bool readAttribute(ByteReader& in, Head& head) {
  AttributeName name;
  if (!readName(in, name)) return false;
  const uint8_t format = in.byte();
  if ((format & kTypeMask) >= std::size(kTypes) || format >= 2 * kNormalizedFlag) return false;
  Attribute attribute;
  attribute.name = nameOf(name);
  attribute.type = kTypes[format & kTypeMask];
  attribute.components = static_cast<uint8_t>((format >> kComponentShift & 3) + 1);
  attribute.normalized = (format & kNormalizedFlag) != 0;
  auto coding = readCoding(in, attribute);
  if (!coding) return false;
  head.attributes.push_back(std::move(attribute));
  head.codings.push_back(std::move(*coding));
  return true;
}

Outcome<Head> readHead(ByteReader& in) {
  const uint8_t coder = in.byte();
  if (coder > kValueCoder) return damaged("the attribute section has an unknown coder");
  const uint32_t count = in.varint();
  if (in.error() != Error::kNone || count > kMaxAttributes) return damaged("the attribute section's head is damaged");
  Head head;
  head.coder = coder;
  for (uint32_t i = 0; i < count; ++i) {
    const size_t before = in.remaining();
    if (!readAttribute(in, head)) return damaged("an attribute's description is damaged");
    head.sizes.push_back(static_cast<uint32_t>(before - in.remaining()));
  }
  addPlanes(head);
  return head;
}

Outcome<Done> checkAttribute(const Attribute& attribute, Index wedge_count) {
  const bool known = std::ranges::find(kTypes, attribute.type) != std::end(kTypes);
  if (!known || attribute.components < 1 || attribute.components > 4) {
    return Failure{FailureKind::kInvalid, attribute.name, "the attribute's type is none of glTF's"};
  }
  if (attribute.data.size() != size_t{wedge_count} * attribute.stride()) {
    return Failure{FailureKind::kInvalid, attribute.name, "the attribute has not one value per vertex"};
  }
  if (attribute.name.size() > 1024)
    return Failure{FailureKind::kUnsupported, "", "an attribute name exceeds 1024 bytes"};
  return Done{};
}

Outcome<Done> checkOptions(const PackOptions& options) {
  for (const int bits :
       {options.position_bits, options.normal_bits, options.texcoord_bits, options.color_bits, options.generic_bits}) {
    if (bits < 0 || bits > kMaxBits) return Failure{FailureKind::kUsage, "", "quantisation bits must be 0 to 24"};
  }
  if (options.normal_bits == 1) return Failure{FailureKind::kUsage, "", "normals need 2 bits or more (or 0)"};
  return Done{};
}

struct Stream {
  uint8_t coder;
  std::vector<uint8_t> bytes;
};

/// The connectivity's profile.
ValueProfile valueProfile(std::optional<Profile> profile, size_t corners) {
  switch (profile.value_or(profileFor(corners))) {
    case Profile::kFast: return ValueProfile::kFast;
    case Profile::kSmall: return ValueProfile::kSmall;
    default: return ValueProfile::kDefault;
  }
}

Outcome<Stream> encodeStream(const AttributeTopology& topology, std::span<const Plane> planes,
                             const PackOptions& options) {
  if (options.attribute_coder == AttributeCoder::kDraco) {
    auto bytes = encodePlanes(topology, planes);
    if (!bytes) return bytes.error();
    return Stream{kDracoCoder, *std::move(bytes)};
  }
  auto bytes = encodeValuePlanes(topology, planes,
                                 valueProfile(options.connectivity.profile, topology.connectivity.umbrellas.size()));
  if (!bytes) return bytes.error();
  Stream own{kValueCoder, *std::move(bytes)};
  // Draco's coder wins next to never, and takes several times as long.
  const bool both = options.attribute_coder == AttributeCoder::kAuto && options.connectivity.effort >= 2;
  if (!both) return own;
  // What Draco cannot code at all is no reason to fail.
  auto draco = encodePlanes(topology, planes);
  if (draco && draco->size() < own.bytes.size()) return Stream{kDracoCoder, *std::move(draco)};
  return own;
}

bool decodeStream(const AttributeTopology& topology, ByteReader& in, Head& head) {
  SiteLayouts layouts(topology);
  if (!decodeNumeralAttributes(topology, layouts, head.codings, in, head.attributes, head.numeral_sizes)) return false;
  const std::span<const uint8_t> bytes = in.take(in.remaining());
  return head.coder == kDracoCoder ? decodePlanes(topology, bytes, head.planes)
                                   : decodeValuePlanes(topology, layouts, bytes, head.planes);
}

uint32_t headBytes(const Attribute& attribute, const AttributeCoding& coding) {
  ByteWriter out;
  writeCoding(coding, attribute, out);
  return static_cast<uint32_t>(out.bytes().size());
}

/// What chooseCoding() says, or a palette, where that takes fewer bytes than numerals.
Outcome<AttributeCoding> smallestCoding(const AttributeTopology& topology, const Attribute& attribute, size_t index,
                                        const PackOptions& options) {
  AttributeCoding chosen = chooseCoding(attribute, options);
  if (chosen.kind != CodingKind::kNumerals) return chosen;
  std::optional<AttributeCoding> palette = paletteCoding(attribute);
  if (!palette) return chosen;
  const auto numerals = encodeNumeralAttribute(topology, attribute, index, chosen.numerals);
  if (!numerals) return numerals.error();
  std::vector<Plane> planes = planesOf(attribute, *palette, index);
  splitValues(attribute, *palette, planes);
  const auto ranks = encodeValuePlanes(
      topology, planes, valueProfile(options.connectivity.profile, topology.connectivity.umbrellas.size()));
  if (!ranks) return ranks.error();
  const bool fewer = ranks->size() + headBytes(attribute, *palette) < numerals->size() + headBytes(attribute, chosen);
  return fewer ? *std::move(palette) : chosen;
}

Outcome<std::vector<uint8_t>> encode(const AttributeTopology& topology, std::span<const Attribute> attributes,
                                     const PackOptions& options) {
  Head head;
  ByteWriter out;
  out.varint(static_cast<uint32_t>(attributes.size()));
  for (const Attribute& attribute : attributes) {
    const size_t index = head.codings.size();
    auto coding = smallestCoding(topology, attribute, index, options);
    if (!coding) return coding.error();
    head.codings.push_back(*std::move(coding));
    writeAttribute(attribute, head.codings[index], out);
    std::vector<Plane> planes = planesOf(attribute, head.codings[index], index);
    splitValues(attribute, head.codings[index], planes);
    std::ranges::move(planes, std::back_inserter(head.planes));
  }
  const auto numerals = encodeNumeralAttributes(topology, attributes, head.codings, out);
  if (!numerals) return numerals.error();
  auto stream = encodeStream(topology, head.planes, options);
  if (!stream) return stream.error();
  out.append(stream->bytes);
  std::vector<uint8_t> section = std::move(out).take();
  section.insert(section.begin(), stream->coder);
  return section;
}

Outcome<std::vector<Attribute>> decode(const AttributeTopology& topology, std::span<const uint8_t> bytes) {
  ByteReader in(bytes);
  auto head = readHead(in);
  if (!head) return head.error();
  if (!decodeStream(topology, in, *head)) return damaged("the attribute stream is damaged");
  for (size_t i = 0; i < head->attributes.size(); ++i) {
    const std::span<Plane> planes = head->planesOf(i);
    if (!joinValues(planes, head->codings[i], topology.wedge_count, head->attributes[i])) {
      return damaged("an attribute has a value outside its type");
    }
    for (Plane& plane : planes) plane.values = std::vector<int32_t>();
  }
  return std::move(head->attributes);
}

Outcome<std::vector<AttributeSize>> sizesOf(const AttributeTopology& topology, std::span<const uint8_t> bytes) {
  ByteReader in(bytes);
  auto head = readHead(in);
  if (!head) return head.error();
  if (!decodeStream(topology, in, *head)) return damaged("the attribute stream is damaged");
  std::vector<AttributeSize> sizes;
  for (size_t i = 0; i < head->attributes.size(); ++i) {
    sizes.push_back({head->attributes[i].name, head->sizes[i], {}});
    if (head->numeral_sizes[i] > 0) sizes.back().plane_bytes.push_back(head->numeral_sizes[i]);
    for (const Plane& plane : head->planesOf(i)) sizes.back().plane_bytes.push_back(plane.coded_bytes);
  }
  return sizes;
}

}  // namespace

Outcome<std::vector<uint8_t>> encodeAttributes(const AttributeTopology& topology, std::span<const Attribute> attributes,
                                               const PackOptions& options) {
  if (const auto checked = checkOptions(options); !checked) return checked.error();
  if (attributes.size() > kMaxAttributes) return Failure{FailureKind::kUnsupported, "", "more than 4096 attributes"};
  for (const Attribute& attribute : attributes) {
    if (const auto checked = checkAttribute(attribute, topology.wedge_count); !checked) return checked.error();
  }
  return caught([&] { return encode(topology, attributes, options); }, thrown);
}

Outcome<std::vector<Attribute>> describeAttributes(std::span<const uint8_t> bytes) {
  ByteReader in(bytes);
  auto head = readHead(in);
  if (!head) return head.error();
  return std::move(head->attributes);
}

Outcome<std::vector<AttributeCoding>> describeCodings(std::span<const uint8_t> bytes) {
  ByteReader in(bytes);
  auto head = readHead(in);
  if (!head) return head.error();
  return std::move(head->codings);
}

Outcome<std::vector<Attribute>> decodeAttributes(const AttributeTopology& topology, std::span<const uint8_t> bytes) {
  return caught([&] { return decode(topology, bytes); }, thrown);
}

uint32_t AttributeSize::bytes() const { return std::accumulate(plane_bytes.begin(), plane_bytes.end(), head_bytes); }

Outcome<std::vector<AttributeSize>> attributeSizes(const AttributeTopology& topology, std::span<const uint8_t> bytes) {
  return caught([&] { return sizesOf(topology, bytes); }, thrown);
}

}  // namespace tutte
