#include "gltf_ext/c_abi.h"

#include <algorithm>
#include <new>
#include <utility>

#include "codec/c_abi_mesh.h"
#include "gltf_ext/attribute_topology.h"
#include "gltf_ext/attributes.h"
#include "gltf_ext/draco_planes.h"
#include "gltf_ext/guard.h"

using namespace tutte;

struct tutte_attributes {
  std::vector<Attribute> list;
  Index wedge_count = 0;
};

namespace {

// The first byte of the section names the coder.
constexpr uint8_t kDracoCoder = 0;

// Bytes per corner of one layout (the order and neighbourhood of values with equal seams), per wedge and attribute, and
// per corner of what all share: estimates from the arrays that are made, on the generous side.
constexpr uint64_t kLayout = 150, kValue = 48, kShared = 150;

/// Attributes with equal seams share a layout, so at most these are made.
uint64_t layoutsOf(const PayloadMesh& mesh) {
  const auto& seams = mesh.seams.attribute_seams;
  return 2 + static_cast<uint64_t>(std::ranges::count_if(seams, [](const auto& flags) { return !flags.empty(); }));
}

int32_t decode(const PayloadMesh& mesh, std::span<const uint8_t> section, std::vector<Attribute>& out) {
  auto decoded = decodeAttributes(attributeTopology(mesh.connectivity, mesh.seams), section);
  if (!decoded) return decoded.error().kind == FailureKind::kUnsupported ? TUTTE_OUT_OF_MEMORY : TUTTE_ATTRIBUTES;
  if (decoded->size() != mesh.counts.attributes) return TUTTE_COUNT_MISMATCH;
  for (const Attribute& attribute : *decoded) {
    if (attribute.data.size() != size_t{mesh.counts.wedges} * attribute.stride()) return TUTTE_ATTRIBUTES;
  }
  out = *std::move(decoded);
  return TUTTE_OK;
}

void copyStrided(const Attribute& attribute, uint32_t stride, uint8_t* out) {
  const uint32_t size = attribute.stride();
  if (stride == size) return void(std::ranges::copy(attribute.data, out));
  for (size_t at = 0; at < attribute.data.size(); at += size) {
    out = std::copy_n(&attribute.data[at], size, out);
    out = std::fill_n(out, stride - size, uint8_t{0});
  }
}

}  // namespace

uint64_t tutte_memory_for_attributes(const tutte_mesh* mesh) {
  if (mesh == nullptr || mesh->origin != tutte_mesh::Origin::kPayload) return 0;
  const PayloadCounts& counts = mesh->mesh.counts;
  return (1 << 20) + counts.corners * (kShared + kLayout * layoutsOf(mesh->mesh)) +
         uint64_t{counts.wedges} * counts.attributes * kValue;
}

int32_t tutte_decode_attributes(const tutte_mesh* mesh, const uint8_t* bytes, size_t size,
                                tutte_attributes** attributes) {
  if (attributes == nullptr) return TUTTE_INVALID_ARGUMENT;
  *attributes = nullptr;
  if (mesh == nullptr || !isSpan(bytes, size, 1)) return TUTTE_INVALID_ARGUMENT;
  if (mesh->origin != tutte_mesh::Origin::kPayload) return TUTTE_NOT_AVAILABLE;
  const Result<PayloadView> payload = parsePayload({bytes, size});
  if (!payload) return statusOf(payload.error());
  if (payload->counts != mesh->mesh.counts) return TUTTE_COUNT_MISMATCH;
  if (!canAllocate(tutte_memory_for_attributes(mesh))) return TUTTE_OUT_OF_MEMORY;
  std::vector<Attribute> list;
  if (payload->has(Section::kAttributes)) {
    const std::span<const uint8_t> section = (*payload)[Section::kAttributes];
    if (!hasDraco() && !section.empty() && section[0] == kDracoCoder) return TUTTE_NOT_BUILT;
    const int32_t status = caught([&] { return decode(mesh->mesh, section, list); },
                                  [](const Thrown&) -> int32_t { return TUTTE_OUT_OF_MEMORY; });
    if (status != TUTTE_OK) return status;
  }
  *attributes = new (std::nothrow) tutte_attributes{std::move(list), mesh->mesh.counts.wedges};
  return *attributes ? TUTTE_OK : TUTTE_OUT_OF_MEMORY;
}

void tutte_free_attributes(tutte_attributes* attributes) { delete attributes; }

int64_t tutte_attribute_count(const tutte_attributes* attributes) {
  return attributes ? static_cast<int64_t>(attributes->list.size()) : int64_t{TUTTE_INVALID_ARGUMENT};
}

int32_t tutte_get_attribute(const tutte_attributes* attributes, uint32_t index, tutte_attribute* attribute) {
  if (attributes == nullptr || attribute == nullptr) return TUTTE_INVALID_ARGUMENT;
  if (index >= attributes->list.size()) return TUTTE_NOT_AVAILABLE;
  const Attribute& own = attributes->list[index];
  *attribute = {own.name.c_str(), own.components, static_cast<uint32_t>(own.type), own.normalized ? 1u : 0u};
  return TUTTE_OK;
}

int64_t tutte_read_attribute(const tutte_attributes* attributes, uint32_t index, uint32_t stride, void* out,
                             size_t capacity) {
  if (attributes == nullptr || !isSpan(out, capacity, 1)) return TUTTE_INVALID_ARGUMENT;
  if (index >= attributes->list.size()) return TUTTE_NOT_AVAILABLE;
  const Attribute& attribute = attributes->list[index];
  if (stride == 0) stride = attribute.stride();
  if (stride < attribute.stride()) return TUTTE_INVALID_ARGUMENT;
  const uint64_t size = uint64_t{attributes->wedge_count} * stride;
  if (size > static_cast<uint64_t>(std::numeric_limits<ptrdiff_t>::max())) return TUTTE_TOO_LARGE;
  if (capacity == 0) return static_cast<int64_t>(size);
  if (size > capacity) return TUTTE_BUFFER_TOO_SMALL;
  copyStrided(attribute, stride, static_cast<uint8_t*>(out));
  return static_cast<int64_t>(size);
}
