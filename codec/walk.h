#pragma once
// The traversal (sections 3.1 and 3.2 of Khodakovsky, Alliez, Desbrun, Schroeder 2002), written once: the encoder and
// the decoder run the same text and differ only in the script that answers its questions. The walk knows the mesh and
// no bits; it never sees the range coder.
//
// It grows a region face by face. A face is attached along the edge that leaves a gap; how far it touches the region
// on both sides follows from gaps without free slots. The script then tells its degree and, for each vertex that is
// still missing, its valence, or that it is a *split*: a vertex that the region has elsewhere.
//
// While a face is attached, the gaps it uses are out of the queue; so "queued" tells the rest of the boundary from
// the current face, and no stream can make the walk use a slot twice.

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "codec/gaps.h"
#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// What is known of a face before its degree is.
struct FaceQuestion {
  Index gap = kNone;      ///< where it is attached; kNone for the first face of a component
  Index far_gap = kNone;  ///< the gap at the far end of that edge
  Index head = kNone;     ///< the first vertex of the face on the boundary
  Index tail = kNone;     ///< the last one
  Index known_edges = 0;  ///< edges that it shares with the region
  bool closed = false;    ///< all its edges are known: its degree is known_edges
};

/// A face's degree. A dummy face closes a hole and is not part of the mesh.
struct FaceAnswer {
  Index degree = 0;
  bool dummy = false;
};

/// What is known of a missing vertex of the current face.
struct VertexQuestion {
  FaceAnswer face;
  Index head = kNone;         ///< where the face's missing vertices end; kNone in the first face of a component
  Index current = kNone;      ///< the vertex before this one; kNone for the first vertex of a component
  Index before_tail = kNone;  ///< the vertex before the first missing one's predecessor; kNone likewise
  Index index = 0;            ///< missing vertices of the face that were coded before
  Index known_vertices = 0;   ///< vertices of the face that are known by now
  uint64_t valence_sum = 0;   ///< sum of their valences
  int64_t angle = 0;          ///< sum over them of 1 - 2 / valence, in 1/65536
  Index missing = 0;          ///< vertices of the face that are still missing, this one included
};

/// A missing vertex. In the dual of a mesh with holes it may stand for a dummy face.
struct VertexAnswer {
  Index valence = 0;  ///< 2 or more; 0: a split
  bool dummy = false;
};

/// A vertex that the region has already: one of its gaps, and how many of that gap's free slots remain on the side of
/// its leaving edge.
struct SplitAnswer {
  Index gap = kNone;
  Index slots_after = 0;
};

/// The angle of a regular polygon with `sides` sides, as a fraction of a half turn in 1/65536: 1 - 2 / sides.
inline int32_t flatAngle(Index sides) {
  constexpr auto kTable = [] {
    std::array<int32_t, 64> table{};
    for (int i = 1; i < 64; ++i) table[i] = 65536 - 131072 / i;
    return table;
  }();
  return sides < 64 ? kTable[sides] : 65536 - static_cast<int32_t>(131072 / sides);
}

/// Runs a script to a mesh. A Script offers
///   bool component()                                is there another component?
///   FaceAnswer face(const FaceQuestion&, const Gaps&)
///   VertexAnswer vertex(const VertexQuestion&, const Gaps&)
///   SplitAnswer split(const VertexQuestion&, const Gaps&)
///   Error fault()                                   why the input cannot go on; kNone while it can
/// and follows, where it stands on an input mesh, the position of the walk:
///   void seed()            before the first face of a component
///   void start(const Gap&) at the far end of the edge that leaves the gap, in the face outside
///   void step()            on to the next corner of the face
///   void cross(Gap&, Index gap)  the gap's leaving edge becomes the edge from the next corner back to this one
template <class Script>
class Walk {
 public:
  /// `least_degree`: 3, or 2 for a dual, where a valence of 2 is a degree.
  Walk(Script& script, TieRule tie, Index least_degree, const Limits& limits)
      : script_(script), gaps_(tie), least_degree_(least_degree), limits_(limits) {}

  /// Builds all components. O(corners). Fails only on damaged input or exceeded limits.
  Error run() {
    Error error = Error::kNone;
    while (error == Error::kNone && script_.component()) {
      error = seed();
      for (Index gap; error == Error::kNone && (gap = gaps_.first()) != kNone;) error = attach(gap);
    }
    mesh_.vertex_count = mesh_.umbrella_count;
    return error;
  }

  Connectivity& connectivity() { return mesh_; }
  Index splits() const { return splits_; }

  /// The umbrellas that stand for dummy faces.
  const std::vector<Index>& dummyUmbrellas() const { return dummy_umbrellas_; }

  /// Per umbrella: 1 when a dummy face touches it.
  const std::vector<uint8_t>& onBoundary() const { return on_boundary_; }

 private:
  // The first face of a component. All its vertices are new.
  Error seed() {
    gaps_.clear();
    script_.seed();
    question_ = {};
    question_.face = script_.face({}, gaps_);
    if (question_.face.dummy) return Error::kMalformed;
    if (const Error error = openFace(0); error != Error::kNone) return error;
    touched_.clear();
    question_.missing = question_.face.degree;
    before_valence_ = 0;
    current_is_new_ = false;
    Index current = kNone;
    while (question_.missing > 0) {
      const VertexAnswer vertex = script_.vertex(question_, gaps_);
      if (const Error fault = script_.fault(); fault != Error::kNone) return fault;
      if (vertex.valence == 0) return Error::kMalformed;
      if (const Error error = addVertex(vertex, current); error != Error::kNone) return error;
    }
    closeBoundary(touched_.front(), current, corner_ - 1);
    requeue();
    return Error::kNone;
  }

  // One more face, along the edge that leaves `start`.
  Error attach(Index start) {
    const Index second = gaps_[start].next;
    script_.start(gaps_[start]);
    question_ = {};
    ahead_.clear();
    behind_.clear();
    touched_.clear();
    if (!take(start) || !take(second)) return Error::kMalformed;
    Index head = start, tail = second;
    bool closed = false;
    if (!findEnds(head, tail, closed)) return Error::kMalformed;
    const Index edges = static_cast<Index>(1 + ahead_.size() + behind_.size());
    question_.face = script_.face({start, second, head, tail, edges, closed}, gaps_);
    if (const Error error = openFace(edges); error != Error::kNone) return error;
    if (closed != (question_.face.degree == edges)) return Error::kMalformed;
    emitKnown(start);
    for (const Index gap : ahead_) emitKnown(gap);
    if (!closed) {
      if (const Error error = fill(head, tail); error != Error::kNone) return error;
    }
    releaseUsed(start, head, closed);
    requeue();
    return pinched_ ? Error::kMalformed : Error::kNone;
  }

  // Follows the boundary both ways while the face uses up gaps. `ahead_` and `behind_` collect the gaps passed, whose
  // leaving edge belongs to the face, without `start` itself.
  bool findEnds(Index& head, Index& tail, bool& closed) {
    const Index start = head;
    while (gaps_[tail].free_slots == 0) {
      const Index next = gaps_[tail].next;
      ahead_.push_back(tail);
      if (next == start) return closed = true, gaps_[start].free_slots == 0;
      if (!take(next)) return false;
      tail = next;
      script_.step();
    }
    while (gaps_[head].free_slots == 0) {
      head = gaps_[head].prev;
      if (!take(head)) return false;
      behind_.push_back(head);
    }
    return true;
  }

  // The rest of a face that is not closed: the missing vertices from `tail` round to `head`.
  Error fill(Index head, Index tail) {
    question_.head = head;
    question_.current = tail;
    question_.before_tail = gaps_[tail].prev;
    const uint8_t after_head = capped(gaps_[gaps_[head].next].valence);
    before_valence_ = capped(gaps_[question_.before_tail].valence);
    current_is_new_ = false;
    touched_.push_back(tail);
    emit(tail);
    Index current = tail;
    question_.missing = question_.face.degree - static_cast<Index>(2 + ahead_.size() + behind_.size());
    while (question_.missing > 0) {
      const VertexAnswer vertex = script_.vertex(question_, gaps_);
      if (const Error fault = script_.fault(); fault != Error::kNone) return fault;
      const Error error = vertex.valence == 0 ? split(current) : addVertex(vertex, current);
      if (error != Error::kNone) return error;
    }
    if (gaps_[current].free_slots == 0) return Error::kMalformed;
    const Index last_corner = corner_ - 1;
    for (size_t i = behind_.size(); i-- > 0;) emitKnown(behind_[i]);
    if (current_is_new_) gaps_[current].opposite_own = capped(gaps_[head].valence);
    closeBoundary(head, current, last_corner);
    gaps_[head].opposite_own = after_head;
    touched_.push_back(head);
    return Error::kNone;
  }

  // A vertex that nobody knew; becomes `current`.
  Error addVertex(const VertexAnswer& vertex, Index& current) {
    if (mesh_.umbrella_count >= limits_.max_corners) return Error::kLimitExceeded;
    const Index gap = gaps_.create();
    Gap& record = gaps_[gap];
    record.umbrella = mesh_.umbrella_count++;
    record.valence = vertex.valence;
    record.free_slots = vertex.valence - 1;
    on_boundary_.push_back(0);
    if (current != kNone) linkBefore(current, gap);
    if (vertex.dummy) dummy_umbrellas_.push_back(record.umbrella);
    become(gap, current, true);
    find(vertex.valence);
    return Error::kNone;
  }

  // A vertex of the region; becomes `current`. Where it keeps no free slot on its far side, the face goes on along the
  // boundary.
  Error split(Index& current) {
    const SplitAnswer answer = script_.split(question_, gaps_);
    if (answer.gap >= gaps_.highWater() || !gaps_[answer.gap].queued) return Error::kMalformed;
    const Index slots = gaps_[answer.gap].free_slots;
    if (slots < 2 || answer.slots_after > slots - 2) return Error::kMalformed;
    ++splits_;
    const Index before = divide(answer);
    linkBefore(current, before);
    touched_.push_back(before);
    become(answer.gap, current, false);
    find(gaps_[current].valence);
    while (gaps_[current].free_slots == 0) {
      const Index next = gaps_[current].next;
      if (question_.missing == 0 || !take(next)) return Error::kMalformed;
      pairLast(gaps_[current].behind);
      gaps_.release(current);
      become(next, current, false);
      --question_.missing;
    }
    return Error::kNone;
  }

  // Cuts a gap in two around the slot that the face takes: a new one keeps the arriving edge, the old one the leaving.
  Index divide(const SplitAnswer& answer) {
    gaps_.dequeue(answer.gap);
    const Index before = gaps_.create();
    gaps_[before] = gaps_[answer.gap];
    gaps_[before].free_slots -= 1 + answer.slots_after;
    gaps_[gaps_[before].prev].next = before;
    gaps_[answer.gap].free_slots = answer.slots_after;
    return before;
  }

  void become(Index gap, Index& current, bool is_new) {
    script_.step();
    if (current != kNone) {
      if (current_is_new_) gaps_[current].opposite_own = capped(gaps_[gap].valence);
      before_valence_ = capped(gaps_[current].valence);
    }
    current_is_new_ = is_new;
    question_.current = gap;
    current = gap;
    touched_.push_back(gap);
    emit(gap);
  }

  // One missing vertex less.
  void find(Index valence) {
    know(valence);
    --question_.missing;
    ++question_.index;
  }

  void know(Index valence) {
    ++question_.known_vertices;
    question_.valence_sum += valence;
    question_.angle += flatAngle(valence);
  }

  // Uses a slot of a gap for the current face.
  bool take(Index gap) {
    if (!gaps_[gap].queued) return false;
    gaps_.dequeue(gap);
    --gaps_[gap].free_slots;
    know(gaps_[gap].valence);
    return true;
  }

  // The boundary now runs from `gap` to `current`; the face lies behind.
  void linkBefore(Index current, Index gap) { closeBoundary(gap, current, corner_ - 1); }

  void closeBoundary(Index gap, Index current, Index current_corner) {
    Gap& record = gaps_[gap];
    Gap& other = gaps_[current];
    record.next = current;
    other.prev = gap;
    record.opposite_next = before_valence_;
    meet(record, other.valence);
    meet(other, record.valence);
    record.behind = question_.face.dummy ? kNone : current_corner;
    record.degree_behind = question_.face.dummy ? 0 : question_.face.degree;
    script_.cross(record, gap);
  }

  static uint8_t capped(Index valence) { return static_cast<uint8_t>(valence < 14 ? valence : 14); }

  static void meet(Gap& gap, Index valence) {
    gap.neighbour_valences += valence < 200 ? valence : 200;
    ++gap.neighbours;
  }

  Error openFace(Index edges) {
    const FaceAnswer& face = question_.face;
    if (const Error fault = script_.fault(); fault != Error::kNone) return fault;
    if (face.degree < least_degree_ || face.degree < edges) return Error::kMalformed;
    // Every corner of a dummy face lies against a corner of the mesh.
    if (face.degree > limits_.max_corners - (face.dummy ? 0 : corner_)) return Error::kLimitExceeded;
    if (face.dummy) return Error::kNone;
    if (mesh_.face_degrees.size() >= limits_.max_faces) return Error::kLimitExceeded;
    mesh_.face_degrees.push_back(face.degree);
    return Error::kNone;
  }

  void emit(Index gap) {
    const Index umbrella = gaps_[gap].umbrella;
    if (question_.face.dummy) {
      pinched_ |= on_boundary_[umbrella];
      on_boundary_[umbrella] = 1;
      return;
    }
    mesh_.umbrellas.push_back(umbrella);
    mesh_.twins.push_back(kNone);
    ++corner_;
  }

  void emitKnown(Index gap) {
    emit(gap);
    pairLast(gaps_[gap].behind);
  }

  // The last corner's edge is the other side of the edge of `corner`.
  void pairLast(Index corner) {
    if (question_.face.dummy || corner == kNone) return;
    mesh_.twins[corner_ - 1] = corner;
    mesh_.twins[corner] = corner_ - 1;
  }

  void releaseUsed(Index start, Index head, bool closed) {
    if (start != head || closed) gaps_.release(start);
    for (const Index gap : ahead_) gaps_.release(gap);
    for (const Index gap : behind_) {
      if (gap != head) gaps_.release(gap);
    }
  }

  void requeue() {
    const bool dummy = question_.face.dummy;
    const uint32_t angle = dummy ? 0 : static_cast<uint32_t>(flatAngle(question_.face.degree));
    for (const Index gap : touched_) {
      Gap& record = gaps_[gap];
      if (record.free_slots == 0 || record.queued) continue;
      record.angle += angle;
      record.dummy |= dummy;
      gaps_.enqueue(gap);
    }
  }

  Script& script_;
  Gaps gaps_;
  Index least_degree_;
  Limits limits_;
  Connectivity mesh_;
  std::vector<uint8_t> on_boundary_;
  std::vector<Index> dummy_umbrellas_;
  VertexQuestion question_;
  std::vector<Index> ahead_, behind_;  // gaps that the current face uses up
  std::vector<Index> touched_;         // gaps of the current face that may go on, in the order of their queueing
  Index corner_ = 0;                   // corners coded so far
  uint8_t before_valence_ = 0;         // of the vertex before the current one in the current face, up to 14
  bool current_is_new_ = false;        // the current vertex's leaving edge belongs to the current face
  bool pinched_ = false;               // two dummy faces, or one twice, touch an umbrella: never in a valid stream
  Index splits_ = 0;
};

}  // namespace tutte
