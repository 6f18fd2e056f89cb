#pragma once
// The boundary of the processed region while a face is attached to it: what the walk is made of.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "codec/appender.h"
#include "codec/gaps.h"
#include "codec/mesh.h"
#include "codec/questions.h"
#include "codec/result.h"

namespace tutte {

/// The moves of the walk that know no symbols. For `Script` see Walk.
template <class Script>
class Boundary {
 public:
  /// Per umbrella: 1 when a dummy face touches it.
  const std::vector<uint8_t>& onBoundary() const { return on_boundary_; }

 protected:
  Boundary(Script& script, TieRule tie, size_t expected_corners)
      : script_(script), gaps_(tie), corners_(mesh_, expected_corners) {}

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

    VertexQuestion question() const {
      return {answer.degree, answer.dummy, head, current, before_tail, found, missing, valence_sum, angle};
    }
  };

  // No boundary is left.
  bool finished() { return last_.head == kNone && gaps_.lowestList() == Gaps::kLists; }

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

  Script& script_;
  Gaps gaps_;
  Connectivity mesh_;
  CornerAppender corners_;            // of the mesh
  std::vector<uint8_t> on_boundary_;  // as far as a dummy face was met
  size_t umbrellas_ = 0;              // not an Index, as in Gaps
  bool pinched_ = false;              // two dummy faces, or one twice, touch an umbrella: never in a valid stream

 private:
  Left last_;
};

}  // namespace tutte
