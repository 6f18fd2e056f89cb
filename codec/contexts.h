#pragma once
// What the statistics look at: features of the boundary around a face or vertex that is about to be coded, and the
// contexts made of them. A context is up to 44 bits; each has a table of its own.

#include <algorithm>
#include <array>
#include <cstdint>

#include "codec/gaps.h"
#include "codec/walk.h"

namespace tutte {

/// The last three symbols of both streams, the newest in the lowest byte; valences and degrees up to 255.
struct History {
  uint32_t valences = 0, degrees = 0;

  void addValence(Index valence) { push(valences, valence); }
  void addDegree(Index degree) { push(degrees, degree); }

 private:
  static void push(uint32_t& list, Index value) { list = (list << 8 | std::min(value, Index{255})) & 0xFFFFFF; }
};

/// kSides[angle >> 6]: see sidesOf.
inline constexpr std::array<uint8_t, 1024> kSides = [] {
  std::array<uint8_t, 1024> sides{};
  for (int part = 0; part < 1024; ++part) sides[part] = static_cast<uint8_t>(std::min(30, 4096 / (1024 - part)));
  return sides;
}();

/// Sides of the regular polygon with the given angle (1 - 2 / sides, in 1/65536), in half steps, at most 30.
inline uint64_t sidesOf(int64_t angle) {
  return kSides[static_cast<size_t>(std::clamp(angle >> 6, int64_t{0}, int64_t{1023}))];
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

/// Around a missing vertex. "Head" and "current" are the vertices of the face between which it lies.
struct VertexFeatures {
  uint64_t face, missing, mode;           // the face's degree (dummy: 1), vertices missing, usual valence
  uint64_t head, current, before, after;  // valences: at head, at current, and beyond them on the boundary
  uint64_t head_slots, current_slots, before_slots, after_slots;
  uint64_t head_sum, current_sum;    // excess of the neighbours' valences, around 8
  uint64_t opposite, opposite_head;  // the vertex across the edge before the first missing one / head
  uint64_t predicted;                // valence that would make the dual face flat, in half steps
  uint64_t degree_after;             // degree behind the edge that leaves current
  History history;

  // Inlined, so that what no context of a profile reads is not gathered.
  [[gnu::always_inline]] VertexFeatures(const VertexQuestion& q, const Gaps& gaps, Index usual_valence,
                                        const History& recent)
      : history(recent) {
    const Gap& a = q.head == kNone ? kNoGap : gaps[q.head];
    const Gap& b = q.current == kNone ? kNoGap : gaps[q.current];
    const Gap& next = b.next == kNone ? kNoGap : gaps[b.next];
    const Gap& prev = a.prev == kNone ? kNoGap : gaps[a.prev];
    const Gap& edge = q.before_tail == kNone ? kNoGap : gaps[q.before_tail];
    face = q.face.dummy ? 1 : std::min(q.face.degree, Index{15});
    missing = std::min(q.missing, Index{7});
    mode = usual_valence;
    head = valence(a), current = valence(b), before = valence(prev), after = valence(next);
    head_slots = slots(a), current_slots = slots(b), before_slots = slots(prev), after_slots = slots(next);
    const int regular = q.face.degree == 3 ? 6 : 4;
    head_sum = sum(a, regular), current_sum = sum(b, regular);
    opposite = q.index == 0 && q.before_tail != kNone ? edge.opposite_next : 15;
    opposite_head = q.missing == 1 && q.head != kNone ? a.opposite_own : 15;
    const int64_t rest = 131072 - q.angle;
    predicted = sidesOf(q.missing == 1 ? rest : rest / static_cast<int64_t>(q.missing));
    degree_after = std::min(b.degree_behind, Index{15});
  }

  uint64_t beyondCurrent() const { return current_slots == 1 ? after : 0; }
  uint64_t beyondHead() const { return head_slots == 1 ? before : 0; }
  uint64_t nearest() const { return missing == 1 ? opposite_head : opposite; }

  static uint64_t valence(const Gap& gap) { return std::min(gap.valence, Index{14}); }
  static uint64_t slots(const Gap& gap) { return std::min(gap.free_slots, Index{7}); }
  static uint64_t sum(const Gap& gap, int regular) {
    const int64_t excess = int64_t{gap.neighbour_valences} - int64_t{regular} * gap.neighbours;
    return static_cast<uint64_t>(std::clamp(excess, int64_t{-7}, int64_t{7}) + 8);
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
  return p | (f.face | f.missing << 4 | f.mode << 7) << 44;
}

/// Around a face. It is attached from "near" to "far"; its part on the boundary runs from "head" to "tail".
struct FaceFeatures {
  uint64_t known, least;           // edges known, least possible degree
  uint64_t near, far, head, tail;  // valences
  uint64_t near_slots, head_slots, tail_slots;
  uint64_t behind, behind_tail, behind_head;  // degrees: across the first edge, and beyond both ends
  uint64_t near_predicted, far_predicted;     // degrees that would make the vertices flat, in half steps
  uint64_t dummies;                           // which of near, far, head, tail touch a dummy face
  uint64_t mean_sum;                          // excess of the neighbours' valences at both ends
  History history;

  [[gnu::always_inline]] FaceFeatures(const FaceQuestion& q, const Gaps& gaps, const History& recent)
      : history(recent) {
    const auto at = [&](Index gap) -> const Gap& { return gap == kNone ? kNoGap : gaps[gap]; };
    const Gap &g0 = at(q.gap), &g1 = at(q.far_gap), &a = at(q.head), &b = at(q.tail), &prev = at(a.prev);
    known = std::min(q.known_edges, Index{15});
    least = std::min(std::max(Index{3}, q.known_edges + 1), Index{9});
    near = VertexFeatures::valence(g0), far = VertexFeatures::valence(g1);
    head = VertexFeatures::valence(a), tail = VertexFeatures::valence(b);
    near_slots = VertexFeatures::slots(g0);
    head_slots = VertexFeatures::slots(a), tail_slots = VertexFeatures::slots(b);
    behind = degree(g0), behind_tail = degree(b), behind_head = degree(prev);
    near_predicted = predict(g0), far_predicted = predict(g1);
    dummies = uint64_t{g0.dummy} | uint64_t{g1.dummy} << 1 | uint64_t{a.dummy} << 2 | uint64_t{b.dummy} << 3;
    mean_sum = (VertexFeatures::sum(a, 4) + VertexFeatures::sum(b, 4)) / 2;
  }

  static uint64_t degree(const Gap& gap) { return std::min(gap.degree_behind, Index{15}); }
  // The face takes one of the vertex's slots already.
  static uint64_t predict(const Gap& gap) {
    return sidesOf((int64_t{131072} - gap.angle) / (int64_t{gap.free_slots} + 1));
  }
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
    p.add(f.near_predicted, 5).add(std::min(f.near_slots, uint64_t{2}), 2).add(f.behind, 4);
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

/// Keys for a list of contexts.
template <auto... contexts, class Features>
[[gnu::always_inline]] inline std::array<uint64_t, sizeof...(contexts)> keysOf(const Features& features) {
  return {keyOf<contexts>(features)...};
}

}  // namespace tutte
