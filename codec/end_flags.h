#pragma once
// Flags at the ends of edges, coded with what is known around both vertices of the edge.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/edge_ends.h"
#include "codec/mesh.h"
#include "codec/mixed_flag.h"
#include "codec/sure_run.h"

namespace tutte {

/// Codes which ends of touched umbrellas are parted: umbrella by umbrella its own ends, then the other ends of its
/// edges. Around a closed umbrella there cannot be exactly one. Where the ends beside it have long told what an end is,
/// nothing else is looked at.
template <class Port>
class EndFlags {
 public:
  /// `truth`: per corner, 1 for parted ends; a decoder passes nothing. All arguments must outlive this object.
  EndFlags(Port& port, EdgeEnds& ends, EndRings& rings, std::span<const uint8_t> truth)
      : port_(port), ends_(ends), ways_(ends.ways()), rings_(rings), truth_(truth) {}

  void code() {
    for (EndRing& ring : rings_.rings()) {
      for (Index place = ring.first; place < ring.end(); ++place) {
        const Index end = rings_.corner(place);
        if (ends_.isAsked(end)) code(ring, place, end);
      }
      for (Index place = ring.first; place < ring.end(); ++place) {
        const Index end = ways_.twin(rings_.corner(place));
        EndRing* const other = end == kNone ? nullptr : rings_.find(ways_.umbrella(end));
        if (other && ends_.isAsked(end)) code(*other, rings_.place(end), end);
      }
    }
  }

 private:
  void code(EndRing& ring, Index place, Index end) {
    const bool parted = ring.left == ring.required || decide(ring, place, end);
    rings_.set(ring, place, parted);
    history_ = (history_ * 2 + parted) % kHistories;
  }

  bool decide(const EndRing& ring, Index place, Index end) {
    static constexpr std::array<uint8_t, 2 * EndRings::kReach + 1> kNothing{};
    const Index far = ways_.twin(end);
    const EndRing* const far_ring = rings_.find(ways_.umbrella(far));
    const uint8_t* const here = rings_.states(place);
    const uint8_t* const there = far_ring ? rings_.states(rings_.place(far)) : &kNothing[EndRings::kReach];
    const uint32_t seen = (there[0] * 3u + ring.parted) * 4 + (far_ring ? far_ring->parted : 3);
    const uint32_t nearest = around(here) * kSeen + seen;
    const bool truth = Port::kWriting && truth_[end];
    Run& run = runs_[nearest];
    if (run.isSure()) return run.code(port_, truth);
    const uint32_t straight = ring.closed && ring.count == 4 ? here[2] : 0;
    const uint32_t far_left = far_ring ? std::min(far_ring->left, 7u) : 0;
    const bool parted =
        flags_.code(port_,
                    {nearest, ((straight * 3 + here[-3]) * 3 + here[3]) * kSeen + seen,
                     ((std::min(ring.left, 8u) - 1) * 8 + far_left) * kSeen + seen, around(there) * kSeen + seen,
                     ((facing(end) * 3 + facing(far)) * kHistories + history_) * kSeen + seen,
                     (beside(end) * 9 + beside(far)) * kSeen + seen},
                    there[0], truth);
    run.note(parted);
    return parted;
  }

  /// The two ends on either side of one.
  static uint32_t around(const uint8_t* states) {
    return ((states[-1] * 3u + states[1]) * 3 + states[-2]) * 3 + states[2];
  }

  /// The edges after and before this one in its face.
  uint32_t beside(Index end) const { return ends_.edge(ways_.next(end)) * 3u + ends_.edge(ways_.prev(end)); }

  /// The edge at the other side of a quad.
  uint32_t facing(Index end) const { return ways_.degree(end) == 4 ? ends_.edge(ways_.next(ways_.next(end))) : 0; }

  using Run = SteadyRun<48, 4>;
  static constexpr uint32_t kHistories = 16, kSeen = 36;

  Port& port_;
  EdgeEnds& ends_;
  const UmbrellaWays& ways_;
  EndRings& rings_;
  const std::span<const uint8_t> truth_;
  uint32_t history_ = 0;  ///< the last flags
  std::vector<Run> runs_ = std::vector<Run>(81 * kSeen);
  MixedFlag<6> flags_{{81 * kSeen, 27 * kSeen, 64 * kSeen, 81 * kSeen, 9 * kHistories* kSeen, 81 * kSeen}, 3};
};

}  // namespace tutte
