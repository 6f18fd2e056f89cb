#pragma once
// The decoder's run through a section, for decode() and for whoever wants to watch it.

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "codec/codec_memory.h"
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

// A dual's faces are umbrellas, and its corners include those of dummy faces, which are no more than the others.
inline Limits walkLimits(const SectionHeader& header, const Limits& limits) {
  if (!header.dual) return limits;
  const Index corners = limits.max_corners > kNone / 2 ? kNone : 2 * limits.max_corners;
  return {kNone, limits.max_corners, corners};
}

// Room for the corners: as many as the limits allow, where that is no great loss; payloads state their counts.
// Otherwise those of an irregular mesh: a regular mesh has more, but what a few bytes claim must not cost much.
inline size_t expectedCorners(std::span<const uint8_t> symbols, const Limits& limits) {
  constexpr size_t kModest = size_t{1} << 21;
  if (limits.max_corners <= kModest) return limits.max_corners;
  return std::min<size_t>(limits.max_corners, 4096 + 64 * symbols.size());
}

/// The symbols of a section, with the statistics that its header names. `Port`: RangeReader, or one that does more.
template <class Port, class Statistics, class Observer>
Result<Connectivity> decodeSymbols(const SectionHeader& header, std::span<const uint8_t> symbols, const Limits& limits,
                                   Observer& observer, CodecMemory& memory) {
  Port port(symbols);
  observer.open(port);
  Blind oracle;
  Watched<Script<Statistics, Port, Blind>, Observer> script(observer, header, port, oracle, memory.statistics);
  const Limits walk_limits = walkLimits(header, limits);
  const size_t expected = expectedCorners(symbols, walk_limits);
  Walk walk(script, header.tie, header.leastDegree(), walk_limits, expected, memory.gaps);
  if (const Error error = walk.run(); error != Error::kNone) return error;
  PrimalMesh primal{std::move(walk.connectivity()), {}, {}};
  if (header.repairs && !header.dual) primal.on_boundary = std::move(walk).onBoundary();
  if (header.dual) {
    Result<PrimalMesh> turned = primalOf(primal.connectivity, std::move(walk).dummyUmbrellas(), limits);
    if (!turned) return turned.error();
    primal = std::move(*turned);
  }
  Connectivity& mesh = primal.connectivity;
  if (header.repairs) {
    const RepairNotes unknown;
    RepairCoder coder(port, unknown, primal.on_boundary, limits, mesh);
    if (const Error error = coder.run(); error != Error::kNone) return error;
  }
  if (port.overrun()) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  if (mesh.vertex_count > limits.max_vertices) return Error::kLimitExceeded;
  return std::move(mesh);
}

/// decode(), telling `observer` (see Unwatched) what the traversal's symbols say.
template <class Port = RangeReader, class Observer>
Result<Connectivity> decodeSection(std::span<const uint8_t> bytes, const Limits& limits, Observer& observer,
                                   CodecMemory& memory) {
  SectionHeader header;
  const Result<std::span<const uint8_t>> symbols = readSection(bytes, header);
  if (!symbols) return symbols.error();
  const auto decode = [&]<class Statistics>(std::type_identity<Statistics>) {
    return decodeSymbols<Port, Statistics>(header, *symbols, limits, observer, memory);
  };
  if constexpr (std::is_same_v<Observer, Unwatched>) return withQuickStatistics(header, decode);
  return withStatistics(header, decode);
}

}  // namespace tutte
