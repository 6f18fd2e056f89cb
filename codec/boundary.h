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

/// The moves of the walk that know no symbols. For `Script` see codec/questions.h.
template <class Script>
class Boundary {
 public:
  /// Per umbrella: 1 when a dummy face touches it.
  std::vector<uint8_t> onBoundary() && {
    on_boundary_.resize(umbrellas_);
    return std::move(on_boundary_);
  }

 protected:
  static constexpr Index kDegree = Script::kDegree;
  static constexpr bool kGathers = Script::kGathers;

  // Whether anybody asks gaps for more than slots and angles.
  static constexpr bool kTells = kDegree == 0 || kGathers || Script::kSums;

  Boundary(Script& script, TieRule tie, size_t expected_corners, GapMemory& memory)
      : script_(script), gaps_(tie, memory), corners_(mesh_, expected_corners) {}

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
    Gap* stretch;                 // where the face's stretch of the boundary begins, a split's rest if there was one
    uint16_t before_current = 0;  // valence, up to 14, of the vertex before the current one in the face
    bool is_new = false;          // the current vertex's leaving edge belongs to the face
    uint64_t valence_sum = 0;
    int64_t angle = 0;
    size_t first_corner, corner;  // of the face, and the next one

    // Gaps that a seed does not have are null; other faces tell them as they go.
    Face() {}
    static Face seed() {
      Face face;
      face.start = face.second = face.head = face.tail = face.current = face.before_tail = face.stretch = nullptr;
      return face;
    }

    // What is known before its answer, where it is.
    Index degree() const { return kDegree != 0 ? kDegree : answer.degree; }
    bool dummy() const { return kDegree == 0 && answer.dummy; }

    VertexQuestion question() const {
      return {degree(), dummy(), head, current, before_tail, found, missing, valence_sum, angle};
    }
  };

  // How many gaps a face uses up before its start: 0, where it uses up none at all, 1, where that is the start itself
  // and the only one, or any number, on any side. Most faces are of the first two kinds.
  static constexpr int kAnyReach = 2;

  // Where the face is attached: where the last one ended, if `start` is that, or at the first gap of the queue. False:
  // no boundary is left, or it is damaged.
  [[gnu::always_inline]] bool choose(Gap* start, Face& face) {
    if (start != nullptr) {
      face.start = start;
      face.second = start->next;
    } else {
      const Index list = gaps_.lowestList();
      if (list == Gaps::kLists) return false;
      face.start = &gaps_.pop(list);
      face.second = face.start->next;
      if (!face.second->queued) return fail(Error::kMalformed);
      gaps_.dequeue(*face.second);
    }
    face.head = face.start;
    face.tail = face.second;
    face.edges = 1;
    use(*face.start, face);
    use(*face.second, face);
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
      if (!reachBack(face)) return false;
    }
    return true;
  }

  [[gnu::always_inline]] bool reachBack(Face& face) {
    ++face.edges;
    face.head = face.head->prev;
    return take(*face.head, face);
  }

  // What the face shares with the region behind its missing vertices.
  template <int kReach>
  [[gnu::always_inline]] void emitHead(Face& face) {
    if (kReach == 1) emitKnown(*face.head, face);
    if (kReach < kAnyReach) return;
    for (const Gap* gap = face.head; gap != face.start; gap = gap->next) emitKnown(*gap, face);
  }

  // The gaps that the face used up, in the order in which their numbers come again. `stop`: where those after the start
  // end.
  template <int kReach>
  [[gnu::always_inline]] void release(const Face& face, const Gap* stop) {
    if (kReach == 1) gaps_.release(*face.start);
    if (kReach < kAnyReach) return;
    if (face.start != face.head || face.closed) gaps_.release(*face.start);
    for (Gap* gap = face.second; gap != stop;) {
      Gap* const next = gap->next;
      gaps_.release(*gap);
      gap = next;
    }
    if (face.start == face.head) return;
    for (Gap* gap = face.start->prev; gap != face.head; gap = gap->prev) gaps_.release(*gap);
  }

  // Always false, to be returned.
  bool fail(Error error) {
    error_ = error;
    return false;
  }

  [[gnu::always_inline]] void become(Gap& gap, Face& face, bool is_new) {
    script_.step();
    if (kGathers && face.current != nullptr) {
      if (face.is_new) face.current->opposite_own = gap.capped;
      face.before_current = face.current->capped;
    }
    face.is_new = is_new;
    face.current = &gap;
    if (kDegree == 0 && face.answer.degree > kRoom) corners_.makeRoom(face.corner + face.edges + 2);
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
  [[gnu::always_inline]] void closeBoundary(Gap& gap, Gap& next, size_t next_corner, const Face& face) {
    gap.next = &next;
    next.prev = &gap;
    gap.behind = face.dummy() ? kNone : static_cast<Index>(next_corner);
    if (kTells) gap.degree_behind = face.dummy() ? 0 : face.degree();
    if (kGathers) {
      gap.opposite_next = face.before_current;
      gap.met = (kFresh ? 0 : gap.met) + kMet + next.valence;
      next.met += kMet + gap.valence;
    }
    script_.cross(gap);
  }

  [[gnu::always_inline]] void emit(const Gap& gap, Face& face) {
    if (face.dummy()) {
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
    if (kDegree == 0 && (face.dummy() || corner == kNone)) return;
    corners_.twins()[face.corner - 1] = corner;
    corners_.twins()[corner] = static_cast<Index>(face.corner - 1);
  }

  // After a face that leaves the boundary from `tail` back to `head`: queues its gaps. Where head comes before all
  // others, the next face begins there, and neither head nor the gap after it need to be in the queue; that head is
  // returned.
  template <int kReach>
  [[gnu::always_inline]] Gap* leave(Gap* tail, Gap* head, const Face& face) {
    const Index others = gather<kReach>(tail, head, face);
    if (gaps_.comesFirst(Gaps::listOf(head->free_slots), others)) {
      for (const Gap* const second = head->next; tail != second; tail = tail->prev) gaps_.enqueue(*tail);
      return head;
    }
    requeue(tail, head);
    return nullptr;
  }

  // Notes the face in the gaps from `tail` back to `head`. Returns the lowest list of all but head.
  template <int kReach>
  [[gnu::always_inline]] Index gather(Gap* tail, Gap* head, const Face& face) {
    const uint32_t angle = face.dummy() ? 0 : static_cast<uint32_t>(flatAngle(face.degree()));
    const auto note = [&](Gap& gap) {
      if (kDegree != 0) return;  // nobody asks
      if (kGathers) gap.angle += angle;
      if (face.dummy()) gap.dummy = true;
    };
    note(*head);
    if (kReach == kAnyReach && tail == head) return Gaps::kLists;
    Index least = Gaps::kLists - 1;
    Gap* gap = tail;
    do {
      note(*gap);
      least = std::min(least, gap->free_slots);
      gap = gap->prev;
    } while (gap != head);
    return least;
  }

  [[gnu::always_inline]] void requeue(Gap* tail, const Gap* head) {
    for (Gap* gap = tail;; gap = gap->prev) {
      gaps_.enqueue(*gap);
      if (gap == head) return;
    }
  }

  // Faces of at most this degree have room for all their corners from the beginning.
  static constexpr Index kRoom = 64;

  Script& script_;
  Gaps gaps_;
  Connectivity mesh_;
  CornerAppender corners_;            // of the mesh
  std::vector<uint8_t> on_boundary_;  // as far as a dummy face was met
  size_t umbrellas_ = 0;              // not an Index, as in Gaps
  Error error_ = Error::kNone;
  bool pinched_ = false;  // two dummy faces, or one twice, touch an umbrella: never in a valid stream
};

}  // namespace tutte
