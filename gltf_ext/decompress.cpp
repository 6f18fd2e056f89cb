#include "gltf_ext/decompress.h"

#include <algorithm>

#include "codec/arrays.h"
#include "codec/payload.h"
#include "gltf_ext/accessors.h"
#include "gltf_ext/buffers.h"
#include "gltf_ext/emit.h"
#include "gltf_ext/pack.h"

namespace tutte {
namespace {

std::string pointerOf(const PayloadRange& range) {
  return pointerTo("buffers", range.buffer) + " at byte " + std::to_string(range.byte_offset);
}

/// What the header claims against what a view expects, as far as both say it before decoding.
bool agrees(const PayloadCounts& counts, const CompressedView& view) {
  switch (view.mode) {
    case Mode::kTriangles: return view.count == uint64_t{counts.triangles} * 3;
    case Mode::kPolygonLoops: return view.count <= uint64_t{counts.corners} + counts.faces;
    case Mode::kPolygonLoopOffsets:
    case Mode::kPolygonIndexOffsets: return view.count <= counts.faces;
    case Mode::kDegrees: return view.count == counts.faces;
    case Mode::kAttribute: return view.count == counts.wedges && view.attribute < counts.attributes;
    case Mode::kWeld: return view.count == counts.wedges;
  }
  return false;
}

DerivedArray deriveArray(const ArraySource& source, Mode mode) {
  switch (mode) {
    case Mode::kTriangles: return triangleIndices(source);
    case Mode::kPolygonLoops: return polygonLoops(source);
    case Mode::kPolygonLoopOffsets: return polygonLoopOffsets(source);
    case Mode::kPolygonIndexOffsets: return polygonIndexOffsets(source);
    case Mode::kDegrees: return ringDegrees(source);
    default: return weldedWedges(source);
  }
}

Outcome<Bytes> attributeBytes(const PolygonMesh& mesh, const CompressedView& view, const std::string& where) {
  const Attribute& attribute = mesh.attributes[view.attribute];
  if (view.byte_stride != (attribute.stride() + 3) / 4 * 4) {
    return invalid(where + "/byteStride", "the attribute's elements have another size");
  }
  return padElements(attribute.data, attribute.stride(), view.byte_stride);
}

/// Puts decoded bytes behind a view, in a buffer of their own.
void fillView(Asset& asset, size_t index, Bytes bytes) {
  const uint64_t buffer = appendElement(asset.json, "buffers", {{"byteLength", bytes.size()}});
  Json& view = asset.json["bufferViews"][index];
  view["buffer"] = buffer;
  view.erase("byteOffset");
  eraseExtension(view, kExtensionName);
  asset.buffers.push_back(std::move(bytes));
}

void removeTraces(Json& json) {
  for (size_t i = 0; i < countOf(json, "buffers"); ++i) eraseExtension(json["buffers"][i], kExtensionName);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) removeExtension(json, list, kExtensionName);
}

Outcome<Asset> decompressGuarded(const Asset& asset) {
  const auto payloads = payloadViewsOf(asset);
  if (!payloads) return payloads.error();
  if (payloads->empty()) return asset;
  Asset plain = asset;
  Decoder decoder;
  for (const auto& [range, views] : *payloads) {
    std::vector<CompressedView> objects;
    for (const auto& [index, view] : views) objects.push_back(view);
    const auto mesh = decodePayload(asset, range, objects, decoder);
    if (!mesh) return mesh.error();
    for (const auto& [index, view] : views) {
      auto bytes = decodedBytes(*mesh, view, pointerTo("bufferViews", index));
      if (!bytes) return bytes.error();
      fillView(plain, index, *std::move(bytes));
    }
  }
  removeTraces(plain.json);
  const auto merged = mergeBuffers(plain);
  if (!merged) return merged.error();
  return plain;
}

void compareFallback(const Asset& asset, size_t index, const Bytes& decoded, std::vector<Failure>& failures) {
  const auto stored = viewBytes(asset, index);
  if (!stored || std::equal(stored->begin(), stored->end(), decoded.begin(), decoded.end())) return;
  failures.push_back(invalid(pointerTo("bufferViews", index), "the fallback bytes are not the decoded ones"));
}

void validatePayload(const Asset& asset, const PayloadRange& range,
                     const std::vector<std::pair<size_t, CompressedView>>& views, Decoder& decoder,
                     std::vector<Failure>& failures) {
  std::vector<CompressedView> objects;
  for (const auto& [index, view] : views) objects.push_back(view);
  const auto mesh = decodePayload(asset, range, objects, decoder);
  if (!mesh) return failures.push_back(mesh.error());
  for (const auto& [index, view] : views) {
    const auto bytes = decodedBytes(*mesh, view, pointerTo("bufferViews", index));
    if (bytes) {
      compareFallback(asset, index, *bytes, failures);
    } else {
      failures.push_back(bytes.error());
    }
  }
}

}  // namespace

Outcome<PayloadViews> payloadViewsOf(const Asset& asset) {
  const std::vector<Failure> failures = checkExtension(asset);
  if (!failures.empty()) return failures.front();
  PayloadViews payloads;
  for (size_t i = 0; i < countOf(asset.json, "bufferViews"); ++i) {
    const auto view = compressedViewAt(asset.json, i);
    if (!view) return view.error();
    if (*view) payloads[(**view).payload].push_back({i, **view});
  }
  return payloads;
}

Outcome<PolygonMesh> decodePayload(const Asset& asset, const PayloadRange& range,
                                   const std::vector<CompressedView>& views, Decoder& decoder) {
  const std::string where = pointerOf(range);
  if (range.buffer >= asset.buffers.size()) return invalid(where, "there is no such buffer");
  const Bytes& buffer = asset.buffers[range.buffer];
  if (range.byte_offset > buffer.size() || range.byte_length > buffer.size() - range.byte_offset) {
    return invalid(where, "the payload does not lie inside its buffer");
  }
  const auto bytes = std::span(buffer).subspan(range.byte_offset, range.byte_length);
  const auto counts = peekCounts(bytes);
  if (!counts) return failureOf(counts.error(), where);
  for (const CompressedView& view : views) {
    if (!agrees(*counts, view)) {
      return invalid(where, std::string("the payload does not have as many elements as the view of mode ") +
                                nameOf(view.mode) + " declares");
    }
  }
  auto mesh = unpack(bytes, {}, decoder);
  if (mesh) return mesh;
  Failure failure = mesh.error();
  failure.where = where + (failure.where.empty() ? "" : " " + failure.where);
  return failure;
}

Outcome<Bytes> decodedBytes(const PolygonMesh& mesh, const CompressedView& view, const std::string& where) {
  if (view.mode == Mode::kAttribute) {
    if (view.attribute >= mesh.attributes.size() || view.count != mesh.wedge_count) {
      return invalid(where, "the payload has no such attribute");
    }
    return attributeBytes(mesh, view, where);
  }
  const DerivedArray array = deriveArray(arraySourceOf(mesh), view.mode);
  if (array.values.size() != view.count) return invalid(where, "the payload decodes to another count");
  auto bytes = packIndices(array.values, static_cast<uint32_t>(view.byte_stride));
  if (!bytes) return invalid(where + "/byteStride", "a decoded index does not fit into the stride");
  return *std::move(bytes);
}

Outcome<Asset> decompress(const Asset& asset) {
  return guarded<Asset>([&] { return decompressGuarded(asset); });
}

std::vector<Failure> validate(const Asset& asset) {
  std::vector<Failure> failures = checkExtension(asset);
  if (!failures.empty()) return failures;
  const auto done = guarded<Done>([&]() -> Outcome<Done> {
    const auto payloads = payloadViewsOf(asset);
    if (!payloads) return payloads.error();
    Decoder decoder;
    for (const auto& [range, views] : *payloads) validatePayload(asset, range, views, decoder, failures);
    return Done{};
  });
  if (!done) failures.push_back(done.error());
  return failures;
}

}  // namespace tutte
