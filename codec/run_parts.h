#pragma once
// Runs of corners around umbrellas, and which of them belong together.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/end_flags.h"
#include "codec/mesh.h"
#include "codec/model.h"
#include "codec/umbrella_ways.h"

namespace tutte {

/// Runs are the largest sets of corners around an umbrella that no parted end separates, numbered by first corner.
struct Runs {
  std::vector<Index> of_corner, firsts;
  std::vector<Index> before, after;  ///< per run, its neighbours around the umbrella; kNone at a boundary

  /// `ends` are EndStates, `corners` all of some umbrellas, in ascending order: of others, of_corner is kNone.
  Runs(const UmbrellaWays& ways, std::span<const uint8_t> ends, std::span<const Index> corners)
      : of_corner(ends.size(), kNone) {
    for (const Index corner : corners) {
      if (of_corner[corner] == kNone) add(ways, ends, corner);
    }
    before.assign(firsts.size(), kNone);
    after.assign(firsts.size(), kNone);
    for (const Index corner : corners) {
      if (ends[corner] != kParted) continue;
      const Index here = of_corner[corner], there = of_corner[ways.across(corner)];
      after[here] = there;
      before[there] = here;
    }
  }

 private:
  void add(const UmbrellaWays& ways, std::span<const uint8_t> ends, Index first) {
    const Index run = static_cast<Index>(firsts.size());
    firsts.push_back(first);
    for (Index c = first; c != kNone && of_corner[c] == kNone; c = ends[c] == kParted ? kNone : ways.across(c)) {
      of_corner[c] = run;
    }
    for (Index c = ways.back(first); c != kNone && ends[c] != kParted && of_corner[c] == kNone; c = ways.back(c)) {
      of_corner[c] = run;
    }
  }
};

/// Codes the part of each run, as its number within the whole, in the order of runs. A run has a new part or one that
/// an earlier run of its whole has, but not a neighbour's, for an end parts them. All arguments must outlive this
/// object.
template <class Port>
class RunParts {
 public:
  /// `wholes`: per corner, below `whole_count`.
  RunParts(Port& port, const Connectivity& mesh, const Runs& runs, std::span<const Index> wholes, Index whole_count)
      : port_(port), mesh_(mesh), runs_(runs), wholes_(wholes), used_(whole_count), seen_(mesh.umbrella_count) {
    parts_.reserve(runs.firsts.size());
  }

  /// Of the next run. Writer: `part` is coded.
  void code(Index part) {
    const auto run = static_cast<Index>(parts_.size());
    const Index first = runs_.firsts[run];
    Index& used = used_[wholes_[first]];
    const Barred barred = barredFor(run);
    const Index choices = used - barred.count();
    Models& models = models_[std::exchange(seen_[mesh_.umbrellas[first]], uint8_t{1})];
    const bool reused = choices > 0 && isReused(models, choices, part < used);
    parts_.push_back(reused ? barred.unranked(pick(models, choices, barred.ranked(part))) : used++);
  }

  /// Per run.
  const std::vector<Index>& parts() const { return parts_; }

  /// Afterwards: per whole, how many parts its corners use.
  const std::vector<Index>& used() const { return used_; }

 private:
  static constexpr Index kMostFlags = 3;  // of a choice

  /// Parts that a run cannot have, in order; kNone for none. Ranks count the others.
  struct Barred {
    Index low = kNone, high = kNone;

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

  /// The parts of the neighbours in the same whole, as far as they are known.
  Barred barredFor(Index run) const {
    Barred barred{knownPart(runs_.before[run], run), knownPart(runs_.after[run], run)};
    if (barred.high < barred.low) std::swap(barred.low, barred.high);
    if (barred.high == barred.low) barred.high = kNone;
    return barred;
  }

  Index knownPart(Index neighbour, Index run) const {
    const bool known = neighbour < parts_.size() && wholes_[runs_.firsts[neighbour]] == wholes_[runs_.firsts[run]];
    return known ? parts_[neighbour] : kNone;
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
  const Connectivity& mesh_;
  const Runs& runs_;
  const std::span<const Index> wholes_;
  std::vector<Index> parts_, used_;
  std::vector<uint8_t> seen_;  ///< per umbrella: 1 when a run of it is known
  std::array<Models, 2> models_;
};

}  // namespace tutte
