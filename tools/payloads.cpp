#include "tools/payloads.h"

#include "gltf_ext/decompress.h"

namespace tutte {

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
