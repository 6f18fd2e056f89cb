#pragma once
// What the statistics look at: features of the boundary around a face or vertex that is about to be coded, and the
// contexts made of them. A context is up to 44 bits; each has a table of its own.

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "codec/gaps.h"
#include "codec/made_table.h"
#include "codec/walk.h"

namespace tutte {

/// The last three symbols of both kinds, the newest in the lowest byte; valences and degrees modulo 256.
struct History {
  uint32_t valences = 0, degrees = 0;

  void addValence(Index valence) { push(valences, valence); }
  void addDegree(Index degree) { push(degrees, degree); }

 private:
  static void push(uint32_t& list, Index value) { list = (list << 8 | (value & 0xFF)) & 0xFFFFFF; }
};

/// kSides[angle >> 6]: see sidesOf.
TUTTE_TABLE std::array<uint8_t, 2049> kSides = madeTable([] {
  std::array<uint8_t, 2049> sides{};
  for (int part = 0; part <= 2048; ++part) {
    sides[part] = static_cast<uint8_t>(part < 1024 ? std::min(30, 4096 / (1024 - part)) : 30);
  }
  return sides;
});

/// 2^32 / n, rounded up.
TUTTE_TABLE std::array<uint64_t, 64> kInverse = madeTable([] {
  std::array<uint64_t, 64> inverse{};
  for (uint64_t n = 1; n < 64; ++n) inverse[n] = ((uint64_t{1} << 32) + n - 1) / n;
  return inverse;
});

/// Sides of the regular polygon whose angle is the `parts`-th part of what `angle`, at least 0, lacks to a whole
/// turn (1 - 2 / sides, in 1/65536), in half steps, at most 30.
[[gnu::always_inline]] inline uint32_t sidesOf(int64_t angle, uint64_t parts) {
  const uint64_t rest = static_cast<uint64_t>(std::max(131072 - angle, int64_t{0}));
  const uint64_t part = parts < kInverse.size() ? rest * kInverse[parts] >> 32 : rest / parts;
  return kSides[part >> 6];
}

/// Packs features, the first one lowest. Each is given with its number of bits.
class Pack {
 public:
  Pack& add(uint64_t value, int bits) {
    packed_ |= value << shift_;
    shift_ += bits;
    return *this;
  }
  operator uint64_t() const { return packed_; }

 private:
  uint64_t packed_ = 0;
  int shift_ = 0;
};

inline constexpr Gap kNoGap{};

/// A gap that may not exist.
inline const Gap& orNone(const Gap* gap) { return gap == nullptr ? kNoGap : *gap; }

/// Around a missing vertex. "Head" and "current" are the vertices of the face between which it lies.
struct VertexFeatures {
  uint32_t missing;                       // vertices
  uint32_t head, current, before, after;  // valences: at head, at current, and beyond them on the boundary
  uint32_t head_slots, current_slots, before_slots, after_slots;  // modulo 8
  uint32_t head_sum, current_sum;                                 // excess of the neighbours' valences, modulo 16
  uint32_t opposite, opposite_head;  // the vertex across the edge before the first missing one / head
  uint32_t predicted;                // valence that would make the dual face flat, in half steps
  uint32_t degree_after;             // degree behind the edge that leaves current
  History history;

  // Inlined, so that what no context of a profile reads is not gathered. In a seed face some of the gaps do not exist.
  // `Seed`: bool, or a constant that is one.
  template <class Seed>
  [[gnu::always_inline]] VertexFeatures(Seed seed, const VertexQuestion& q, const History& recent)
      : missing(std::min(q.missing, Index{7})), history(recent) {
    const auto at = [seed](const Gap* gap) -> const Gap& { return seed ? orNone(gap) : *gap; };
    const Gap &a = at(q.head), &b = at(q.current), &edge = at(q.before_tail), &next = at(b.next), &prev = at(a.prev);
    head = a.capped, current = b.capped, before = prev.capped, after = next.capped;
    head_slots = slots(a), current_slots = slots(b), before_slots = slots(prev), after_slots = slots(next);
    const uint32_t extra = q.degree == 3 ? 2 : 0;
    head_sum = sum(a, extra), current_sum = sum(b, extra);
    opposite = q.index == 0 && !seed ? edge.opposite_next : 15;
    opposite_head = q.missing == 1 && !seed ? a.opposite_own : 15;
    predicted = sidesOf(q.angle, q.missing);
    degree_after = b.degree_behind & 15;
  }

  uint32_t beyondCurrent() const { return current_slots == 1 ? after : 0; }
  uint32_t beyondHead() const { return head_slots == 1 ? before : 0; }
  uint32_t nearest() const { return missing == 1 ? opposite_head : opposite; }

  static uint32_t slots(const Gap& gap) { return gap.free_slots & 7; }
  // `extra`: how far what is regular is above 4.
  [[gnu::always_inline]] static uint32_t sum(const Gap& gap, uint32_t extra) {
    return (gap.met - extra * (gap.met >> 16)) & 15;
  }
};

/// Contexts of a valence.
enum class VertexContext {
  kNothing,
  kPredicted,
  kHeadRing,
  kEnds,
  kSlots,
  kHistory,
  kSums,
  kPredictedSums,
  kBeyond,
  kCurrentRing,
  kDegrees,
  kEndsAndSlots,
  kDegreeAfter,
  kSumsAndSlots,
  kPredictedSlots,
};

template <VertexContext context>
[[gnu::always_inline]] inline uint64_t keyOf(const VertexFeatures& f) {
  using enum VertexContext;
  Pack p;
  if constexpr (context == kPredicted) p.add(f.predicted, 5);
  if constexpr (context == kHeadRing) p.add(f.head, 4).add(f.head_sum, 4).add(f.head_slots, 3);
  if constexpr (context == kEnds) {
    p.add(f.head, 4).add(f.current, 4).add(f.beyondCurrent(), 4).add(f.beyondHead(), 4).add(f.opposite, 4);
  }
  if constexpr (context == kSlots) {
    p.add(f.head_slots, 3).add(f.current_slots, 3).add(f.after_slots, 3).add(f.before_slots, 3);
  }
  if constexpr (context == kHistory) {
    p.add(f.history.valences, 24);
  }
  if constexpr (context == kSums) {
    p.add(f.head + f.current, 5).add(f.opposite, 4).add(f.opposite_head, 4).add(f.head_sum + f.current_sum, 5);
  }
  if constexpr (context == kPredictedSums) p.add(f.predicted, 5).add(f.head_sum + f.current_sum, 5).add(f.nearest(), 4);
  if constexpr (context == kBeyond) {
    p.add(f.after, 4).add(f.before, 4).add(f.current_slots == 1, 1).add(f.head_slots == 1, 1);
  }
  if constexpr (context == kCurrentRing) p.add(f.current, 4).add(f.current_sum, 4).add(f.current_slots, 3);
  if constexpr (context == kDegrees) {
    p.add(f.history.degrees, 24).add(f.history.valences & 0xFF, 8);
  }
  if constexpr (context == kEndsAndSlots) {
    p.add(f.head, 4).add(f.current, 4).add(f.beyondCurrent(), 4).add(f.beyondHead(), 4);
    p.add(f.head_slots, 3).add(f.current_slots, 3);
  }
  if constexpr (context == kDegreeAfter) p.add(f.current, 4).add(f.current_slots, 3).add(f.degree_after, 4);
  if constexpr (context == kSumsAndSlots) {
    p.add(f.head + f.current, 5).add(f.opposite, 4).add(f.head_sum / 3, 3).add(f.current_sum / 3, 3);
    p.add(f.head_slots, 3).add(f.current_slots, 3);
  }
  if constexpr (context == kPredictedSlots) p.add(f.predicted, 5).add(f.head_slots, 3).add(f.current_slots, 3);
  return p;
}

/// Around a face. It is attached from "near" to "far"; its part on the boundary runs from "head" to "tail".
struct FaceFeatures {
  uint32_t known, least;           // edges known, least possible degree
  uint32_t near, far, head, tail;  // valences
  uint32_t near_slots, head_slots, tail_slots;
  uint32_t behind, behind_tail, behind_head;  // degrees: across the first edge, and beyond both ends
  uint32_t near_predicted, far_predicted;     // degrees that would make the vertices flat, in half steps
  uint32_t dummies;                           // which of near, far, head, tail touch a dummy face
  uint32_t mean_sum;                          // excess of the neighbours' valences at both ends
  History history;

  [[gnu::always_inline]] FaceFeatures(const FaceQuestion& q, const History& recent) : history(recent) {
    const bool seed = q.gap == nullptr;
    const auto at = [seed](const Gap* gap) -> const Gap& { return seed ? kNoGap : *gap; };
    const Gap &g0 = at(q.gap), &g1 = at(q.far_gap), &a = at(q.head), &b = at(q.tail), &prev = at(a.prev);
    known = q.known_edges & 15;
    least = std::min(std::max(Index{3}, q.known_edges + 1), Index{9});
    near = g0.capped, far = g1.capped;
    head = a.capped, tail = b.capped;
    near_slots = VertexFeatures::slots(g0);
    head_slots = VertexFeatures::slots(a), tail_slots = VertexFeatures::slots(b);
    behind = degree(g0), behind_tail = degree(b), behind_head = degree(prev);
    near_predicted = predict(g0), far_predicted = predict(g1);
    dummies = uint32_t{g0.dummy} | uint32_t{g1.dummy} << 1 | uint32_t{a.dummy} << 2 | uint32_t{b.dummy} << 3;
    mean_sum = (VertexFeatures::sum(a, 0) + VertexFeatures::sum(b, 0)) / 2;
  }

  static uint32_t degree(const Gap& gap) { return gap.degree_behind & 15; }
  // The face takes one of the vertex's slots already.
  static uint32_t predict(const Gap& gap) { return sidesOf(gap.angle, uint64_t{gap.free_slots} + 1); }
};

/// Contexts of a degree.
enum class FaceContext {
  kNothing,
  kEnds,
  kNearAngle,
  kHistory,
  kAround,
  kEdge,
  kLeast,
  kAngles,
  kDegrees,
  kBehind,
  kSums,
  kSlots,
  kBoth,
  kEdgeAndDegrees,
  kDummies,
};

template <FaceContext context>
[[gnu::always_inline]] inline uint64_t keyOf(const FaceFeatures& f) {
  using enum FaceContext;
  Pack p;
  if constexpr (context == kEnds) p.add(f.head, 4).add(f.tail, 4).add(f.known, 4);
  if constexpr (context == kNearAngle) {
    p.add(f.near_predicted, 5).add(std::min(f.near_slots, 2u), 2).add(f.behind, 4);
  }
  if constexpr (context == kHistory) p.add(f.history.degrees & 0xFFFF, 16);
  if constexpr (context == kAround) {
    p.add(f.head, 4).add(f.tail, 4).add(f.head_slots, 3).add(f.tail_slots, 3);
    p.add(f.behind, 4).add(f.behind_head, 4).add(f.known, 4);
  }
  if constexpr (context == kEdge) p.add(f.behind, 4).add(f.near, 4).add(f.far, 4);
  if constexpr (context == kLeast) p.add(f.least, 4).add(f.dummies, 4);
  if constexpr (context == kAngles) p.add(f.near_predicted, 5).add(f.far_predicted, 5).add(f.known, 4).add(f.least, 4);
  if constexpr (context == kDegrees) p.add(f.behind, 4).add(f.behind_head, 4).add(f.behind_tail, 4);
  if constexpr (context == kBehind) p.add(f.behind, 4);
  if constexpr (context == kSums) p.add(f.mean_sum, 4).add(f.known, 4).add(f.behind, 4).add(f.least, 4);
  if constexpr (context == kSlots) p.add(f.known, 4).add(f.head_slots, 3).add(f.tail_slots, 3).add(f.behind, 4);
  if constexpr (context == kBoth) {
    for (int i = 0; i < 3; ++i) {
      p.add(std::min(f.history.degrees >> 8 * i & 0xFF, 127u), 7);
      p.add(std::min(f.history.valences >> 8 * i & 0xFF, 127u), 7);
    }
  }
  if constexpr (context == kEdgeAndDegrees) {
    p.add(f.near, 4).add(f.far, 4).add(f.known, 4).add(f.behind, 4).add(f.behind_tail, 4);
  }
  if constexpr (context == kDummies) p.add(f.dummies, 4).add(f.behind, 4).add(f.behind_head, 4).add(f.behind_tail, 4);
  return p;
}

}  // namespace tutte
