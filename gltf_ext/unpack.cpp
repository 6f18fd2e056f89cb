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

Outcome<PolygonMesh> unpackSections(std::span<const uint8_t> bytes, const Limits& limits, bool with_attributes) {
  const Result<PayloadView> payload = parsePayload(bytes);
  if (!payload) return failureOf(payload.error(), "header");
  Result<PayloadMesh, PayloadFailure> mesh = decodePayloadMesh(*payload, limits);
  if (!mesh) return failureOf(mesh.error().error, std::string(mesh.error().where));
  if (!with_attributes) return polygonMeshOf(std::move(*mesh), {});
  Outcome<std::vector<Attribute>> attributes = attributesOf(*payload, *mesh);
  if (!attributes) return attributes.error();
  return polygonMeshOf(std::move(*mesh), std::move(*attributes));
}

}  // namespace

Outcome<PolygonMesh> unpack(std::span<const uint8_t> payload, const Limits& limits) {
  return unpackSections(payload, limits, true);
}

Outcome<PolygonMesh> unpackTopology(std::span<const uint8_t> payload, const Limits& limits) {
  return unpackSections(payload, limits, false);
}

}  // namespace tutte
