#include "tools/payloads.h"

#include <algorithm>

#include "codec/payload_mesh.h"
#include "gltf_ext/attribute_topology.h"
#include "gltf_ext/decompress.h"

namespace tutte {

Outcome<std::vector<AttributeSize>> attributeSizesOf(const PayloadView& payload) {
  if (!payload.has(Section::kAttributes)) return std::vector<AttributeSize>();
  const Result<PayloadMesh, PayloadFailure> mesh = decodePayloadMesh(payload, Limits{});
  if (!mesh) return failureOf(mesh.error().error, "section " + std::string(mesh.error().where));
  return attributeSizes(attributeTopology(mesh->connectivity, mesh->seams), payload[Section::kAttributes]);
}

std::optional<std::map<std::string, double>> codedBounds(const Asset& asset) {
  const Outcome<std::vector<PayloadBytes>> payloads = payloadsOf(asset);
  if (!payloads) return {};
  std::map<std::string, double> bounds;
  for (const PayloadBytes& payload : *payloads) {
    const auto section = payload.view[Section::kAttributes];
    const auto attributes = describeAttributes(section);
    const auto codings = describeCodings(section);
    if (!attributes || !codings) continue;
    for (size_t i = 0; i < attributes->size(); ++i) {
      double& bound = bounds[(*attributes)[i].name];
      bound = std::max(bound, errorBound((*codings)[i]));
    }
  }
  return bounds;
}

Outcome<std::vector<PayloadBytes>> payloadsOf(const Asset& asset) {
  const Outcome<PayloadViews> views = payloadViewsOf(asset);
  if (!views) return views.error();
  std::vector<PayloadBytes> payloads;
  for (const auto& [range, users] : *views) {
    const std::string where = "/bufferViews/" + std::to_string(users.front().first);
    if (range.buffer >= asset.buffers.size() || range.byte_offset > asset.buffers[range.buffer].size() ||
        range.byte_length > asset.buffers[range.buffer].size() - range.byte_offset) {
      return Failure{FailureKind::kInvalid, where, "the payload lies outside its buffer; get the file once more"};
    }
    const auto bytes = std::span(asset.buffers[range.buffer]).subspan(range.byte_offset, range.byte_length);
    const Result<PayloadView> view = parsePayload(bytes);
    if (!view) return failureOf(view.error(), where);
    payloads.push_back({range, bytes, *view});
  }
  if (payloads.empty()) {
    return Failure{FailureKind::kUnsupported, "", "nothing in it is compressed by us; make it with 'tutte encode'"};
  }
  return payloads;
}

}  // namespace tutte
