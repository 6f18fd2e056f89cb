#include "codec/decode.h"

#include <numeric>

#include "codec/decode_section.h"

namespace tutte {

Decoder::Decoder() : memory_(std::make_unique<CodecMemory>()) {}
Decoder::~Decoder() = default;
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;

Result<Connectivity> Decoder::decode(std::span<const uint8_t> bytes, const Limits& limits) noexcept {
  Unwatched nobody;
  return decodeSection(bytes, limits, nobody, *memory_);
}

Result<Connectivity> decode(std::span<const uint8_t> bytes, const Limits& limits) noexcept {
  return Decoder().decode(bytes, limits);
}

Polygons polygonsOf(const Connectivity& mesh, std::vector<Index>* corner_of) {
  if (corner_of) corner_of->resize(mesh.umbrellas.size());
  if (mesh.flipped.empty() && mesh.vertices.empty()) {  // most meshes: coded corners are the polygons' own
    if (corner_of) std::iota(corner_of->begin(), corner_of->end(), 0);
    return {mesh.face_degrees, mesh.umbrellas, mesh.vertex_count};
  }
  Polygons polygons{mesh.face_degrees, std::vector<Index>(mesh.umbrellas.size()), mesh.vertex_count};
  Index first = 0;
  for (Index f = 0; f < mesh.face_degrees.size(); ++f) {
    const Index degree = mesh.face_degrees[f];
    const bool flipped = !mesh.flipped.empty() && mesh.flipped[f];
    for (Index i = 0; i < degree; ++i) {
      const Index source = first + (flipped && i > 0 ? degree - i : i);
      polygons.corners[first + i] = mesh.vertexOf(source);
      if (corner_of) (*corner_of)[first + i] = source;
    }
    first += degree;
  }
  return polygons;
}

}  // namespace tutte
