#include "gltf_ext/glb.h"

#include <algorithm>

#include "codec/bytes.h"
#include "gltf_ext/json_access.h"

namespace tutte {
namespace {

constexpr uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr uint32_t kJsonChunk = 0x4E4F534A;
constexpr uint32_t kBinChunk = 0x004E4942;
constexpr size_t kHeaderBytes = 12;
constexpr size_t kChunkHeaderBytes = 8;

void putChunk(ByteWriter& writer, uint32_t type, std::span<const uint8_t> bytes, uint8_t padding) {
  const size_t padded = (bytes.size() + 3) / 4 * 4;
  writer.u32(static_cast<uint32_t>(padded));
  writer.u32(type);
  writer.append(bytes);
  for (size_t i = bytes.size(); i < padded; ++i) writer.byte(padding);
}

}  // namespace

bool isGlb(std::span<const uint8_t> bytes) { return bytes.size() >= 4 && ByteReader(bytes).u32() == kMagic; }

Outcome<GlbChunks> splitGlb(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes);
  reader.u32();
  const uint32_t version = reader.u32(), length = reader.u32();
  if (reader.error() != Error::kNone) return invalid("", "the GLB header is cut off");
  if (version != 2) return unsupported("", "only GLB version 2 is supported");
  if (length > bytes.size() || length < kHeaderBytes) return invalid("", "the GLB is shorter than its header says");
  GlbChunks chunks;
  bool has_json = false;
  reader = ByteReader(bytes.first(length));
  reader.take(kHeaderBytes);
  for (int index = 0; reader.remaining() >= kChunkHeaderBytes; ++index) {
    const uint32_t size = reader.u32(), type = reader.u32();
    const auto data = reader.take(size);
    if (reader.error() != Error::kNone) return invalid("", "a GLB chunk is longer than the file");
    if (index == 0 && type == kJsonChunk) {
      chunks.json = {reinterpret_cast<const char*>(data.data()), data.size()};
      has_json = true;
    }
    if (index == 1 && type == kBinChunk) chunks.bin = data;
  }
  if (!has_json) return invalid("", "the first GLB chunk is not JSON");
  return chunks;
}

Outcome<Bytes> joinGlb(std::string_view json, std::span<const uint8_t> bin) {
  const uint64_t json_bytes = (uint64_t{json.size()} + 3) / 4 * 4, bin_bytes = (uint64_t{bin.size()} + 3) / 4 * 4;
  const uint64_t total =
      kHeaderBytes + kChunkHeaderBytes + json_bytes + (bin.empty() ? 0 : kChunkHeaderBytes + bin_bytes);
  if (total > 0xFFFFFFFFu) return unsupported("", "a GLB cannot be larger than 4 GiB: write .gltf");
  ByteWriter writer;
  writer.u32(kMagic);
  writer.u32(2);
  writer.u32(static_cast<uint32_t>(total));
  putChunk(writer, kJsonChunk, {reinterpret_cast<const uint8_t*>(json.data()), json.size()}, ' ');
  if (!bin.empty()) putChunk(writer, kBinChunk, bin, 0);
  return std::move(writer).take();
}

}  // namespace tutte
