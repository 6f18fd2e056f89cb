// EXT_meshopt_compression (and its KHR successor) through meshoptimizer.

#include <meshoptimizer.h>

#include <algorithm>
#include <string>

#include "gltf_ext/accessors.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/foreign.h"
#include "gltf_ext/references.h"

namespace tutte {
namespace {

constexpr const char* kNames[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// What the extension object says, checked.
struct Stream {
  std::span<const uint8_t> bytes;
  uint64_t count = 0;
  uint64_t stride = 0;
  std::string mode;
  std::string filter;
};

/// meshoptimizer's formats spend at least two bits on 16 bytes of vertices, and a byte on a triangle. Claims of more
/// output than that (and one block) are refused before memory is taken.
constexpr uint64_t kMaxExpansion = 128;
constexpr uint64_t kBlockBytes = 65536;

Outcome<Stream> readStream(const Asset& asset, const Json& object, const std::string& where) {
  const auto buffer = integerMember(object, "buffer", where);
  const auto offset = integerMember(object, "byteOffset", 0, where);
  const auto length = integerMember(object, "byteLength", where);
  const auto stride = integerMember(object, "byteStride", where);
  const auto count = integerMember(object, "count", where);
  for (const auto* value : {&buffer, &offset, &length, &stride, &count}) {
    if (!*value) return value->error();
  }
  if (*buffer >= asset.buffers.size()) return invalid(where + "/buffer", "there is no such buffer");
  const Bytes& bytes = asset.buffers[*buffer];
  if (*offset > bytes.size() || *length > bytes.size() - *offset) {
    return invalid(where, "the compressed data does not lie inside its buffer");
  }
  Stream stream{std::span(bytes).subspan(*offset, *length), *count, *stride, stringMember(object, "mode"),
                stringMember(object, "filter")};
  if (stream.stride == 0 || stream.stride > 256) return invalid(where + "/byteStride", "the stride is out of range");
  if (stream.count == 0 || stream.count > (kMaxExpansion * *length + kBlockBytes) / stream.stride) {
    return invalid(where + "/count", "the data cannot hold as many elements");
  }
  return stream;
}

bool decodeStream(const Stream& stream, Bytes& out) {
  const size_t count = stream.count, stride = stream.stride, size = stream.bytes.size();
  const uint8_t* bytes = stream.bytes.data();
  if (stream.mode == "ATTRIBUTES") {
    return stride % 4 == 0 && meshopt_decodeVertexBuffer(out.data(), count, stride, bytes, size) == 0;
  }
  if (stride != 2 && stride != 4) return false;
  if (stream.mode == "TRIANGLES") {
    return count % 3 == 0 && meshopt_decodeIndexBuffer(out.data(), count, stride, bytes, size) == 0;
  }
  return stream.mode == "INDICES" && meshopt_decodeIndexSequence(out.data(), count, stride, bytes, size) == 0;
}

bool applyFilter(const Stream& stream, Bytes& out) {
  const std::string& filter = stream.filter;
  if (filter.empty() || filter == "NONE") return true;
  if (stream.mode != "ATTRIBUTES") return false;
  if (filter == "OCTAHEDRAL" && (stream.stride == 4 || stream.stride == 8)) {
    meshopt_decodeFilterOct(out.data(), stream.count, stream.stride);
  } else if (filter == "QUATERNION" && stream.stride == 8) {
    meshopt_decodeFilterQuat(out.data(), stream.count, stream.stride);
  } else if (filter == "EXPONENTIAL" && stream.stride % 4 == 0) {
    meshopt_decodeFilterExp(out.data(), stream.count, stream.stride);
  } else {
    return false;
  }
  return true;
}

void useBytes(Asset& asset, Json& view, Bytes bytes) {
  const uint64_t buffer = appendElement(asset.json, "buffers", {{"byteLength", bytes.size()}});
  view["buffer"] = buffer;
  view.erase("byteOffset");
  asset.buffers.push_back(std::move(bytes));
}

/// True when the view is plain afterwards.
Outcome<bool> decodeView(Asset& asset, size_t index, const char* name, std::vector<Failure>& warnings) {
  const std::string where = pointerTo("bufferViews", index) + "/extensions/" + name;
  const auto stream = readStream(asset, *extensionOf(asset.json["bufferViews"][index], name), where);
  if (!stream) return stream.error();
  const auto length = integerMember(asset.json["bufferViews"][index], "byteLength", pointerTo("bufferViews", index));
  if (!length) return length.error();
  if (*length != stream->count * stream->stride) return invalid(where, "byteLength is not count times byteStride");
  Bytes out(*length);
  if (!decodeStream(*stream, out) || !applyFilter(*stream, out)) {
    warnings.push_back(unsupported(where, "the data cannot be decoded: the view stays as it is"));
    return false;
  }
  useBytes(asset, asset.json["bufferViews"][index], std::move(out));
  return true;
}

/// Fallback bytes are the decoded ones by definition; they are taken where they exist.
bool hasFallback(const Asset& asset, size_t index) { return viewBytes(asset, index).ok(); }

Outcome<Done> decodeNamed(Asset& asset, const char* name, std::vector<Failure>& warnings) {
  bool all = true;
  for (size_t i = 0; i < countOf(asset.json, "bufferViews"); ++i) {
    if (!extensionOf(asset.json["bufferViews"][i], name)) continue;
    const auto plain = hasFallback(asset, i) ? Outcome<bool>(true) : decodeView(asset, i, name, warnings);
    if (!plain) return plain.error();
    all = all && *plain;
    if (*plain) eraseExtension(asset.json["bufferViews"][i], name);
  }
  if (!all) return Done{};
  for (size_t i = 0; i < countOf(asset.json, "buffers"); ++i) eraseExtension(asset.json["buffers"][i], name);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) removeExtension(asset.json, list, name);
  return Done{};
}

}  // namespace

Outcome<Done> decodeMeshopt(Asset& asset, std::vector<Failure>& warnings) {
  for (const char* name : kNames) {
    const auto done = decodeNamed(asset, name, warnings);
    if (!done) return done;
  }
  return Done{};
}

}  // namespace tutte
