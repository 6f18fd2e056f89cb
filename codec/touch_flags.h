#pragma once
// Which umbrellas are touched, that is, have parted ends.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/edge_ends.h"
#include "codec/gated_flag.h"
#include "codec/mesh.h"
#include "codec/model.h"

namespace tutte {

/// Codes it umbrella by umbrella, in the order of their numbers. Where a neighbour, or the far corner of a quad, is
/// touched, an umbrella is *suggested*, and has a flag; of others it is told how many follow that are not touched. So
/// nothing is done for most umbrellas far from seams but to count them.
template <class Port>
class TouchFlags {
 public:
  /// `truth`: per corner, 1 for parted ends; a decoder passes nothing. All arguments must outlive this object.
  TouchFlags(Port& port, const EdgeEnds& ends, EndRings& rings, std::span<const uint8_t> truth)
      : port_(port), ends_(ends), ways_(ends.ways()), rings_(rings), suggested_(ways_.mesh().umbrella_count) {
    if constexpr (Port::kWriting) findTouched(truth);
  }

  /// Of the umbrellas, which ascend; no others are touched.
  void code(std::span<const Index> umbrellas) {
    if constexpr (Port::kWriting) findGaps(umbrellas);
    for (const Index umbrella : umbrellas) code(umbrella);
  }
  /// Of all.
  void code() {
    if constexpr (Port::kWriting) {
      std::vector<Index> umbrellas(suggested_.size());
      for (Index u = 0; u < umbrellas.size(); ++u) umbrellas[u] = u;
      findGaps(umbrellas);
    }
    for (Index umbrella = 0, count = static_cast<Index>(suggested_.size()); umbrella < count; ++umbrella)
      code(umbrella);
  }

 private:
  void findTouched(std::span<const uint8_t> truth) {
    touched_.resize(suggested_.size());
    for (Index end = 0; end < truth.size(); ++end) {
      if (ends_.isAsked(end)) touched_[ways_.umbrella(end)] |= truth[end];
    }
  }

  /// How many umbrellas that are neither suggested nor touched come before each one that is touched, and at last.
  void findGaps(std::span<const Index> umbrellas) {
    gaps_.assign(1, 0);
    for (const Index umbrella : umbrellas) {
      if (!suggested_[umbrella] && ends_.isAnyAsked(umbrella)) {
        touched_[umbrella] ? gaps_.push_back(0) : void(++gaps_.back());
      }
      if (touched_[umbrella]) suggestAround(umbrella);
    }
    std::ranges::reverse(gaps_);
    std::ranges::fill(suggested_, uint8_t{0});
  }

  [[gnu::always_inline]] void code(Index umbrella) {
    if (!ends_.isAnyAsked(umbrella)) return;
    const bool touched = suggested_[umbrella] ? codeSuggested(umbrella) : endsGap();
    row_ = (row_ * 2 + touched) % kRows;
    if (touched) touch(umbrella);
  }

  // The next umbrella is touched that is not suggested.
  [[gnu::always_inline]] bool endsGap() {
    if (gap_ == kNone) {
      if constexpr (Port::kWriting) {
        gap_ = gaps_.back();
        gaps_.pop_back();
      }
      gap_ = gap_model_.code(port_, gap_);
    }
    return gap_-- == 0;
  }

  bool codeSuggested(Index umbrella) {
    near_.clear();
    const bool truth = Port::kWriting && touched_[umbrella];
    const bool touched = decide(umbrella, truth);
    for (const Near& near : near_) {
      --near.ring->unknown_neighbours;
      near.ring->touched_neighbours += touched;
    }
    return touched;
  }

  void touch(Index umbrella) {
    Index touched = 0, unknown = 0;
    goAround(umbrella, [&](Index neighbour, Index far, bool) {
      const Index other = ways_.umbrella(neighbour);
      const bool later = other > umbrella;
      unknown += later;
      if (later) {
        suggested_[other] = 1;
      } else {
        touched += other < umbrella && rings_.isTouched(other);
      }
      if (far != kNone) suggest(far, umbrella);
    });
    EndRing& ring = rings_.add(umbrella);
    ring.touched_neighbours = touched;
    ring.unknown_neighbours = unknown;
  }

  void suggest(Index corner, Index umbrella) {
    if (ways_.umbrella(corner) > umbrella) suggested_[ways_.umbrella(corner)] = 1;
  }

  // Those that come later.
  void suggestAround(Index umbrella) {
    goAround(umbrella, [&](Index neighbour, Index far, bool) {
      suggest(neighbour, umbrella);
      if (far != kNone) suggest(far, umbrella);
    });
  }

  /// Calls visit(neighbour, far, last) for all edges of an umbrella: a corner at the other end, and the one across the
  /// face that follows, if that is a quad. Of an open umbrella, no face follows the last edge.
  template <class Visit>
  void goAround(Index umbrella, Visit visit) const {
    const Index first = ways_.first(umbrella);
    Index corner = first;
    do {
      const Index next = ways_.next(corner);
      visit(next, ways_.degree(corner) == 4 ? ways_.next(next) : kNone, false);
      const Index prev = ways_.prev(corner);
      corner = ways_.twin(prev);
      if (corner == kNone) visit(prev, kNone, true);
    } while (corner != kNone && corner != first);
  }

  /// What is seen of an umbrella.
  enum State : uint32_t { kUnknown, kQuiet, kTouched, kNowhere };

  State stateOf(Index corner, Index umbrella) const {
    const Index other = ways_.umbrella(corner);
    return other > umbrella ? kUnknown : rings_.isTouched(other) ? kTouched : kQuiet;
  }

  /// Of the umbrella to which an edge goes on through a neighbour, straight if that has four edges.
  State beyond(Index neighbour, bool last, Index umbrella) const {
    const Index side = last ? ways_.back(neighbour) : ways_.across(neighbour);
    if (side == kNone) return kNowhere;
    return stateOf(last ? ways_.prev(side) : ways_.next(side), umbrella);
  }

  bool decide(Index umbrella, bool truth) {
    std::array<uint32_t, 4> seen{}, far_seen{};  // how many of each State
    uint32_t need = kNoNeed;  // of the touched neighbour that has the fewest touched ones, then the fewest unknown ones
    goAround(umbrella, [&](Index neighbour, Index far, bool last) {
      if (far != kNone) ++far_seen[stateOf(far, umbrella)];
      const State state = stateOf(neighbour, umbrella);
      ++seen[state];
      if (state != kTouched) return;
      EndRing* const ring = rings_.find(ways_.umbrella(neighbour));
      const uint32_t its = std::min(ring->touched_neighbours, 2u) * 5 + std::min(ring->unknown_neighbours, 4u);
      near_.push_back({ring, neighbour, its, last});
      need = std::min(need, its);
    });
    const uint32_t touched = std::min(seen[kTouched], 3u), quiet = std::min(seen[kQuiet], 3u);
    const uint32_t unknown = std::min(seen[kUnknown], 3u), far_touched = std::min(far_seen[kTouched], 2u);
    const uint32_t gate = (touched * 4 + quiet) * 4 + unknown;
    const auto contexts = [&]() -> std::array<uint32_t, 4> {
      uint32_t lines = 0, line = 0;  // of the neighbours' neighbours straight on: touched ones; that of the neediest
      for (const Near& near : near_) {
        const State straight = beyond(near.corner, near.last, umbrella);
        lines += straight == kTouched;
        if (near.need == need && line != kTouched) line = straight;
      }
      return {need * 64 + gate, ((row_ * 4 + line) * 4 + need / 5) * 4 + touched,
              (((need * 4 + line) * 3 + far_touched) * 3 + std::min(far_seen[kQuiet], 2u)) * 4 + touched,
              ((((std::min(lines, 2u) * 4 + quiet) * 4 + touched) * 3 + far_touched) * 4 + unknown) * 4 + row_ % 4};
    };
    return flags_.code(port_, gate, contexts, 0, truth);
  }

  /// A touched neighbour, and a corner of it.
  struct Near {
    EndRing* ring;
    Index corner;
    uint32_t need;
    bool last;
  };

  static constexpr uint32_t kRows = 16, kNoNeed = 15;

  Port& port_;
  const EdgeEnds& ends_;
  const UmbrellaWays& ways_;
  EndRings& rings_;
  std::vector<uint8_t> suggested_;  // per umbrella
  std::vector<uint8_t> touched_;    // a writer's truth about umbrellas
  std::vector<Index> gaps_;         // a writer's, the next one last
  Index gap_ = kNone;               // how many umbrellas follow before one is touched that is not suggested
  uint32_t row_ = 0;                // the last umbrellas, a bit each
  NumberModel gap_model_;
  std::vector<Near> near_;
  GatedFlag<4> flags_{64, {16 * 64, kRows * 64, 64 * 36, 3 * 16 * 48}, 1};
};

}  // namespace tutte
