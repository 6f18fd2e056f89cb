#pragma once
// Flags at the ends of edges, coded with what is known around both vertices of the edge.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "codec/edge_ends.h"
#include "codec/gated_flag.h"
#include "codec/mesh.h"

namespace tutte {

/// Codes which ends of touched umbrellas are parted: umbrella by umbrella its own ends, then the other ends of its
/// edges. Around a closed umbrella there cannot be exactly one.
template <class Port>
class EndFlags {
 public:
  /// `truth`: per corner, 1 for parted ends; a decoder passes nothing. All arguments must outlive this object.
  EndFlags(Port& port, EdgeEnds& ends, EndRings& rings, std::span<const uint8_t> truth)
      : port_(port), ends_(ends), ways_(ends.ways()), rings_(rings), truth_(truth) {}

  void code() {
    for (EndRing& ring : rings_.rings()) {
      for (Index place = ring.first; ring.left != 0 && place < ring.end(); ++place) {
        const Index end = rings_.corner(place);
        if (ends_.isAsked(end)) code(ring, end, ways_.twin(end));
      }
      for (Index place = ring.first; place < ring.end(); ++place) {
        const Index near = rings_.corner(place), end = ways_.twin(near);
        if (end == kNone || !ends_.isAsked(end)) continue;
        EndRing* const other = rings_.find(ways_.umbrella(end));
        if (other) code(*other, end, near);
      }
    }
  }

 private:
  /// `far`: the other end of the edge.
  void code(EndRing& ring, Index end, Index far) {
    rings_.set(ring, end, ring.left == ring.required || decide(ring, end, far));
  }

  bool decide(const EndRing& ring, Index end, Index far) {
    const EndRing* const far_ring = rings_.find(ways_.umbrella(far));
    const uint32_t there = far_ring ? ends_.shown(far) : 0;
    const uint32_t seen = (there * 3 + ring.parted) * 4 + (far_ring ? far_ring->parted : 3);
    const auto contexts = [&]() -> std::array<uint32_t, 5> {
      const Index place = rings_.place(ring, end);
      const auto shown = [&](int steps) { return rings_.shown(ring, place, steps); };
      const uint32_t room = (std::min(ring.left, 4u) - 1) * 8 + (far_ring ? std::min(far_ring->left, 7u) : 0);
      const uint32_t opposite = ring.closed && ring.count >= 4 ? shown(ring.count < 6 ? 2 : 3) : 0;
      return {(((shown(-1) * 3 + shown(1)) * 3 + shown(-2)) * 3 + shown(2)) * kSeen + seen, room * kSeen + seen,
              (facing(end) * 3 + facing(far)) * kSeen + seen, (beside(end) * 9 + beside(far)) * kSeen + seen,
              ((std::min(ring.count, 9u) * 3 + opposite) * 3 + ring.required) * kSeen + seen};
    };
    return flags_.code(port_, seen, contexts, there, Port::kWriting && truth_[end]);
  }

  /// The edges after and before this one in its face.
  uint32_t beside(Index end) const { return ends_.edge(ways_.next(end)) * 3u + ends_.edge(ways_.prev(end)); }

  /// The edge at the other side of a quad.
  uint32_t facing(Index end) const { return ways_.degree(end) == 4 ? ends_.edge(ways_.next(ways_.next(end))) : 0; }

  static constexpr uint32_t kSeen = 36;

  Port& port_;
  EdgeEnds& ends_;
  const UmbrellaWays& ways_;
  EndRings& rings_;
  const std::span<const uint8_t> truth_;
  GatedFlag<5> flags_{kSeen, {81 * kSeen, 32 * kSeen, 9 * kSeen, 81 * kSeen, 90 * kSeen}, 3};
};

}  // namespace tutte
