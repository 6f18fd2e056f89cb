#pragma once
// The boundary of the processed region while a face is attached to it: what the walk is made of.

#include <algorithm>
#include <cstdint>
#include <utility>
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
  std::vector<uint8_t> onBoundary() && { return std::move(on_boundary_); }

 protected:
  Boundary(Script& script, TieRule tie, size_t expected_corners)
      : script_(script), gaps_(tie), corners_(mesh_, expected_corners) {}

  // The face that is being attached, while it is. Always a local variable whose address nobody outside keeps, so that
  // the inner loop has its fields in registers.
  struct Face {
    FaceAnswer answer;
    Gap *start, *second;  // where it is attached
    Gap *head, *tail;     // where its part on the boundary ends
    Index edges = 0;      // known ones
    bool closed = false;  // they are all
    Index missing = 0;    // vertices
    Index found = 0;      // missing vertices that were told
    Gap* current;         // the vertex before the next missing one
    Gap* before_tail;
    Gap* stretch;                // where the face's stretch of the boundary begins, a split's rest if there was one
    uint8_t before_current = 0;  // valence, up to 14, of the vertex before the current one in the face
    bool is_new = false;         // the current vertex's leaving edge belongs to the face
    uint64_t valence_sum = 0;
    int64_t angle = 0;
    Index first_corner, corner;  // of the face, and the next one
    Error error = Error::kNone;

    // Gaps that a seed does not have are null; other faces tell them as they go.
    Face() {}
    static Face seed() {
      Face face;
      face.start = face.second = face.head = face.tail = face.current = face.before_tail = face.stretch = nullptr;
      return face;
    }

    VertexQuestion question() const {
      return {answer.degree, answer.dummy, head, current, before_tail, found, missing, valence_sum, angle};
    }
  };

  // Where the face is attached: mostly where the last one ended, and then two of its gaps need not be queued at all.
  // False: no boundary is left, or it is damaged.
  [[gnu::always_inline]] bool choose(Face& face) {
    const Left left = last_;
    last_.head = nullptr;
    Index list = gaps_.lowestList();
    if (left.head != nullptr && gaps_.comesFirst(left.list, list)) {
      face.start = left.head;
      face.second = left.head->next;
      for (Gap* gap = left.tail; gap != face.second; gap = gap->prev) gaps_.enqueue(*gap);
    } else {
      if (left.head != nullptr) requeue(left.tail, left.head), list = gaps_.lowestList();
      if (list == Gaps::kLists) return false;
      face.start = &gaps_.pop(list);
      face.second = face.start->next;
      face.error = Error::kMalformed;
      if (!face.second->queued) return false;
      gaps_.dequeue(*face.second);
    }
    face.head = face.start;
    face.tail = face.second;
    return true;
  }

  // Follows the boundary both ways while the face uses up gaps.
  [[gnu::always_inline]] bool reachOut(Face& face) {
    while (face.tail->free_slots == 0) {
      ++face.edges;
      Gap* const next = face.tail->next;
      if (next == face.start) {
        face.closed = true;
        return next->free_slots == 0;
      }
      if (!take(*next, face)) return false;
      face.tail = next;
      script_.step();
    }
    while (face.head->free_slots == 0) {
      ++face.edges;
      face.head = face.head->prev;
      if (!take(*face.head, face)) return false;
    }
    return true;
  }

  // The gaps that the face used up. `stop`: where those after the start end.
  [[gnu::always_inline]] void release(const Face& face, const Gap* stop) {
    if (face.start != face.head || face.closed) gaps_.release(*face.start);
    for (Gap* gap = face.second; gap != stop;) {
      Gap* const next = gap->next;
      gaps_.release(*gap);
      gap = next;
    }
    if (face.start == face.head) return;
    for (Gap* gap = face.start->prev; gap != face.head; gap = gap->prev) gaps_.release(*gap);
  }

  [[gnu::always_inline]] void become(Gap& gap, Face& face, bool is_new) {
    script_.step();
    if (Script::kGathers && face.current != nullptr) {
      if (face.is_new) face.current->opposite_own = gap.capped;
      face.before_current = face.current->capped;
    }
    face.is_new = is_new;
    face.current = &gap;
    if (face.answer.degree > kRoom) corners_.makeRoom(face.corner + face.edges + 2);
    emit(gap, face);
  }

  [[gnu::always_inline]] static void know(const Gap& gap, Face& face) {
    if (Script::kSums) face.valence_sum += gap.valence;
    face.angle += gap.flat;
  }

  // Uses a slot of a gap for the current face.
  [[gnu::always_inline]] bool take(Gap& gap, Face& face) {
    if (!gap.queued) return false;
    gaps_.dequeue(gap);
    use(gap, face);
    return true;
  }

  [[gnu::always_inline]] static void use(Gap& gap, Face& face) {
    --gap.free_slots;
    know(gap, face);
  }

  // The boundary now runs from `gap` to `next`; the face lies behind, in which next has the corner `next_corner`.
  // `kFresh`: nothing has met the gap yet.
  template <bool kFresh = false>
  [[gnu::always_inline]] void closeBoundary(Gap& gap, Gap& next, Index next_corner, const Face& face) {
    gap.next = &next;
    next.prev = &gap;
    gap.behind = face.answer.dummy ? kNone : next_corner;
    gap.degree_behind = face.answer.dummy ? 0 : face.answer.degree;
    if (Script::kGathers) {
      gap.opposite_next = face.before_current;
      gap.met = (kFresh ? 0 : gap.met) + (uint64_t{1} << 32) + next.valence;
      next.met += (uint64_t{1} << 32) + gap.valence;
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

  // After a face that leaves the boundary from `tail` back to `head`.
  [[gnu::always_inline]] void leave(Gap* tail, Gap* head, const FaceAnswer& face) {
    const Index others = gather(tail, head, face), list = Gaps::listOf(head->free_slots);
    last_ = {tail, head, list};
    if (gaps_.comesFirst(list, others)) return;
    requeue(tail, head);
    last_.head = nullptr;
  }

  // Notes the face in the gaps from `tail` back to `head`. Returns the lowest list of all but head.
  [[gnu::always_inline]] Index gather(Gap* tail, const Gap* head, const FaceAnswer& face) {
    const uint32_t angle = face.dummy ? 0 : static_cast<uint32_t>(flatAngle(face.degree));
    Index least = Gaps::kLists - 1;
    for (Gap* gap = tail;; gap = gap->prev) {
      if (Script::kGathers) gap->angle += angle;
      if (face.dummy) gap->dummy = true;
      if (gap == head) return tail == head ? Gaps::kLists : least;
      least = std::min(least, gap->free_slots);
    }
  }

  [[gnu::always_inline]] void requeue(Gap* tail, const Gap* head) {
    for (Gap* gap = tail;; gap = gap->prev) {
      gaps_.enqueue(*gap);
      if (gap == head) return;
    }
  }

  // What the last face left of the boundary, when that is not queued yet.
  struct Left {
    Gap *tail = nullptr, *head = nullptr;
    Index list = 0;  // which the head would join, and come before all others
  };

  // Faces of at most this degree have room for all their corners from the beginning.
  static constexpr Index kRoom = 64;

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
