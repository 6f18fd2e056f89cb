#include "gltf_ext/emit.h"

#include <algorithm>

namespace tutte {
namespace {

constexpr uint64_t kVertexTarget = 34962;
constexpr uint64_t kIndexTarget = 34963;

uint64_t componentTypeOf(uint64_t stride) { return stride == 1 ? 5121 : stride == 2 ? 5123 : 5125; }

/// Bytes for values of at most `largest`, so that the restart value stays free.
uint64_t bytesFor(uint64_t largest, uint64_t least) {
  return std::max<uint64_t>(least, largest < 0xFF ? 1 : largest < 0xFFFF ? 2 : 4);
}

uint64_t offsetBytes(const DerivedArray& array) {
  const auto largest = std::max_element(array.values.begin(), array.values.end());
  return bytesFor(largest == array.values.end() ? 0 : *largest, 2);
}

bool wantsFans(PolygonNotation notation) {
  return notation == PolygonNotation::kFb || notation == PolygonNotation::kBoth;
}

bool wantsPolygons(PolygonNotation notation) {
  return notation == PolygonNotation::kExt || notation == PolygonNotation::kBoth;
}

uint64_t roundUp(uint64_t value) { return (value + 3) / 4 * 4; }

}  // namespace

ArraySource arraySourceOf(const PolygonMesh& mesh) {
  return {mesh.polygons,    mesh.wedges,      mesh.wedge_count,  mesh.groups,
          mesh.group_count, mesh.ring_owners, mesh.triangulation};
}

size_t PayloadEmitter::addView(CompressedView view, std::span<const uint8_t> decoded, uint64_t target) {
  if (!placeholder_) {
    const Json marked = {{"byteLength", 0}, {"extensions", {{kExtensionName, {{"fallback", true}}}}}};
    placeholder_ = appendElement(asset_.json, "buffers", marked);
    asset_.buffers.resize(*placeholder_ + 1);
  }
  Json parent = {{"buffer", *placeholder_},
                 {"byteOffset", placeholder_bytes_},
                 {"byteLength", decoded.size()},
                 {"extensions", {{kExtensionName, toJson(view)}}}};
  if (target) parent["target"] = target;
  if (view.mode == Mode::kAttribute) parent["byteStride"] = view.byte_stride;
  placeholder_bytes_ += roundUp(decoded.size());
  if (fallback_) {
    Bytes& bytes = asset_.buffers[*placeholder_];
    bytes.insert(bytes.end(), decoded.begin(), decoded.end());
    bytes.resize(placeholder_bytes_);
  }
  return appendElement(asset_.json, "bufferViews", std::move(parent));
}

Outcome<PayloadEmitter::View> PayloadEmitter::addIndices(const PayloadRange& payload, Mode mode,
                                                         const DerivedArray& array, uint64_t stride) {
  const auto bytes = packIndices(array.values, static_cast<uint32_t>(stride));
  if (!bytes) return failureOf(bytes.error(), nameOf(mode));
  const uint64_t target = mode == Mode::kTriangles ? kIndexTarget : 0;
  return View{addView({payload, stride, array.values.size(), mode, 0}, *bytes, target), stride};
}

Json PayloadEmitter::indexAccessor(const DerivedArray& array, const View& view, size_t group) const {
  const uint64_t begin = array.group_starts[group], end = array.group_starts[group + 1];
  Json accessor = {{"bufferView", view.index},
                   {"componentType", componentTypeOf(view.stride)},
                   {"count", end - begin},
                   {"type", "SCALAR"}};
  if (begin > 0) accessor["byteOffset"] = begin * view.stride;
  return accessor;
}

Json PayloadEmitter::addAttribute(const PayloadRange& payload, const PolygonMesh& mesh, size_t index) {
  const Attribute& attribute = mesh.attributes[index];
  const uint64_t stride = roundUp(attribute.stride());
  const Bytes padded = padElements(attribute.data, attribute.stride(), stride);
  const size_t view = addView({payload, stride, mesh.wedge_count, Mode::kAttribute, index}, padded, kVertexTarget);
  Json accessor = {{"bufferView", view},
                   {"componentType", static_cast<uint64_t>(attribute.type)},
                   {"count", mesh.wedge_count},
                   {"type", typeName(attribute.components)}};
  if (attribute.normalized) accessor["normalized"] = true;
  setBounds(accessor, attribute.data, attribute.components, attribute.type);
  return accessor;
}

Outcome<Done> PayloadEmitter::addPolygons(const PayloadRange& payload, const ArraySource& source, uint64_t index_bytes,
                                          EmittedPayload& emitted, const std::vector<bool>& wanted) {
  const DerivedArray index_offsets = polygonIndexOffsets(source), loops = polygonLoops(source),
                     loop_offsets = polygonLoopOffsets(source);
  const auto first = addIndices(payload, Mode::kPolygonIndexOffsets, index_offsets, offsetBytes(index_offsets));
  if (!first) return first.error();
  const auto second = addIndices(payload, Mode::kPolygonLoops, loops, index_bytes);
  if (!second) return second.error();
  const auto third = addIndices(payload, Mode::kPolygonLoopOffsets, loop_offsets, offsetBytes(loop_offsets));
  if (!third) return third.error();
  for (size_t g = 0; g < wanted.size(); ++g) {
    if (!wanted[g]) continue;
    EmittedGroup& group = emitted.groups[g];
    group.polygons = index_offsets.group_starts[g + 1] - index_offsets.group_starts[g];
    group.index_offsets = indexAccessor(index_offsets, *first, g);
    group.loops = indexAccessor(loops, *second, g);
    group.loop_offsets = indexAccessor(loop_offsets, *third, g);
  }
  return Done{};
}

Outcome<EmittedPayload> PayloadEmitter::add(Bytes payload, const PolygonMesh& decoded,
                                            const std::vector<GroupWish>& wishes, uint64_t index_bytes) {
  const uint64_t length = payload.size();
  const PayloadRange range{appendElement(asset_.json, "buffers", {{"byteLength", length}}), 0, length};
  asset_.buffers.resize(range.buffer + 1);
  asset_.buffers[range.buffer] = std::move(payload);

  const ArraySource source = arraySourceOf(decoded);
  const TriangleArray triangles = triangleIndices(source);
  index_bytes = bytesFor(decoded.wedge_count - 1, index_bytes);
  const auto view = addIndices(range, Mode::kTriangles, triangles, index_bytes);
  if (!view) return view.error();
  EmittedPayload emitted;
  std::vector<bool> wanted(wishes.size());
  for (size_t g = 0; g < wishes.size(); ++g) {
    EmittedGroup group;
    group.indices = indexAccessor(triangles, *view, g);
    group.fans = wantsFans(wishes[g].notation) && triangles.ngon_encoding[g];
    wanted[g] = wantsPolygons(wishes[g].notation) || (wantsFans(wishes[g].notation) && !group.fans);
    emitted.groups.push_back(std::move(group));
  }
  if (std::find(wanted.begin(), wanted.end(), true) != wanted.end()) {
    const auto added = addPolygons(range, source, index_bytes, emitted, wanted);
    if (!added) return added.error();
  }
  for (size_t i = 0; i < decoded.attributes.size(); ++i) emitted.attributes.push_back(addAttribute(range, decoded, i));
  return emitted;
}

void PayloadEmitter::finish() {
  if (!placeholder_) return;
  asset_.json["buffers"][*placeholder_]["byteLength"] = placeholder_bytes_;
  addExtension(asset_.json, "extensionsUsed", kExtensionName);
  if (!fallback_) addExtension(asset_.json, "extensionsRequired", kExtensionName);
}

}  // namespace tutte
