#include <utility>

#include "codec/payload_mesh.h"
#include "gltf_ext/attribute_topology.h"
#include "gltf_ext/pack.h"

namespace tutte {
namespace {

Outcome<std::vector<Attribute>> attributesOf(const PayloadView& payload, const PayloadMesh& mesh) {
  if (!payload.has(Section::kAttributes)) return std::vector<Attribute>{};
  const std::string section(nameOf(Section::kAttributes));
  const AttributeTopology topology = attributeTopology(mesh.connectivity, mesh.seams);
  Outcome<std::vector<Attribute>> attributes = decodeAttributes(topology, payload[Section::kAttributes]);
  if (!attributes) return attributes.error();
  if (attributes->size() != payload.counts.attributes) return failureOf(Error::kCountMismatch, section);
  for (const Attribute& attribute : *attributes) {
    if (attribute.data.size() != uint64_t{payload.counts.wedges} * attribute.stride()) {
      return failureOf(Error::kAttributes, section);
    }
  }
  return attributes;
}

PolygonMesh polygonMeshOf(PayloadMesh&& mesh, std::vector<Attribute>&& attributes) {
  return {.polygons = std::move(mesh.polygons),
          .wedges = std::move(mesh.wedges),
          .wedge_count = mesh.counts.wedges,
          .groups = std::move(mesh.groups),
          .group_count = mesh.counts.groups,
          .ring_owners = std::move(mesh.ring_owners),
          .triangulation = std::move(mesh.triangulation),
          .attributes = std::move(attributes)};
}

Result<PayloadMesh, PayloadFailure> sectionsOf(const PayloadView& payload, const Limits& limits, Decoder* kept) {
  if (kept) return decodeSections(payload, limits, *kept);
  Decoder decoder;
  return decodeSections(payload, limits, decoder);
}

// So that less is in memory at once, the attributes are decoded before there are polygons, and when a decoder that is
// not `kept` is gone.
Outcome<PolygonMesh> unpackSections(std::span<const uint8_t> bytes, const Limits& limits, bool with_attributes,
                                    Decoder* kept) {
  const Result<PayloadView> payload = parsePayload(bytes);
  if (!payload) return failureOf(payload.error(), "header");
  Result<PayloadMesh, PayloadFailure> mesh = sectionsOf(*payload, limits, kept);
  if (!mesh) return failureOf(mesh.error().error, std::string(mesh.error().where));
  std::vector<Attribute> attributes;
  if (with_attributes) {
    Outcome<std::vector<Attribute>> decoded = attributesOf(*payload, *mesh);
    if (!decoded) return decoded.error();
    attributes = *std::move(decoded);
  }
  const Error error = turnIntoPolygons(*payload, *mesh);
  if (error != Error::kNone) return failureOf(error, std::string(nameOf(Section::kTriangulation)));
  return polygonMeshOf(std::move(*mesh), std::move(attributes));
}

}  // namespace

Outcome<PolygonMesh> unpack(std::span<const uint8_t> payload, const Limits& limits) {
  return unpackSections(payload, limits, true, nullptr);
}

Outcome<PolygonMesh> unpack(std::span<const uint8_t> payload, const Limits& limits, Decoder& decoder) {
  return unpackSections(payload, limits, true, &decoder);
}

Outcome<PolygonMesh> unpackTopology(std::span<const uint8_t> payload, const Limits& limits) {
  return unpackSections(payload, limits, false, nullptr);
}

}  // namespace tutte
