#include "tools/meshopt_baseline.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstring>
#include <vector>

#ifdef TUTTE_ZSTD
#include <zstd.h>
#endif

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;

uint64_t zstdSize([[maybe_unused]] const Bytes& bytes) {
#ifdef TUTTE_ZSTD
  Bytes out(ZSTD_compressBound(bytes.size()));
  const size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 19);
  return ZSTD_isError(size) ? 0 : size;
#else
  return 0;
#endif
}

/// The mesh's triangles as glTF has them, in the order for meshoptimizer's codecs: triangles for its cache, vertices by
/// their first use.
struct OrderedMesh {
  std::vector<uint32_t> indices;
  std::vector<uint32_t> wedges;  ///< per new vertex
};

OrderedMesh ordered(const PolygonMesh& mesh) {
  OrderedMesh result;
  for (const Index corner : mesh.triangulation.corners) result.indices.push_back(mesh.wedgeOf(corner));
  meshopt_optimizeVertexCache(result.indices.data(), result.indices.data(), result.indices.size(), mesh.wedge_count);
  std::vector<uint32_t> remap(mesh.wedge_count);
  meshopt_optimizeVertexFetchRemap(remap.data(), result.indices.data(), result.indices.size(), mesh.wedge_count);
  result.wedges.resize(mesh.wedge_count);
  auto unused = static_cast<uint32_t>(mesh.wedge_count - std::count(remap.begin(), remap.end(), ~0u));
  for (uint32_t wedge = 0; wedge < mesh.wedge_count; ++wedge) {
    if (remap[wedge] == ~0u) remap[wedge] = unused++;
    result.wedges[remap[wedge]] = wedge;
  }
  for (uint32_t& index : result.indices) index = remap[index];
  return result;
}

uint32_t padded(uint32_t stride) { return (stride + 3) / 4 * 4; }

void appendVertices(const OrderedMesh& mesh, std::span<const Attribute* const> attributes, Bytes& out) {
  size_t stride = 0;
  for (const Attribute* attribute : attributes) stride += padded(attribute->stride());
  Bytes vertices(mesh.wedges.size() * stride);
  for (size_t v = 0; v < mesh.wedges.size(); ++v) {
    uint8_t* target = &vertices[v * stride];
    for (const Attribute* attribute : attributes) {
      std::memcpy(target, &attribute->data[size_t{mesh.wedges[v]} * attribute->stride()], attribute->stride());
      target += padded(attribute->stride());
    }
  }
  Bytes coded(meshopt_encodeVertexBufferBound(mesh.wedges.size(), stride));
  coded.resize(meshopt_encodeVertexBuffer(coded.data(), coded.size(), vertices.data(), mesh.wedges.size(), stride));
  out.insert(out.end(), coded.begin(), coded.end());
}

/// The triangles' codec, followed by the vertices' one over attributes apart or together.
Bytes encoded(const OrderedMesh& ordered, const PolygonMesh& mesh, bool interleaved) {
  Bytes out(meshopt_encodeIndexBufferBound(ordered.indices.size(), ordered.wedges.size()));
  out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), ordered.indices.data(), ordered.indices.size()));
  std::vector<const Attribute*> attributes;
  for (const Attribute& attribute : mesh.attributes) attributes.push_back(&attribute);
  constexpr size_t kMostTogether = 16;  // of 16 bytes: the codec's limit is 256
  const size_t step = interleaved ? kMostTogether : 1;
  for (size_t i = 0; i < attributes.size(); i += step) {
    appendVertices(ordered, std::span(attributes).subspan(i, std::min(step, attributes.size() - i)), out);
  }
  return out;
}

}  // namespace

MeshoptFigures meshoptLossless(const PolygonMesh& mesh) {
  MeshoptFigures figures;
  figures.raw_bytes = mesh.triangulation.corners.size() * (mesh.wedge_count < 65536 ? 2 : 4);
  for (const Attribute& attribute : mesh.attributes) figures.raw_bytes += attribute.data.size();
  if (mesh.triangulation.corners.empty()) return figures;
  meshopt_encodeIndexVersion(1);
  const OrderedMesh order = ordered(mesh);
  const uint64_t apart = zstdSize(encoded(order, mesh, false));
  figures.compressed_bytes = std::min(apart, zstdSize(encoded(order, mesh, true)));
  return figures;
}

}  // namespace tutte
