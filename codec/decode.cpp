#include "codec/decode.h"

#include "codec/range_coder.h"
#include "codec/repairs.h"
#include "codec/script.h"
#include "codec/section.h"
#include "codec/walk.h"

namespace tutte {
namespace {

// Splits can make a face visit an umbrella twice, which no encoder writes.
bool repeatsUmbrella(const Connectivity& mesh) {
  std::vector<Index> last_face(mesh.umbrella_count, kNone);
  Index corner = 0;
  for (Index f = 0; f < mesh.face_degrees.size(); ++f) {
    for (const Index end = corner + mesh.face_degrees[f]; corner < end; ++corner) {
      Index& last = last_face[mesh.umbrellas[corner]];
      if (last == f) return true;
      last = f;
    }
  }
  return false;
}

}  // namespace

Result<Connectivity> decode(std::span<const uint8_t> bytes, const Limits& limits) noexcept {
  SectionHeader header;
  const Result<SectionStreams> streams = readSection(bytes, header);
  if (!streams) return streams.error();
  RangeReader valences(streams->valences), degrees(streams->degrees), repairs(streams->repairs);
  Blind oracle;
  Script script(header, valences, degrees, oracle);
  Walk walk(script, header.tie, limits);
  if (const Error error = walk.run(); error != Error::kNone) return error;
  Connectivity mesh = std::move(walk.connectivity());
  if (walk.splits() > 0 && repeatsUmbrella(mesh)) return Error::kMalformed;
  if (header.repairs) {
    const RepairNotes unknown;
    RepairCoder coder(repairs, unknown, walk.onBoundary(), limits, mesh);
    if (const Error error = coder.run(); error != Error::kNone) return error;
  }
  if (valences.overrun() || degrees.overrun()) return Error::kTruncated;
  if (valences.trailing() || degrees.trailing() || repairs.trailing()) return Error::kTrailingBytes;
  if (mesh.vertex_count > limits.max_vertices) return Error::kLimitExceeded;
  return mesh;
}

Polygons polygonsOf(const Connectivity& mesh, std::vector<Index>* corner_of) {
  Polygons polygons{mesh.face_degrees, std::vector<Index>(mesh.umbrellas.size()), mesh.vertex_count};
  if (corner_of) corner_of->resize(mesh.umbrellas.size());
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
