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

#include <algorithm>
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
///   void start(Index gap)  at the far end of the edge that leaves the gap, in the face outside
///   void step()            on to the next corner of the face
///   void cross(Index gap)  the gap's leaving edge becomes the edge from the next corner back to this one
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
      while (error == Error::kNone && !finished()) error = attach();
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
  // The face that is being attached, while it is. Always a local variable whose address nobody outside keeps, so that
  // the inner loop has its fields in registers.
  struct Face {
    FaceAnswer answer;
    Index start = kNone, second = kNone;  // where it is attached
    Index head = kNone, tail = kNone;     // where its part on the boundary ends
    Index edges = 0;                      // known ones
    bool closed = false;                  // they are all
    Index missing = 0;                    // vertices
    Index found = 0;                      // missing vertices that were told
    Index current = kNone;                // the vertex before the next missing one
    Index before_tail = kNone;
    Index stretch = kNone;        // where the face's stretch of the boundary begins, a split's rest if there was one
    uint16_t before_current = 0;  // valence, up to 14, of the vertex before the current one in the face
    bool is_new = false;          // the current vertex's leaving edge belongs to the face
    uint64_t valence_sum = 0;
    int64_t angle = 0;
    Index first_corner = 0, corner = 0;  // of the face, and the next one
    Error error = Error::kNone;

    VertexQuestion question() const { return {answer, head, current, before_tail, found, missing, valence_sum, angle}; }
  };

  // The first face of a component. All its vertices are new.
  Error seed() {
    gaps_.clear();
    script_.seed();
    Face face;
    face.answer = script_.face({}, gaps_);
    if (face.answer.dummy) return Error::kMalformed;
    if (!open(face)) return face.error;
    face.missing = face.answer.degree;
    while (face.missing > 0) {
      const VertexAnswer vertex = script_.vertex(face.question(), gaps_);
      if (vertex.valence == 0) return Error::kMalformed;
      if (!addVertex(vertex, face)) return face.error;
      if (face.stretch == kNone) face.stretch = face.current;
    }
    closeBoundary(face.stretch, face.current, face.corner - 1, face);
    leave(face.stretch, face.current, face.answer);
    corners_.setSize(face.corner);
    return Error::kNone;
  }

  // No boundary is left.
  bool finished() { return last_.head == kNone && gaps_.lowestList() == Gaps::kLists; }

  // One more face.
  Error attach() {
    Face face;
    if (!choose(face)) return Error::kMalformed;
    const Index start = face.start;
    script_.start(start);
    face.edges = 1;
    use(gaps_[start], face);
    use(gaps_[face.second], face);
    if (!reachOut(face)) return Error::kMalformed;
    face.answer = script_.face({start, face.second, face.head, face.tail, face.edges, face.closed}, gaps_);
    if (!open(face)) return face.error;
    const Index stop = face.closed ? start : face.tail;
    emitKnown(gaps_[start], face);
    for (Index gap = face.second; gap != stop; gap = gaps_[gap].next) emitKnown(gaps_[gap], face);
    if (!face.closed && !fill(face)) return face.error;
    release(face, stop);
    corners_.setSize(face.corner);
    return Error::kNone;
  }

  // Where the face is attached: mostly where the last one ended, and then two of its gaps need not be queued at all.
  [[gnu::always_inline]] bool choose(Face& face) {
    const Left left = last_;
    last_.head = kNone;
    const Index list = gaps_.lowestList();
    const bool go_on = left.head != kNone && gaps_.comesFirst(left.list, list);
    if (go_on) {
      face.start = left.head;
      face.second = gaps_[left.head].next;
      for (Index gap = left.tail; gap != face.second; gap = gaps_[gap].prev) gaps_.enqueue(gap);
    } else {
      if (left.head != kNone) requeue(left.tail, left.head);
      face.start = gaps_.pop(gaps_.lowestList());
      face.second = gaps_[face.start].next;
      if (!gaps_[face.second].queued) return false;
      gaps_.dequeue(face.second);
    }
    face.head = face.start;
    face.tail = face.second;
    return true;
  }

  // Follows the boundary both ways while the face uses up gaps.
  [[gnu::always_inline]] bool reachOut(Face& face) {
    while (gaps_[face.tail].free_slots == 0) {
      ++face.edges;
      const Index next = gaps_[face.tail].next;
      if (next == face.start) {
        face.closed = true;
        return gaps_[next].free_slots == 0;
      }
      if (!take(next, face)) return false;
      face.tail = next;
      script_.step();
    }
    while (gaps_[face.head].free_slots == 0) {
      ++face.edges;
      face.head = gaps_[face.head].prev;
      if (!take(face.head, face)) return false;
    }
    return true;
  }

  // The rest of a face that is not closed: the missing vertices from its tail round to its head.
  [[gnu::always_inline]] bool fill(Face& face) {
    face.current = face.stretch = face.tail;
    face.before_tail = gaps_[face.tail].prev;
    face.missing = face.answer.degree - face.edges - 1;
    const Index splits = splits_;
    const uint16_t after_head = Script::kGathers ? gaps_[gaps_[face.head].next].capped : uint16_t{0};
    if (Script::kGathers) face.before_current = gaps_[face.before_tail].capped;
    emit(gaps_[face.tail], face);
    while (face.missing > 0) {
      const VertexAnswer vertex = script_.vertex(face.question(), gaps_);
      if (vertex.valence == 0) face = split(face);
      if (vertex.valence == 0 ? face.error != Error::kNone : !addVertex(vertex, face)) return false;
    }
    const Index last_corner = face.corner - 1;
    for (Index gap = face.head; gap != face.start; gap = gaps_[gap].next) emitKnown(gaps_[gap], face);
    Gap &head = gaps_[face.head], &last = gaps_[face.current];
    face.error = Error::kMalformed;
    if (last.free_slots == 0 || pinched_) return false;
    if (Script::kGathers && face.is_new) last.opposite_own = head.capped;
    closeBoundary(face.head, face.current, last_corner, face);
    if (Script::kGathers) head.opposite_own = after_head;
    if (splits_ != splits && !finishSplits(face)) return false;
    leave(face.stretch, face.head, face.answer);
    return true;
  }

  // The gaps that the face used up. `stop`: where those after the start end.
  [[gnu::always_inline]] void release(const Face& face, Index stop) {
    if (face.start != face.head || face.closed) gaps_.release(face.start);
    for (Index gap = face.second; gap != stop;) {
      const Index next = gaps_[gap].next;
      gaps_.release(gap);
      gap = next;
    }
    if (face.start == face.head) return;
    for (Index gap = gaps_[face.start].prev; gap != face.head; gap = gaps_[gap].prev) gaps_.release(gap);
  }

  // A vertex that nobody knew; becomes the current one.
  [[gnu::always_inline]] bool addVertex(const VertexAnswer& vertex, Face& face) {
    face.error = script_.fault();
    if (face.error != Error::kNone) return false;
    face.error = Error::kLimitExceeded;
    if (umbrellas_ >= limits_.max_corners) return false;
    const Index gap = gaps_.create();
    Gap& record = gaps_[gap];
    record.umbrella = static_cast<Index>(umbrellas_++);
    record.valence = vertex.valence;
    record.free_slots = vertex.valence - 1;
    record.flat = flatAngle(vertex.valence);
    record.capped = static_cast<uint16_t>(std::min(vertex.valence, Index{14}));
    if (face.current != kNone) closeBoundary(gap, face.current, face.corner - 1, face);
    if (vertex.dummy) dummy_umbrellas_.push_back(record.umbrella);
    become(gap, face, true);
    --face.missing;
    ++face.found;
    know(record, face);
    return true;
  }

  // A vertex of the region; becomes the current one. Where it keeps no free slot on its far side, the face goes on
  // along the boundary.
  [[gnu::noinline]] Face split(Face face) {
    const SplitAnswer answer = script_.split(face.question(), gaps_);
    face.error = script_.fault();
    if (face.error != Error::kNone) return face;
    face.error = Error::kMalformed;
    if (answer.gap >= gaps_.highWater() || !gaps_[answer.gap].queued) return face;
    const Index slots = gaps_[answer.gap].free_slots;
    if (slots < 2 || answer.slots_after > slots - 2) return face;
    ++splits_;
    const Index before = divide(answer);
    closeBoundary(before, face.current, face.corner - 1, face);
    segments_.push_back({face.stretch, before});
    become(answer.gap, face, false);
    --face.missing;
    ++face.found;
    know(gaps_[face.current], face);
    while (gaps_[face.current].free_slots == 0) {
      const Index used = face.current, next = gaps_[used].next;
      if (face.missing == 0 || !take(next, face)) return face;
      pairLast(gaps_[used].behind, face);
      gaps_.release(used);
      become(next, face, false);
      --face.missing;
    }
    face.stretch = face.current;
    face.error = Error::kNone;
    return face;
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
  [[gnu::noinline]] bool finishSplits(const Face face) {
    for (const Segment& segment : segments_)
      gather(segment.tail, segment.head, face.answer), requeue(segment.tail, segment.head);
    segments_.clear();
    last_face_.resize(umbrellas_, kNone);
    for (Index corner = face.first_corner; corner < face.corner; ++corner) {
      Index& last = last_face_[corners_.umbrellas()[corner]];
      if (last == degrees_.size()) return false;
      last = degrees_.size();
    }
    return true;
  }

  [[gnu::always_inline]] void become(Index gap, Face& face, bool is_new) {
    script_.step();
    const Gap& record = gaps_[gap];
    if (Script::kGathers && face.current != kNone) {
      Gap& before = gaps_[face.current];
      if (face.is_new) before.opposite_own = record.capped;
      face.before_current = before.capped;
    }
    face.is_new = is_new;
    face.current = gap;
    corners_.makeRoom(face.corner + face.edges + 2);
    emit(record, face);
  }

  [[gnu::always_inline]] static void know(const Gap& gap, Face& face) {
    face.valence_sum += gap.valence;
    face.angle += gap.flat;
  }

  // Uses a slot of a gap for the current face.
  [[gnu::always_inline]] bool take(Index gap, Face& face) {
    if (!gaps_[gap].queued) return false;
    gaps_.dequeue(gap);
    use(gaps_[gap], face);
    return true;
  }

  [[gnu::always_inline]] static void use(Gap& gap, Face& face) {
    --gap.free_slots;
    know(gap, face);
  }

  // The boundary now runs from `gap` to `next`; the face lies behind, in which next has the corner `next_corner`.
  [[gnu::always_inline]] void closeBoundary(Index gap, Index next, Index next_corner, const Face& face) {
    Gap& record = gaps_[gap];
    Gap& other = gaps_[next];
    record.next = next;
    other.prev = gap;
    record.behind = face.answer.dummy ? kNone : next_corner;
    record.degree_behind = face.answer.dummy ? 0 : face.answer.degree;
    if (Script::kGathers) {
      record.opposite_next = face.before_current;
      record.met += (uint64_t{1} << 32) + other.valence;
      other.met += (uint64_t{1} << 32) + record.valence;
    }
    script_.cross(gap);
  }

  // Checks the answer, and begins the face.
  [[gnu::always_inline]] bool open(Face& face) {
    const FaceAnswer& answer = face.answer;
    face.error = script_.fault();
    if (face.error != Error::kNone) return false;
    face.error = Error::kMalformed;
    if (answer.degree < least_degree_ || answer.degree < face.edges) return false;
    if (face.closed != (answer.degree == face.edges)) return false;
    face.error = Error::kLimitExceeded;
    face.first_corner = face.corner = corners_.size();
    // Every corner of a dummy face lies against a corner of the mesh.
    if (answer.degree > limits_.max_corners - (answer.dummy ? 0 : face.corner)) return false;
    corners_.makeRoom(face.corner + face.edges + 2);
    if (answer.dummy) return true;
    if (degrees_.size() >= limits_.max_faces) return false;
    degrees_.add(answer.degree);
    return true;
  }

  [[gnu::always_inline]] void emit(const Gap& gap, Face& face) {
    if (face.answer.dummy) {
      touchBoundary(gap.umbrella);
    } else {
      corners_.umbrellas()[face.corner++] = gap.umbrella;
    }
  }

  [[gnu::noinline]] void touchBoundary(Index umbrella) {
    if (umbrella >= on_boundary_.size()) on_boundary_.resize(umbrellas_);
    pinched_ |= on_boundary_[umbrella];
    on_boundary_[umbrella] = 1;
  }

  [[gnu::always_inline]] void emitKnown(const Gap& gap, Face& face) {
    emit(gap, face);
    pairLast(gap.behind, face);
  }

  // The last corner's edge is the other side of the edge of `corner`.
  [[gnu::always_inline]] void pairLast(Index corner, const Face& face) {
    if (face.answer.dummy || corner == kNone) return;
    corners_.twins()[face.corner - 1] = corner;
    corners_.twins()[corner] = face.corner - 1;
  }

  // Ends a face that leaves the boundary from `tail` back to `head`.
  [[gnu::always_inline]] void leave(Index tail, Index head, const FaceAnswer& face) {
    const Index others = gather(tail, head, face), list = Gaps::listOf(gaps_[head].free_slots);
    last_ = {tail, head, list};
    if (gaps_.comesFirst(list, others)) return;
    requeue(tail, head);
    last_.head = kNone;
  }

  // Notes the face in the gaps from `tail` back to `head`. Returns the lowest list of all but head.
  [[gnu::always_inline]] Index gather(Index tail, Index head, const FaceAnswer& face) {
    const uint32_t angle = face.dummy ? 0 : static_cast<uint32_t>(flatAngle(face.degree));
    Index least = Gaps::kLists;
    for (Index gap = tail;; gap = gaps_[gap].prev) {
      Gap& record = gaps_[gap];
      if (Script::kGathers) record.angle += angle;
      if (face.dummy) record.dummy = true;
      if (gap == head) return least;
      least = std::min(least, Gaps::listOf(record.free_slots));
    }
  }

  [[gnu::always_inline]] void requeue(Index tail, Index head) {
    for (Index gap = tail;; gap = gaps_[gap].prev) {
      gaps_.enqueue(gap);
      if (gap == head) return;
    }
  }

  // What the last face left of the boundary, when that is not queued yet.
  struct Left {
    Index tail = kNone, head = kNone;
    Index list = 0;  // which the head would join, and come before all others
  };

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
  std::vector<Index> last_face_;  // per umbrella, as far as there were splits: the last face with splits, plus 1
  Left last_;
  std::vector<Segment> segments_;  // of the current face
  size_t umbrellas_ = 0;
  bool pinched_ = false;  // two dummy faces, or one twice, touch an umbrella: never in a valid stream
  Index splits_ = 0;
};

}  // namespace tutte
