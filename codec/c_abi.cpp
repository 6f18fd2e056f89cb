#include "codec/c_abi.h"

#include <limits>
#include <new>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "codec/c_abi_mesh.h"
#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/payload.h"
#include "codec/payload_mesh.h"

using namespace tutte;

struct tutte_decoder {
  Decoder decoder;
};

namespace {

static_assert(static_cast<int>(Error::kTruncated) == -TUTTE_TRUNCATED);
static_assert(static_cast<int>(Error::kAttributes) == -TUTTE_ATTRIBUTES);

Limits limitsFrom(const tutte_limits* limits) {
  return limits ? Limits{limits->max_vertices, limits->max_faces, limits->max_corners} : Limits{};
}

bool isValid(const tutte_encode_options* options) {
  return options == nullptr ||
         (options->profile >= -1 && options->profile <= 3 && options->effort >= 0 && options->effort <= 3);
}

EncodeOptions optionsFrom(const tutte_encode_options* options) {
  EncodeOptions result;
  if (options == nullptr) return result;
  if (options->profile >= 0) result.profile = static_cast<Profile>(options->profile);
  result.effort = options->effort;
  return result;
}

// Bytes per thing, a fifth more than the most that was measured of any kind of mesh.
struct MemoryNeeds {
  uint64_t fixed, vertex, face, corner, triangle;

  uint64_t of(const PayloadCounts& counts) const {
    return fixed + vertex * (uint64_t{counts.vertices} + counts.wedges) + face * counts.faces +
           (corner + counts.attributes) * counts.corners + triangle * counts.triangles;
  }
};

constexpr MemoryNeeds kEncoding = {10 << 20, 80, 40, 160, 0}, kDecoding = {10 << 20, 80, 40, 70, 20};

// No larger than what encode() takes: so its counts fit their types.
bool isSmall(const tutte_polygons& polygons) {
  constexpr size_t kMost = size_t{1} << 30;
  return polygons.face_count <= kMost && polygons.corner_count <= kMost && polygons.vertex_count <= kMost;
}

PayloadCounts countsOf(const tutte_polygons& polygons) {
  PayloadCounts counts;
  counts.vertices = counts.wedges = polygons.vertex_count;
  counts.faces = static_cast<Index>(polygons.face_count);
  counts.corners = static_cast<Index>(polygons.corner_count);
  return counts;
}

// Fills what follows from the connectivity alone, for meshes that came without a payload.
void completeFromConnectivity(PayloadMesh& mesh) {
  mesh.polygons = polygonsOf(mesh.connectivity, &mesh.coded_corners);
  mesh.counts.vertices = mesh.counts.wedges = mesh.polygons.vertex_count;
  mesh.counts.faces = static_cast<Index>(mesh.polygons.face_degrees.size());
  mesh.counts.corners = static_cast<Index>(mesh.polygons.corners.size());
}

// The handle on its way to the caller: its memory is asked for without an exception.
tutte_mesh* newMesh(tutte_mesh::Origin origin) {
  tutte_mesh* const mesh = new (std::nothrow) tutte_mesh;
  if (mesh) mesh->origin = origin;
  return mesh;
}

DerivedArray derive(const PayloadMesh& mesh, uint32_t array) {
  const ArraySource source = mesh.arraySource();
  switch (array) {
    case TUTTE_TRIANGLE_INDICES: return triangleIndices(source);
    case TUTTE_POLYGON_INDEX_OFFSETS: return polygonIndexOffsets(source);
    case TUTTE_POLYGON_LOOPS: return polygonLoops(source);
    case TUTTE_POLYGON_LOOP_OFFSETS: return polygonLoopOffsets(source);
    case TUTTE_RING_DEGREES: return ringDegrees(source);
    default: return weldedWedges(source);
  }
}

const DerivedArray& derivedOf(tutte_mesh& mesh, uint32_t array) {
  std::optional<DerivedArray>& derived = mesh.derived[array - TUTTE_TRIANGLE_INDICES];
  if (!derived) derived = derive(mesh.mesh, array);
  return *derived;
}

// Triangles that are their own triangulation are listed when they are first asked for.
const Triangulation& triangulationOf(PayloadMesh& mesh) {
  if (mesh.triangulation.counts.empty()) mesh.triangulation = fanTriangulation(mesh.polygons, {});
  return mesh.triangulation;
}

std::span<const Index> indicesOf(tutte_mesh& mesh, uint32_t array) {
  switch (array) {
    case TUTTE_FACE_DEGREES: return mesh.mesh.polygons.face_degrees;
    case TUTTE_CORNERS: return mesh.mesh.polygons.corners;
    case TUTTE_CODED_CORNERS: return mesh.mesh.coded_corners;
    case TUTTE_UMBRELLAS: return mesh.mesh.connectivity.umbrellas;
    case TUTTE_TWINS: return mesh.mesh.connectivity.twins;
    case TUTTE_VERTICES: return mesh.mesh.connectivity.vertices;
    case TUTTE_VERTEX_ORDER: return mesh.vertex_order;
    case TUTTE_FACE_ORDER: return mesh.face_order;
    case TUTTE_CORNER_ORDER: return mesh.corner_order;
    case TUTTE_WEDGES: return mesh.mesh.wedges;
    case TUTTE_GROUPS: return mesh.mesh.groups;
    case TUTTE_RING_OWNERS: return mesh.mesh.ring_owners;
    case TUTTE_TRIANGLE_COUNTS: return triangulationOf(mesh.mesh).counts;
    case TUTTE_TRIANGLE_CORNERS: return triangulationOf(mesh.mesh).corners;
    default: return derivedOf(mesh, array).values;
  }
}

bool isAvailable(const tutte_mesh& mesh, uint32_t array) {
  if (array < TUTTE_SECTION_BYTES) return true;
  const auto needed = array < TUTTE_WEDGES ? tutte_mesh::Origin::kEncoded : tutte_mesh::Origin::kPayload;
  return mesh.origin == needed;
}

template <class From, class To>
int64_t convert(std::span<const From> values, To* out) {
  constexpr To kLargest = std::numeric_limits<To>::max();
  if constexpr (sizeof(To) < sizeof(From)) {
    for (const From value : values) {
      if (value != kNone && value >= kLargest) return TUTTE_TOO_LARGE;
    }
  }
  for (const From value : values) *out++ = static_cast<To>(value);
  return static_cast<int64_t>(values.size());
}

template <class From>
int64_t readInto(std::span<const From> values, uint32_t stride, void* out, size_t capacity) {
  if (capacity == 0) return static_cast<int64_t>(values.size());
  if (values.size() > capacity) return TUTTE_BUFFER_TOO_SMALL;
  switch (stride) {
    case 1: return convert(values, static_cast<uint8_t*>(out));
    case 2: return convert(values, static_cast<uint16_t*>(out));
    default: return convert(values, static_cast<uint32_t*>(out));
  }
}

}  // namespace

int32_t tutte_abi_version(void) { return TUTTE_ABI_VERSION; }

const char* tutte_describe(int32_t status) {
  switch (status) {
    case TUTTE_INVALID_ARGUMENT: return "an argument is null or out of its range";
    case TUTTE_BUFFER_TOO_SMALL: return "the array is longer than the buffer";
    case TUTTE_NOT_AVAILABLE: return "this mesh or payload does not have that";
    case TUTTE_NOT_BUILT: return "this build of the library leaves out what the data needs";
    case TUTTE_UNSUPPORTED: return "the file uses something that is not handled";
    default: break;
  }
  const bool known = status <= 0 && status >= TUTTE_ATTRIBUTES;
  return known ? describe(static_cast<Error>(-status)).data() : "unknown status";
}

uint64_t tutte_memory_for(const tutte_counts* counts) {
  if (counts == nullptr) return 0;
  return kDecoding.of({counts->vertices, counts->wedges, counts->faces, counts->corners, counts->triangles,
                       counts->groups, counts->attributes});
}

int32_t tutte_encode_connectivity(const tutte_polygons* polygons, const tutte_encode_options* options,
                                  tutte_mesh** mesh) {
  if (mesh == nullptr) return TUTTE_INVALID_ARGUMENT;
  *mesh = nullptr;
  if (polygons == nullptr || !isValid(options) ||
      !isSpan(polygons->face_degrees, polygons->face_count, sizeof(Index)) ||
      !isSpan(polygons->corners, polygons->corner_count, sizeof(Index))) {
    return TUTTE_INVALID_ARGUMENT;
  }
  if (!isSmall(*polygons)) return TUTTE_TOO_LARGE;
  if (!canAllocate(kEncoding.of(countsOf(*polygons)))) return TUTTE_OUT_OF_MEMORY;
  const PolygonView view{{polygons->face_degrees, polygons->face_count},
                         {polygons->corners, polygons->corner_count},
                         polygons->vertex_count};
  Result<Encoded> encoded = encode(view, optionsFrom(options));
  if (!encoded) return statusOf(encoded.error());
  *mesh = newMesh(tutte_mesh::Origin::kEncoded);
  if (*mesh == nullptr) return TUTTE_OUT_OF_MEMORY;
  (*mesh)->mesh.connectivity = std::move(encoded->connectivity);
  completeFromConnectivity((*mesh)->mesh);
  (*mesh)->section_bytes = std::move(encoded->bytes);
  (*mesh)->vertex_order = std::move(encoded->vertex_order);
  (*mesh)->face_order = std::move(encoded->face_order);
  (*mesh)->corner_order = std::move(encoded->corner_order);
  return TUTTE_OK;
}

int32_t tutte_decode_connectivity(const uint8_t* bytes, size_t size, const tutte_limits* limits, tutte_mesh** mesh) {
  if (mesh == nullptr) return TUTTE_INVALID_ARGUMENT;
  *mesh = nullptr;
  if (!isSpan(bytes, size, 1)) return TUTTE_INVALID_ARGUMENT;
  Result<Connectivity> connectivity = decode({bytes, size}, limitsFrom(limits));
  if (!connectivity) return statusOf(connectivity.error());
  *mesh = newMesh(tutte_mesh::Origin::kSection);
  if (*mesh == nullptr) return TUTTE_OUT_OF_MEMORY;
  (*mesh)->mesh.connectivity = *std::move(connectivity);
  completeFromConnectivity((*mesh)->mesh);
  return TUTTE_OK;
}

int32_t tutte_decode_payload(const uint8_t* bytes, size_t size, const tutte_limits* limits, tutte_mesh** mesh) {
  tutte_decoder decoder;
  return tutte_decode_next_payload(&decoder, bytes, size, limits, mesh);
}

tutte_decoder* tutte_new_decoder(void) { return new (std::nothrow) tutte_decoder; }
void tutte_free_decoder(tutte_decoder* decoder) { delete decoder; }

int32_t tutte_decode_next_payload(tutte_decoder* decoder, const uint8_t* bytes, size_t size, const tutte_limits* limits,
                                  tutte_mesh** mesh) {
  if (mesh == nullptr) return TUTTE_INVALID_ARGUMENT;
  *mesh = nullptr;
  if (decoder == nullptr || !isSpan(bytes, size, 1)) return TUTTE_INVALID_ARGUMENT;
  const Result<PayloadView> payload = parsePayload({bytes, size});
  if (!payload) return statusOf(payload.error());
  if (!isWithin(payload->counts, limitsFrom(limits))) return TUTTE_LIMIT_EXCEEDED;
  if (!canAllocate(kDecoding.of(payload->counts))) return TUTTE_OUT_OF_MEMORY;
  Result<PayloadMesh, PayloadFailure> decoded = decodePayloadMesh(*payload, limitsFrom(limits), decoder->decoder);
  if (!decoded) return statusOf(decoded.error().error);
  *mesh = newMesh(tutte_mesh::Origin::kPayload);
  if (*mesh == nullptr) return TUTTE_OUT_OF_MEMORY;
  (*mesh)->mesh = *std::move(decoded);
  return TUTTE_OK;
}

int32_t tutte_find_section(const uint8_t* bytes, size_t size, uint32_t section, size_t* offset, size_t* length) {
  if (!isSpan(bytes, size, 1) || section >= kSectionCount || offset == nullptr || length == nullptr) {
    return TUTTE_INVALID_ARGUMENT;
  }
  const Result<PayloadView> payload = parsePayload({bytes, size});
  if (!payload) return statusOf(payload.error());
  if (!payload->present[section]) return TUTTE_NOT_AVAILABLE;
  *offset = static_cast<size_t>(payload->sections[section].data() - bytes);
  *length = payload->sections[section].size();
  return TUTTE_OK;
}

void tutte_free(tutte_mesh* mesh) { delete mesh; }

int32_t tutte_get_counts(const tutte_mesh* mesh, tutte_counts* counts) {
  if (mesh == nullptr || counts == nullptr) return TUTTE_INVALID_ARGUMENT;
  const PayloadCounts& own = mesh->mesh.counts;
  *counts = {own.vertices,  own.wedges, own.faces,      own.corners,
             own.triangles, own.groups, own.attributes, mesh->mesh.connectivity.umbrella_count};
  return TUTTE_OK;
}

int32_t tutte_peek_counts(const uint8_t* bytes, size_t size, tutte_counts* counts) {
  if (!isSpan(bytes, size, 1) || counts == nullptr) return TUTTE_INVALID_ARGUMENT;
  const Result<PayloadCounts> own = peekCounts({bytes, size});
  if (!own) return statusOf(own.error());
  *counts = {own->vertices, own->wedges, own->faces, own->corners, own->triangles, own->groups, own->attributes, 0};
  return TUTTE_OK;
}

int64_t tutte_read(tutte_mesh* mesh, uint32_t array, uint32_t stride, void* out, size_t capacity) {
  const uint32_t base = array & ~TUTTE_GROUP_STARTS;
  const bool starts = array != base;
  const bool right_stride = stride == 1 || stride == 2 || stride == 4;
  if (mesh == nullptr || base >= TUTTE_ARRAY_COUNT || !right_stride || !isSpan(out, capacity, stride) ||
      (starts && base < TUTTE_TRIANGLE_INDICES)) {
    return TUTTE_INVALID_ARGUMENT;
  }
  if (!isAvailable(*mesh, base)) return TUTTE_NOT_AVAILABLE;
  if (base == TUTTE_FLIPPED) return readInto<uint8_t>(mesh->mesh.connectivity.flipped, stride, out, capacity);
  if (base == TUTTE_SECTION_BYTES) return readInto<uint8_t>(mesh->section_bytes, stride, out, capacity);
  const std::span<const Index> indices =
      starts ? std::span<const Index>(derivedOf(*mesh, base).group_starts) : indicesOf(*mesh, base);
  return readInto<Index>(indices, stride, out, capacity);
}
