#pragma once
// Flags at the ends of edges, coded with what is known around both vertices of the edge.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/mixed_flag.h"
#include "codec/umbrella_ways.h"
#include "codec/value_model.h"

namespace tutte {

/// What is known of an edge-end. Without kAsked it is also what contexts see of it.
enum EndState : uint8_t {
  kNoEnd = 0,   ///< nothing differs here, and nobody asks
  kJoined = 1,  ///< the two corners are alike
  kParted = 2,  ///< they differ
  kAsked = 4,   ///< it is to be coded which of these it is, unless there is no end, but a boundary
};

/// Codes which edge-ends are parted: first which umbrellas are *touched*, that is, have any, then which of their ends,
/// edge by edge. Around a closed umbrella there cannot be exactly one. O(corners).
template <class Port>
class EndFlags {
 public:
  /// `ends`: per corner its EndState; what is asked and parted becomes kParted. `truth`: per corner, 1 for parted ends;
  /// a decoder passes nothing. All arguments must outlive this object.
  EndFlags(Port& port, const UmbrellaWays& ways, std::vector<uint8_t>& ends, std::span<const uint8_t> truth = {})
      : port_(port), ways_(ways), ends_(ends), truth_(truth), slots_(ways.mesh().umbrella_count, kUnknown) {
    if constexpr (Port::kWriting) findTouched();
    quiet_.fill(values::Chance(65536 / 16));
  }

  void code() {
    codeTouched();
    if (!around_.empty()) listCorners();
    for (const Index corner : corners_) {
      if (!isAsked(corner)) continue;
      const Index twin = ways_.twin(corner);
      codeEnd(corner, twin);
      codeEnd(twin, corner);
    }
  }

  /// Afterwards: those of the touched umbrellas, in ascending order.
  const std::vector<Index>& corners() const { return corners_; }

 private:
  // Of an umbrella: whether its ends are known to be all joined, or where in `around_` it is.
  static constexpr Index kUnknown = 0, kQuiet = 1, kTouched = 2;

  /// What is known about a touched umbrella.
  struct Around {
    Index left = 0;        ///< asked ends that are still to come
    uint8_t parted = 0;    ///< ends that are, up to 2
    uint8_t required = 1;  ///< parted ends that must still come
  };

  bool isAsked(Index end) const { return ends_[end] == kAsked && ways_.twin(end) != kNone; }

  void findTouched() {
    touched_.resize(slots_.size());
    for (Index end = 0; end < ends_.size(); ++end) {
      if (isAsked(end)) touched_[ways_.umbrella(end)] |= truth_[end];
    }
  }

  // In the order in which asked ends of umbrellas come.
  void codeTouched() {
    uint32_t row = 0;  // of umbrellas, as corners follow each other
    for (Index corner = 0, count = cornerCount(); corner < count; ++corner) {
      Index& slot = slots_[ways_.umbrella(corner)];
      if (slot == kUnknown && isAsked(corner)) slot = codeUmbrella(corner, row);
      row = row * 2 + (slot >= kTouched);
    }
  }

  void listCorners() {
    for (Index corner = 0, count = cornerCount(); corner < count; ++corner) {
      if (slots_[ways_.umbrella(corner)] >= kTouched) corners_.push_back(corner);
    }
  }

  Index cornerCount() const { return static_cast<Index>(ends_.size()); }

  Index codeUmbrella(Index corner, uint32_t row) {
    const bool truth = Port::kWriting && touched_[ways_.umbrella(corner)];
    const uint32_t behind = stateAt(ways_.next(corner));
    const bool touched = row % kRows == 0 && behind != kTouched
                             ? quiet_[behind].code(port_, truth)
                             : touches_.code(port_, contextsOf(corner, row % kRows), 0, truth);
    if (!touched) return kQuiet;
    around_.push_back(lookAround(corner));
    return kTouched + static_cast<Index>(around_.size() - 1);
  }

  std::array<uint32_t, 3> contextsOf(Index corner, uint32_t row) const {
    const Index next = ways_.next(corner), prev = ways_.prev(corner);
    const Index left = ways_.twin(prev), right = ways_.twin(corner);
    const uint32_t before = stateAt(prev), behind = stateAt(next), opposite = stateAt(ways_.next(next));
    const uint32_t beyond =
        (left == kNone ? 3 : stateAt(ways_.next(ways_.next(left)))) * 4 + stateAt(ways_.prev(right));
    const uint32_t face = (before * 3 + behind) * 3 + opposite;
    return {face * 16 + beyond, (row * 3 + behind) * 3 + opposite,
            ((before * 3 + behind) * 2 + (left == kNone)) * 16 + row % 16};
  }

  // Of the umbrella of a corner.
  Around lookAround(Index first) const {
    Around around;
    bool closed = false;
    const auto look = [&](Index end) {
      around.left += isAsked(end);
      if (ends_[end] == kParted) around.parted = 2;
    };
    Index corner = first;
    do {
      look(corner);
      corner = ways_.across(corner);
      closed = corner == first;
    } while (!closed && corner != kNone);
    if (closed && around.parted == 0) around.required = 2;
    if (closed) return around;
    for (corner = ways_.back(first); corner != kNone; corner = ways_.back(corner)) look(corner);
    return around;
  }

  /// kUnknown, kQuiet or kTouched.
  uint32_t stateAt(Index corner) const { return std::min(slots_[ways_.umbrella(corner)], kTouched); }

  void codeEnd(Index corner, Index far) {
    const Index slot = slots_[ways_.umbrella(corner)];
    if (slot < kTouched || !isAsked(corner)) return;
    Around& here = around_[slot - kTouched];
    const bool parted = here.left == here.required ||
                        flags_.code(port_, contextsOf(corner, far, here), known(far), Port::kWriting && truth_[corner]);
    here.parted = static_cast<uint8_t>(std::min(here.parted + parted, 2));
    here.required = here.required > parted ? static_cast<uint8_t>(here.required - parted) : 0;
    --here.left;
    ends_[corner] = parted ? kParted : kJoined;
    history_ = (history_ * 2 + parted) % kHistories;
  }

  std::array<uint32_t, 6> contextsOf(Index corner, Index far, const Around& here) const {
    const Index after = ways_.across(corner), before = ways_.back(corner);
    const Index after2 = ways_.across(after), before2 = ways_.back(before);
    const Index far_after = ways_.across(far), far_before = ways_.back(far);
    const Index far_after2 = ways_.across(far_after), far_before2 = ways_.back(far_before);
    const Index slot = slots_[ways_.umbrella(far)];
    const Around there = slot >= kTouched ? around_[slot - kTouched] : Around{0, 3};
    const uint32_t sides = known(after) * 3 + known(before), far_sides = known(far_after) * 3 + known(far_before);
    const uint32_t straight = opposite(after2, before2) * 3 + opposite(far_after2, far_before2);
    const uint32_t seen = (known(far) * 3 + here.parted) * 4 + there.parted;
    const uint32_t room = (std::min(here.left, 8u) - 1) * 8 + std::min(there.left, 7u);
    return {(sides * 9 + known(after2) * 3 + known(before2)) * kSeen + seen,
            straight * kSeen + seen,
            room * kSeen + seen,
            (far_sides * 9 + sides) * kSeen + seen,
            ((facing(corner) * 3 + facing(far)) * kHistories + history_) * kSeen + seen,
            (beside(corner) * 9 + beside(far)) * kSeen + seen};
  }

  /// 0: not known (or no end).
  uint32_t known(Index end) const { return end == kNone ? 0 : ends_[end] & 3; }

  /// Of an edge, by one of its ends: 2 when an end of it is parted, 1 when none is that is known, 0 when none is known.
  uint32_t edge(Index end) const {
    const Index twin = ways_.twin(end);
    return twin == kNone ? 0 : std::max(known(end), known(twin));
  }

  /// The edges before and after this one in its face.
  uint32_t beside(Index end) const { return edge(ways_.next(end)) * 3 + edge(ways_.prev(end)); }

  /// The edge at the other side of a quad.
  uint32_t facing(Index end) const { return ways_.degree(end) == 4 ? edge(ways_.next(ways_.next(end))) : 0; }

  /// The end that continues an edge straight through a vertex with four corners.
  uint32_t opposite(Index after2, Index before2) const { return after2 == before2 ? known(after2) : 0; }

  static constexpr uint32_t kRows = 256, kHistories = 16, kSeen = 36;

  Port& port_;
  const UmbrellaWays& ways_;
  std::vector<uint8_t>& ends_;
  const std::span<const uint8_t> truth_;
  std::vector<uint8_t> touched_;  // a writer's truth about umbrellas
  std::vector<Index> slots_;      // per umbrella
  std::vector<Around> around_;
  std::vector<Index> corners_;
  uint32_t history_ = 0;  ///< the last flags
  std::array<values::Chance, 2> quiet_;
  MixedFlag<3> touches_{{27 * 16, kRows * 9, 9 * 32}, 1};
  MixedFlag<6> flags_{{81 * kSeen, 9 * kSeen, 64 * kSeen, 81 * kSeen, 9 * kHistories* kSeen, 81 * kSeen}, 3};
};

}  // namespace tutte
