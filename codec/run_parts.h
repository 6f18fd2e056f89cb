#pragma once
// Runs of corners around umbrellas, and which of them belong together.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/edge_ends.h"
#include "codec/mesh.h"
#include "codec/model.h"

namespace tutte {

/// Codes the parts of runs, as their numbers within the whole. Runs are the largest sets of corners around an umbrella
/// that no parted end separates. A run has a new part or one that an earlier run of its whole has, but not a
/// neighbour's, for an end parts them.
template <class Port>
class RunParts {
 public:
  /// `wholes`: per corner, below `whole_count`. It must outlive this object, and so must the port.
  RunParts(Port& port, std::span<const Index> wholes, Index whole_count)
      : port_(port), wholes_(wholes), used_(whole_count) {}

  /// Of an umbrella that is one run, by one of its corners. A writer codes `part`.
  Index codeWhole(Index corner, Index part) { return code(models_[0], wholes_[corner], {}, part); }

  /// Of a touched umbrella: calls set(place, part) for its places. A writer codes partOf(corner).
  template <class PartOf, class Set>
  void codeRing(const EndRings& rings, const EndRing& ring, PartOf partOf, Set set) {
    const Index row_end = rowEnd(rings, ring);
    Run first, before;
    for (Index begin = ring.first, end; begin < row_end; begin = end) {
      for (end = begin + 1; end < row_end && !rings.isParted(end);) ++end;
      const Index corner = rings.corner(begin), whole = wholes_[corner];
      const bool closes = ring.closed && end == row_end;
      const Barred barred(before.partIn(whole), closes ? first.partIn(whole) : kNone);
      before = {whole, code(models_[begin != ring.first], whole, barred, partOf(corner))};
      for (Index place = begin; place < end; ++place) set(place, before.part);
      if (begin != ring.first) continue;
      first = before;
      for (Index place = row_end; place < ring.end(); ++place) set(place, first.part);
    }
  }

  /// Per whole, how many parts its corners use so far.
  const std::vector<Index>& used() const { return used_; }

 private:
  static constexpr Index kMostFlags = 3;  // of a choice

  struct Run {
    Index whole = kNone, part = kNone;

    Index partIn(Index other) const { return whole == other ? part : kNone; }
  };

  /// Parts that a run cannot have, in order; kNone for none. Ranks count the others.
  struct Barred {
    Index low = kNone, high = kNone;

    Barred() = default;
    Barred(Index a, Index b) : low(std::min(a, b)), high(a == b ? kNone : std::max(a, b)) {}

    Index count() const { return (low != kNone) + (high != kNone); }
    Index ranked(Index part) const { return part - (part > low) - (part > high); }
    Index unranked(Index rank) const {
      rank += rank >= low;
      return rank + (rank >= high);
    }
  };

  /// One set for runs of new umbrellas, one for further runs of an umbrella.
  struct Models {
    uint32_t history = 0;  ///< the last three runs: reused or not
    Index last_pick = 0;   ///< up to kMostFlags
    std::array<std::array<Bit, 8>, 3> reuse;
    std::array<std::array<std::array<Bit, kMostFlags + 1>, kMostFlags>, kMostFlags> picks;
  };

  /// Where the last run of a ring's row ends; what is behind it belongs to the first one, as the ring is closed.
  static Index rowEnd(const EndRings& rings, const EndRing& ring) {
    if (!ring.closed || rings.isParted(ring.first)) return ring.end();
    Index end = ring.end();
    while (--end > ring.first) {
      if (rings.isParted(end)) return end;
    }
    return ring.end();
  }

  Index code(Models& models, Index whole, const Barred& barred, Index part) {
    Index& used = used_[whole];
    const Index choices = used - barred.count();
    const bool reused = choices > 0 && isReused(models, choices, part < used);
    return reused ? barred.unranked(pick(models, choices, barred.ranked(part))) : used++;
  }

  bool isReused(Models& models, Index choices, bool value) {
    const bool reused = models.reuse[std::min(choices, 3u) - 1][models.history].code(port_, value);
    models.history = (models.history * 2 + reused) % 8;
    return reused;
  }

  Index pick(Models& models, Index choices, Index rank) {
    if (choices == 1) return 0;
    auto& flags = models.picks[std::min(choices, kMostFlags + 1) - 2];
    Index picked = 0;
    while (picked < kMostFlags && picked + 1 < choices &&
           !flags[picked][models.last_pick].code(port_, rank == picked)) {
      ++picked;
    }
    models.last_pick = picked;
    const bool beyond = picked == kMostFlags && choices > kMostFlags + 1;
    return beyond ? kMostFlags + port_.uniform(choices - kMostFlags, rank - kMostFlags) : picked;
  }

  Port& port_;
  const std::span<const Index> wholes_;
  std::vector<Index> used_;
  std::array<Models, 2> models_;  ///< of umbrellas' first runs; of others
};

}  // namespace tutte
