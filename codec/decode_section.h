#pragma once
// The decoder's run through a section, for decode() and for whoever wants to watch it.

#include <span>
#include <utility>
#include <vector>

#include "codec/mesh.h"
#include "codec/range_coder.h"
#include "codec/repairs.h"
#include "codec/result.h"
#include "codec/script.h"
#include "codec/section.h"
#include "codec/walk.h"
#include "codec/watched.h"

namespace tutte {

// Splits can make a face visit an umbrella twice, which no encoder writes.
inline bool repeatsUmbrella(const Connectivity& mesh) {
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

/// decode(), telling `observer` (see Unwatched) what the traversal's symbols say.
template <class Observer>
Result<Connectivity> decodeSection(std::span<const uint8_t> bytes, const Limits& limits, Observer& observer) {
  SectionHeader header;
  const Result<SectionStreams> streams = readSection(bytes, header);
  if (!streams) return streams.error();
  RangeReader valences(streams->valences), degrees(streams->degrees), repairs(streams->repairs);
  Blind oracle;
  Watched<Script<RangeReader, Blind>, Observer> script(observer, header, valences, degrees, oracle);
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

}  // namespace tutte
