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

#include "codec/appender.h"
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
  Index missing = 0;          ///< vertices of the face that are still missing, this one included
  uint64_t valence_sum = 0;   ///< sum of the valences of those that are known
  int64_t angle = 0;          ///< sum over them of 1 - 2 / valence, in 1/65536

  Index knownVertices() const { return face.degree - missing; }
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

inline constexpr std::array<int32_t, 64> kFlatAngles = [] {
  std::array<int32_t, 64> table{};
  for (int i = 1; i < 64; ++i) table[i] = 65536 - 131072 / i;
  return table;
}();

/// The angle of a regular polygon with `sides` sides, as a fraction of a half turn in 1/65536: 1 - 2 / sides.
inline int32_t flatAngle(Index sides) {
  return sides < kFlatAngles.size() ? kFlatAngles[sides] : 65536 - static_cast<int32_t>(131072 / sides);
}

/// Runs a script to a mesh. A Script offers
///   bool component()                                is there another component?
///   FaceAnswer face(const FaceQuestion&, const Gaps&)
///   VertexAnswer vertex(const VertexQuestion&, const Gaps&)
///   SplitAnswer split(const VertexQuestion&, const Gaps&)
///   static constexpr bool kGathers                  do its answers depend on what Gap gathers of the surroundings?
///   Error fault()                                   why the input cannot go on; kNone while it can
/// and follows, where it stands on an input mesh, the position of the walk:
///   void seed()            before the first face of a component
///   void start(const Gap&) at the far end of the edge that leaves the gap, in the face outside
///   void step()            on to the next corner of the face
///   void cross(Gap&, Index gap)  the gap's leaving edge becomes the edge from the next corner back to this one
template <class Script>
class Walk {
 public:
  /// `least_degree`: 3, or 2 for a dual, where a valence of 2 is a degree. `expected_corners`: room that is reserved
  /// at once; there may be more or less.
  Walk(Script& script, TieRule tie, Index least_degree, const Limits& limits, size_t expected_corners)
      : script_(script),
        gaps_(tie),
        least_degree_(least_degree),
        limits_(limits),
        degrees_(mesh_.face_degrees, expected_corners / 3),
        corners_(mesh_, expected_corners) {}
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  /// Builds all components. O(corners). Fails only on damaged input or exceeded limits.
  Error run() {
    Error error = Error::kNone;
    while (error == Error::kNone && script_.component()) {
      error = seed();
      for (Index gap; error == Error::kNone && (gap = gaps_.pop()) != kNone;) error = attach(gap);
    }
    degrees_.finish();
    corners_.finish();
    on_boundary_.resize(umbrellas_);
    mesh_.vertex_count = mesh_.umbrella_count = static_cast<Index>(umbrellas_);
    return error;
  }

  Connectivity& connectivity() { return mesh_; }
  Index splits() const { return splits_; }

  /// The umbrellas that stand for dummy faces.
  const std::vector<Index>& dummyUmbrellas() const { return dummy_umbrellas_; }

  /// Per umbrella: 1 when a dummy face touches it.
  const std::vector<uint8_t>& onBoundary() const { return on_boundary_; }

 private:
  // The face that is being attached, while it is. A local variable: the inner loop keeps its fields in registers.
  struct Current {
    VertexQuestion question;
    Index tail = kNone;           // where the face's stretch of the boundary begins, a split's rest if there was one
    uint16_t before_valence = 0;  // of the vertex before question.current in the face, up to 14
    bool is_new = false;          // question.current's leaving edge belongs to the face
    Error error = Error::kNone;
  };

  // The first face of a component. All its vertices are new.
  Error seed() {
    gaps_.clear();
    script_.seed();
    Current current;
    const FaceAnswer face = script_.face({}, gaps_);
    if (face.dummy) return Error::kMalformed;
    if (const Error error = openFace(face, 0); error != Error::kNone) return error;
    current.question.face = face;
    current.question.missing = face.degree;
    while (current.question.missing > 0) {
      const VertexAnswer vertex = script_.vertex(current.question, gaps_);
      if (const Error error = addVertex(vertex, current); error != Error::kNone) return error;
      if (current.tail == kNone) current.tail = current.question.current;
    }
    closeBoundary(current.tail, current.question.current, corners_.size() - 1, current.before_valence, face);
    requeue(current.tail, current.question.current, face);
    return Error::kNone;
  }

  // One more face, along the edge that leaves `start`, which is out of the queue.
  Error attach(const Index start) {
    script_.start(gaps_[start]);
    Current current;
    const Index second = gaps_[start].next;
    --gaps_[start].free_slots;
    know(gaps_[start], current);
    if (!take(second, current)) return Error::kMalformed;
    Index head = start, tail = second, edges = 1;
    bool closed = false;
    while (gaps_[tail].free_slots == 0) {
      ++edges;
      const Index next = gaps_[tail].next;
      if (next == start) {
        closed = true;
        break;
      }
      if (!take(next, current)) return Error::kMalformed;
      tail = next;
      script_.step();
    }
    while (!closed && gaps_[head].free_slots == 0) {
      ++edges;
      head = gaps_[head].prev;
      if (!take(head, current)) return Error::kMalformed;
    }
    const FaceAnswer face = script_.face({start, second, head, tail, edges, closed}, gaps_);
    if (const Error error = openFace(face, edges); error != Error::kNone) return error;
    if (closed != (face.degree == edges)) return Error::kMalformed;
    const Index first_corner = corners_.size(), splits = splits_, stop = closed ? start : tail;
    emitKnown(start, face);
    for (Index gap = second; gap != stop; gap = gaps_[gap].next) emitKnown(gap, face);
    if (closed) {
      if (gaps_[start].free_slots != 0) return Error::kMalformed;
      gaps_.release(start);
    } else {
      VertexQuestion& question = current.question;
      question.face = face;
      question.head = head;
      question.current = current.tail = tail;
      question.before_tail = gaps_[tail].prev;
      question.missing = face.degree - edges - 1;
      const uint16_t after_head = capped(gaps_[gaps_[head].next].valence);
      current.before_valence = capped(gaps_[question.before_tail].valence);
      emit(gaps_[tail], face);
      while (question.missing > 0) {
        const VertexAnswer vertex = script_.vertex(question, gaps_);
        if (vertex.valence != 0) {
          if (const Error error = addVertex(vertex, current); error != Error::kNone) return error;
        } else {
          current = split(current);
          if (current.error != Error::kNone) return current.error;
        }
      }
      const Index last_corner = corners_.size() - 1;
      for (Index gap = head; gap != start; gap = gaps_[gap].next) emitKnown(gap, face);
      Gap& last = gaps_[question.current];
      if (last.free_slots == 0) return Error::kMalformed;
      if (Script::kGathers && current.is_new) last.opposite_own = capped(gaps_[head].valence);
      closeBoundary(head, question.current, last_corner, current.before_valence, face);
      if (Script::kGathers) gaps_[head].opposite_own = after_head;
      if (splits_ != splits && !finishSplits(first_corner, face)) return Error::kMalformed;
      requeue(current.tail, head, face);
      if (start != head) gaps_.release(start);
    }
    for (Index gap = second; gap != stop;) {
      const Index next = gaps_[gap].next;
      gaps_.release(gap);
      gap = next;
    }
    if (start != head) {
      for (Index gap = gaps_[start].prev; gap != head; gap = gaps_[gap].prev) gaps_.release(gap);
    }
    return pinched_ ? Error::kMalformed : Error::kNone;
  }

  // A vertex that nobody knew; becomes the current one.
  Error addVertex(const VertexAnswer& vertex, Current& current) {
    if (const Error fault = script_.fault(); fault != Error::kNone) return fault;
    if (vertex.valence == 0) return Error::kMalformed;
    if (umbrellas_ >= limits_.max_corners) return Error::kLimitExceeded;
    const Index gap = gaps_.create();
    Gap& record = gaps_[gap];
    record.umbrella = static_cast<Index>(umbrellas_++);
    record.valence = vertex.valence;
    record.free_slots = vertex.valence - 1;
    record.flat = flatAngle(vertex.valence);
    VertexQuestion& question = current.question;
    if (question.current != kNone) {
      closeBoundary(gap, question.current, corners_.size() - 1, current.before_valence, question.face);
    }
    if (vertex.dummy) dummy_umbrellas_.push_back(record.umbrella);
    become(gap, current, true);
    --question.missing;
    ++question.index;
    know(record, current);
    return Error::kNone;
  }

  // A vertex of the region; becomes the current one. Where it keeps no free slot on its far side, the face goes on
  // along the boundary.
  [[gnu::noinline]] Current split(Current current) {
    VertexQuestion& question = current.question;
    const SplitAnswer answer = script_.split(question, gaps_);
    current.error = script_.fault();
    if (current.error != Error::kNone) return current;
    current.error = Error::kMalformed;
    if (answer.gap >= gaps_.highWater() || !gaps_[answer.gap].queued) return current;
    const Index slots = gaps_[answer.gap].free_slots;
    if (slots < 2 || answer.slots_after > slots - 2) return current;
    ++splits_;
    const Index before = divide(answer);
    closeBoundary(before, question.current, corners_.size() - 1, current.before_valence, question.face);
    segments_.push_back({current.tail, before});
    become(answer.gap, current, false);
    --question.missing;
    ++question.index;
    know(gaps_[question.current], current);
    while (gaps_[question.current].free_slots == 0) {
      const Index used = question.current, next = gaps_[used].next;
      if (question.missing == 0 || !take(next, current)) return current;
      pairLast(gaps_[used].behind, question.face);
      gaps_.release(used);
      become(next, current, false);
      --question.missing;
    }
    current.tail = question.current;
    current.error = Error::kNone;
    return current;
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

  // After a face with splits. False: it visits an umbrella twice, which no encoder writes.
  [[gnu::noinline]] bool finishSplits(Index first_corner, const FaceAnswer& face) {
    for (const Segment& segment : segments_) requeue(segment.tail, segment.head, face);
    segments_.clear();
    last_face_.resize(umbrellas_, kNone);
    for (Index corner = first_corner; corner < corners_.size(); ++corner) {
      Index& last = last_face_[corners_.umbrella(corner)];
      if (last == degrees_.size()) return false;
      last = degrees_.size();
    }
    return true;
  }

  void become(Index gap, Current& current, bool is_new) {
    script_.step();
    const Gap& record = gaps_[gap];
    if (Script::kGathers && current.question.current != kNone) {
      Gap& before = gaps_[current.question.current];
      if (current.is_new) before.opposite_own = capped(record.valence);
      current.before_valence = capped(before.valence);
    }
    current.is_new = is_new;
    current.question.current = gap;
    emit(record, current.question.face);
  }

  static void know(const Gap& gap, Current& current) {
    current.question.valence_sum += gap.valence;
    current.question.angle += gap.flat;
  }

  // Uses a slot of a gap for the current face.
  bool take(Index gap, Current& current) {
    Gap& record = gaps_[gap];
    if (!record.queued) return false;
    gaps_.dequeue(gap);
    --record.free_slots;
    know(record, current);
    return true;
  }

  // The boundary now runs from `gap` to `next`; the face lies behind, in which next has the corner `next_corner`.
  void closeBoundary(Index gap, Index next, Index next_corner, uint16_t before_valence, const FaceAnswer& face) {
    Gap& record = gaps_[gap];
    Gap& other = gaps_[next];
    record.next = next;
    other.prev = gap;
    record.behind = face.dummy ? kNone : next_corner;
    record.degree_behind = face.dummy ? 0 : face.degree;
    if (Script::kGathers) {
      record.opposite_next = before_valence;
      meet(record, other.valence);
      meet(other, record.valence);
    }
    script_.cross(record, gap);
  }

  static uint16_t capped(Index valence) { return static_cast<uint16_t>(valence < 14 ? valence : 14); }

  static void meet(Gap& gap, Index valence) {
    gap.neighbour_valences += valence < 200 ? valence : 200;
    ++gap.neighbours;
  }

  Error openFace(const FaceAnswer& face, Index edges) {
    if (const Error fault = script_.fault(); fault != Error::kNone) return fault;
    if (face.degree < least_degree_ || face.degree < edges) return Error::kMalformed;
    // Every corner of a dummy face lies against a corner of the mesh.
    if (face.degree > limits_.max_corners - (face.dummy ? 0 : corners_.size())) return Error::kLimitExceeded;
    if (face.dummy) return Error::kNone;
    if (degrees_.size() >= limits_.max_faces) return Error::kLimitExceeded;
    degrees_.add(face.degree);
    return Error::kNone;
  }

  void emit(const Gap& gap, const FaceAnswer& face) {
    if (face.dummy) {
      touchBoundary(gap.umbrella);
    } else {
      corners_.add(gap.umbrella);
    }
  }

  [[gnu::noinline]] void touchBoundary(Index umbrella) {
    if (umbrella >= on_boundary_.size()) on_boundary_.resize(umbrellas_);
    pinched_ |= on_boundary_[umbrella];
    on_boundary_[umbrella] = 1;
  }

  void emitKnown(Index gap, const FaceAnswer& face) {
    const Gap& record = gaps_[gap];
    emit(record, face);
    pairLast(record.behind, face);
  }

  // The last corner's edge is the other side of the edge of `corner`.
  void pairLast(Index corner, const FaceAnswer& face) {
    if (!face.dummy && corner != kNone) corners_.pairLast(corner);
  }

  // Queues the gaps of the boundary from `tail` back to `head`, along the current face.
  void requeue(Index tail, Index head, const FaceAnswer& face) {
    const uint32_t angle = face.dummy ? 0 : static_cast<uint32_t>(flatAngle(face.degree));
    for (Index gap = tail;; gap = gaps_[gap].prev) {
      Gap& record = gaps_[gap];
      if (Script::kGathers) record.angle += angle;
      if (face.dummy) record.dummy = true;
      gaps_.enqueue(gap);
      if (gap == head) return;
    }
  }

  // A stretch of the boundary along the current face, from a split back.
  struct Segment {
    Index tail, head;
  };

  Script& script_;
  Gaps gaps_;
  Index least_degree_;
  Limits limits_;
  Connectivity mesh_;
  Appender degrees_;                  // of the mesh
  CornerAppender corners_;            // likewise
  std::vector<uint8_t> on_boundary_;  // as far as a dummy face was met
  std::vector<Index> dummy_umbrellas_;
  std::vector<Index> last_face_;   // per umbrella, as far as there were splits: the last face with splits, plus 1
  std::vector<Segment> segments_;  // of the current face
  size_t umbrellas_ = 0;
  bool pinched_ = false;  // two dummy faces, or one twice, touch an umbrella: never in a valid stream
  Index splits_ = 0;
};

}  // namespace tutte
