// KHR_draco_mesh_compression through Draco's own decoder.

#include <draco/compression/decode.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>

#include <cstring>
#include <memory>
#include <string>

#include "codec/arrays.h"
#include "gltf_ext/accessors.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/foreign.h"
#include "gltf_ext/references.h"

namespace tutte {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Faces per byte that we believe. Draco itself reserves memory for any claim.
constexpr uint64_t kMaxFacesPerByte = 1024;

/// What a Draco header claims, for mesh streams of the format's versions 2.0 to 2.2.
bool claimsAreCredible(std::span<const uint8_t> bytes) {
  constexpr size_t kHeaderBytes = 11, kVersionAt = 5, kMethodAt = 8, kFlagsAt = 10;
  if (bytes.size() <= kHeaderBytes || std::memcmp(bytes.data(), "DRACO", 5) != 0) return false;
  // Metadata would come before the counts; glTF does not use it.
  if (bytes[kVersionAt] != 2 || bytes[kVersionAt + 1] != 2 || bytes[kFlagsAt] & 0x80) return false;
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data() + kHeaderBytes), bytes.size() - kHeaderBytes);
  const bool is_edgebreaker = bytes[kMethodAt] == 1;
  uint8_t traversal = 0;
  uint32_t first = 0, second = 0;
  if (is_edgebreaker && !buffer.Decode(&traversal)) return false;
  if (!draco::DecodeVarint(&first, &buffer) || !draco::DecodeVarint(&second, &buffer)) return false;
  const uint64_t limit = kMaxFacesPerByte * bytes.size();
  return first <= limit && second <= limit;
}

Outcome<std::unique_ptr<draco::Mesh>> decodeMesh(const Asset& asset, const Json& extension, const std::string& where) {
  const auto view = integerMember(extension, "bufferView", where);
  if (!view) return view.error();
  const auto bytes = viewBytes(asset, *view);
  if (!bytes) return bytes.error();
  if (!claimsAreCredible(*bytes))
    return unsupported(where, "this is no Draco mesh of version 2.2, or its counts are absurd");
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) return invalid(where, "Draco cannot decode this: " + mesh.status().error_msg_string());
  return std::move(mesh).value();
}

template <class T>
bool convertAll(const draco::Mesh& mesh, const draco::PointAttribute& attribute, uint32_t components, Bytes& data) {
  data.resize(size_t{mesh.num_points()} * components * sizeof(T));
  T values[4];
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex index = attribute.mapped_index(point);
    if (index.value() >= attribute.size()) return false;
    if (!attribute.ConvertValue<T>(index, static_cast<int8_t>(components), values)) return false;
    std::memcpy(data.data() + size_t{point.value()} * components * sizeof(T), values, components * sizeof(T));
  }
  return true;
}

bool convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const AccessorShape& shape, Bytes& data) {
  switch (shape.type) {
    case ComponentType::kInt8: return convertAll<int8_t>(mesh, attribute, shape.components, data);
    case ComponentType::kUint8: return convertAll<uint8_t>(mesh, attribute, shape.components, data);
    case ComponentType::kInt16: return convertAll<int16_t>(mesh, attribute, shape.components, data);
    case ComponentType::kUint16: return convertAll<uint16_t>(mesh, attribute, shape.components, data);
    case ComponentType::kUint32: return convertAll<uint32_t>(mesh, attribute, shape.components, data);
    case ComponentType::kFloat: return convertAll<float>(mesh, attribute, shape.components, data);
  }
  return false;
}

/// Decodes one primitive into new buffers, and its accessors into views of them.
class PrimitiveDecoder {
 public:
  PrimitiveDecoder(Asset& asset, size_t mesh, size_t primitive)
      : asset_(asset),
        primitive_(asset.json["meshes"][mesh]["primitives"][primitive]),
        where_(pointerTo("meshes", mesh) + "/primitives/" + std::to_string(primitive) + "/extensions/" + kDraco) {}

  Outcome<Done> run() {
    const Json extension = *extensionOf(primitive_, kDraco);
    auto mesh = decodeMesh(asset_, extension, where_);
    if (!mesh) return mesh.error();
    const Json* list = objectMember(extension, "attributes");
    if (!list) return invalid(where_, "the property 'attributes' is missing");
    if (!objectMember(primitive_, "attributes")) return invalid(where_, "the primitive has no attributes");
    for (const auto& [name, id] : list->items()) {
      const auto done = attribute(**mesh, name, id);
      if (!done) return done;
    }
    const auto done = indices(**mesh);
    if (!done) return done;
    eraseExtension(primitive_, kDraco);
    return Done{};
  }

 private:
  Outcome<Done> attribute(const draco::Mesh& mesh, const std::string& name, const Json& id) {
    const auto unique_id = asInteger(id);
    const Json* reference = member(primitive_["attributes"], name.c_str());
    const auto accessor = reference ? asInteger(*reference) : std::nullopt;
    if (!unique_id || !accessor) return invalid(where_ + "/attributes/" + name, "this does not name an attribute");
    const auto* found = mesh.GetAttributeByUniqueId(static_cast<uint32_t>(*unique_id));
    if (!found) return invalid(where_ + "/attributes/" + name, "the Draco data has no such attribute");
    const auto shape = accessorShape(asset_.json, *accessor);
    if (!shape) return shape.error();
    Bytes data;
    if (shape->isMatrix() || found->num_components() != shape->components || !convert(mesh, *found, *shape, data)) {
      return invalid(where_ + "/attributes/" + name, "the Draco data does not fit the accessor");
    }
    const size_t size = shape->elementBytes(), stride = (size + 3) / 4 * 4;
    const size_t view =
        appendView(asset_, padElements(data, size, stride), {{"target", 34962}, {"byteStride", stride}});
    primitive_["attributes"][name] = replace(*accessor, view, mesh.num_points());
    return Done{};
  }

  Outcome<Done> indices(const draco::Mesh& mesh) {
    std::vector<Index> corners;
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
      for (const draco::PointIndex& point : mesh.face(face)) corners.push_back(point.value());
    }
    if (corners.empty()) return unsupported(where_, "the Draco data has no faces");
    const uint32_t stride = mesh.num_points() < 0xFFFF ? 2 : 4;
    auto bytes = packIndices(corners, stride);
    if (!bytes) return invalid(where_, "an index is out of range");
    const auto old = integerMember(primitive_, "indices", where_);
    if (old && *old >= countOf(asset_.json, "accessors")) return invalid(where_, "the indices do not exist");
    const size_t view = appendView(asset_, *std::move(bytes), {{"target", 34963}});
    const uint64_t base = old ? *old : appendElement(asset_.json, "accessors", {{"type", "SCALAR"}});
    const uint64_t index = replace(base, view, corners.size());
    asset_.json["accessors"][index]["componentType"] = stride == 2 ? 5123 : 5125;
    primitive_["indices"] = index;
    return Done{};
  }

  /// A copy of an accessor with new data: others may share the old one, with another order of vertices.
  uint64_t replace(uint64_t accessor, uint64_t view, uint64_t count) {
    Json copy = asset_.json["accessors"][accessor];
    copy["bufferView"] = view;
    copy["count"] = count;
    for (const char* key : {"byteOffset", "sparse"}) copy.erase(key);
    return appendElement(asset_.json, "accessors", std::move(copy));
  }

  Asset& asset_;
  Json& primitive_;
  std::string where_;
};

/// Morph targets of a Draco primitive are ordinary accessors in the order of the decoded vertices, so that they fit.
Outcome<Done> decodeAll(Asset& asset, std::vector<Failure>& warnings, bool& all) {
  for (size_t m = 0; m < countOf(asset.json, "meshes"); ++m) {
    const Json* primitives = member(asset.json["meshes"][m], "primitives");
    for (size_t p = 0; primitives && primitives->is_array() && p < primitives->size(); ++p) {
      if (!extensionOf((*primitives)[p], kDraco)) continue;
      const auto done = PrimitiveDecoder(asset, m, p).run();
      if (!done && done.error().kind != FailureKind::kUnsupported) return done;
      if (done) continue;
      warnings.push_back(done.error());
      all = false;
    }
  }
  return Done{};
}

}  // namespace

Outcome<Done> decodeDraco(Asset& asset, std::vector<Failure>& warnings) {
  bool all = true;
  const auto done = decodeAll(asset, warnings, all);
  if (!done || !all) return done;
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) removeExtension(asset.json, list, kDraco);
  return Done{};
}

}  // namespace tutte
