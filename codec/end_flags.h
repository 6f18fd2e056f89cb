#pragma once
// Flags at the ends of edges, coded with what is known around both vertices of the edge.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/mixed_flag.h"
#include "codec/umbrella_links.h"
#include "codec/value_model.h"

namespace tutte {

/// Codes one flag per edge-end ("the two corners differ"), edge by edge in the order of their first corners. Around a
/// closed umbrella the flags cannot be 1 exactly once: the last one is implied when it would otherwise be. O(corners).
template <class Port>
class EndFlags {
 public:
  /// Only ends with candidates[end] == 1 are coded; of the others, those with given[end] == 1 are known to be 1 from
  /// the start (no span: none), the rest are 0. All arguments must outlive this object.
  EndFlags(Port& port, const Connectivity& mesh, const UmbrellaLinks& links, std::span<const uint8_t> candidates,
           std::span<const uint8_t> given = {})
      : port_(port), mesh_(mesh), links_(links), candidates_(candidates), given_(given), around_(mesh.umbrella_count) {
    for (Index u = 0; u < mesh.umbrella_count; ++u) around_[u].open = links.open[u];
    for (Index corner = 0; corner < candidates.size(); ++corner) {
      Around& around = around_[mesh.umbrellas[corner]];
      around.left += candidates[corner];
      if (around.corners < kMostCorners) ++around.corners;
      if (!given.empty() && given[corner]) around.parted = static_cast<uint8_t>(std::min(around.parted + 1, 2));
    }
    quiet_.fill(values::Chance(65536 / 16));
  }

  /// Writer: `flags` are coded. Reader: `flags` are filled in. One flag per corner.
  void code(std::vector<uint8_t>& flags) {
    known_.assign(flags.size(), 0);
    for (size_t end = 0; end < given_.size(); ++end) {
      if (given_[end]) known_[end] = 2, flags[end] = 1;
    }
    for (Index corner = 0; corner < flags.size(); ++corner) {
      const Index twin = mesh_.twins[corner];
      if (twin == kNone || twin < corner) continue;
      if (candidates_[corner]) flags[corner] = end(corner, twin, flags[corner]);
      if (candidates_[twin]) flags[twin] = end(twin, corner, flags[twin]);
    }
  }

 private:
  static constexpr uint8_t kMostCorners = 7;

  /// What is known about one umbrella.
  struct Around {
    Index left = 0;      ///< ends that are still to come
    uint8_t parted = 0;  ///< ends that were 1, up to 2
    uint8_t open = 0;
    uint8_t corners = 0;  ///< up to kMostCorners
  };

  uint8_t end(Index corner, Index far, uint8_t flag) {
    Around& here = around_[mesh_.umbrellas[corner]];
    const Around& there = around_[mesh_.umbrellas[far]];
    if (here.left == 1 && !here.open && here.parted < 2) {
      flag = here.parted;
    } else if (here.parted == 0 && there.parted == 0) {
      flag = quiet(here, there, known_[far]).code(port_, flag);
    } else {
      flag = mixed_.code(port_, contextsOf(corner, far, here, there), known_[far], flag);
    }
    here.parted = static_cast<uint8_t>(std::min(here.parted + flag, 2));
    --here.left;
    known_[corner] = static_cast<uint8_t>(1 + flag);
    history_ = (history_ * 2 + flag) % 16;
    return flag;
  }

  /// Far from all seams one plain context is enough, and fast.
  values::Chance& quiet(const Around& here, const Around& there, int other) {
    return quiet_[((other * 2 + here.open) * 2 + (here.left <= 2)) * 2 + (there.left <= 2)];
  }

  std::array<uint32_t, 6> contextsOf(Index corner, Index far, const Around& here, const Around& there) const {
    const Index after = links_.across[corner], before = links_.back[corner];
    const uint32_t sides = known(after) * 3 + known(before);
    const uint32_t next_but_one = known(across(after)) * 3 + known(back(before));
    const uint32_t far_sides = known(links_.across[far]) * 3 + known(links_.back[far]);
    const uint32_t straight = opposite(corner, here) * 3 + opposite(far, there);
    const uint32_t seen = known_[far] * 9 + here.parted * 3 + there.parted;
    const uint32_t corners = std::max<uint32_t>(here.corners, 3) - 3;
    const uint32_t room = (std::min(here.left, 8u) - 1) * 8 + std::min(there.left, 7u);
    return {((sides * 9 + next_but_one) * 5 + corners) * 27 + seen,
            straight * 27 + seen,
            room * 27 + seen,
            (far_sides * 9 + sides) * 9 + known_[far] * 3 + here.parted,
            ((facing(corner) * 3 + facing(far)) * 16 + history_) * 27 + seen,
            (beside(corner) * 9 + beside(far)) * 27 + seen};
  }

  /// 0: not known (or no end); 1 or 2: the flag was 0 or 1.
  uint32_t known(Index end) const { return end == kNone ? 0 : known_[end]; }
  Index across(Index end) const { return end == kNone ? kNone : links_.across[end]; }
  Index back(Index end) const { return end == kNone ? kNone : links_.back[end]; }

  /// Of an edge, by one of its ends: 2 when a flag of it is 1, 1 when none is that is known, 0 when none is known.
  uint32_t edge(Index end) const {
    const Index twin = mesh_.twins[end];
    return twin == kNone ? 0 : std::max(known_[end], known_[twin]);
  }

  /// The edges before and after this one in its face.
  uint32_t beside(Index end) const { return edge(links_.next[end]) * 3 + edge(links_.prev[end]); }

  /// The edge at the other side of a quad.
  uint32_t facing(Index end) const {
    const Index far_corner = links_.next[links_.next[end]];
    return links_.next[links_.next[far_corner]] == end ? edge(far_corner) : 0;
  }

  /// The end that continues an edge straight through a vertex with four corners.
  uint32_t opposite(Index end, const Around& here) const {
    if (here.corners != 4) return 0;
    const Index forwards = across(across(end));
    return known(forwards != kNone ? forwards : back(back(end)));
  }

  Port& port_;
  const Connectivity& mesh_;
  const UmbrellaLinks& links_;
  std::span<const uint8_t> candidates_, given_;
  std::vector<Around> around_;
  std::vector<uint8_t> known_;
  uint32_t history_ = 0;  ///< the last four flags
  std::array<values::Chance, 16> quiet_;
  MixedFlag<6> mixed_{{81 * 5 * 27, 9 * 27, 64 * 27, 81 * 9, 9 * 16 * 27, 81 * 27}, 3};
};

}  // namespace tutte
