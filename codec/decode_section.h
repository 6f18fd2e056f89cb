#pragma once
// The decoder's run through a section, for decode() and for whoever wants to watch it.

#include <span>
#include <utility>
#include <vector>

#include "codec/mesh.h"
#include "codec/primal.h"
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

// A dual's faces are umbrellas, and its corners include those of dummy faces, which are no more than the others.
inline Limits walkLimits(const SectionHeader& header, const Limits& limits) {
  if (!header.dual) return limits;
  const Index corners = limits.max_corners > kNone / 2 ? kNone : 2 * limits.max_corners;
  return {kNone, limits.max_corners, corners};
}

/// The streams of a section, with the statistics that its header names. `Port`: RangeReader, or one that does more.
template <class Port, class Statistics, class Observer>
Result<Connectivity> decodeStreams(const SectionHeader& header, const SectionStreams& streams, const Limits& limits,
                                   Observer& observer) {
  Port valences(streams.valences), degrees(streams.degrees);
  observer.open(valences, degrees);
  Blind oracle;
  Watched<Script<Statistics, Port, Blind>, Observer> script(observer, header, valences, degrees, oracle);
  Walk walk(script, header.tie, header.leastDegree(), walkLimits(header, limits));
  if (const Error error = walk.run(); error != Error::kNone) return error;
  PrimalMesh primal{std::move(walk.connectivity()), {}, walk.onBoundary()};
  if (header.dual) {
    Result<PrimalMesh> turned = primalOf(primal.connectivity, walk.dummyUmbrellas(), limits);
    if (!turned) return turned.error();
    primal = std::move(*turned);
  }
  Connectivity& mesh = primal.connectivity;
  if (walk.splits() > 0 && repeatsUmbrella(mesh)) return Error::kMalformed;
  if (header.repairs) {
    const RepairNotes unknown;
    RepairCoder coder(valences, unknown, primal.on_boundary, limits, mesh);
    if (const Error error = coder.run(); error != Error::kNone) return error;
  }
  if (valences.overrun() || degrees.overrun()) return Error::kTruncated;
  if (valences.trailing() || degrees.trailing()) return Error::kTrailingBytes;
  if (mesh.vertex_count > limits.max_vertices) return Error::kLimitExceeded;
  return std::move(mesh);
}

/// decode(), telling `observer` (see Unwatched) what the traversal's symbols say.
template <class Port = RangeReader, class Observer>
Result<Connectivity> decodeSection(std::span<const uint8_t> bytes, const Limits& limits, Observer& observer) {
  SectionHeader header;
  const Result<SectionStreams> streams = readSection(bytes, header);
  if (!streams) return streams.error();
  return withStatistics(header, [&]<class Statistics>(std::type_identity<Statistics>) {
    return decodeStreams<Port, Statistics>(header, *streams, limits, observer);
  });
}

}  // namespace tutte
