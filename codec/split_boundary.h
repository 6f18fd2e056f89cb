#pragma once
// Splits: the boundary of the processed region meets itself.

#include <cstdint>
#include <vector>

#include "codec/boundary.h"
#include "codec/gaps.h"
#include "codec/mesh.h"
#include "codec/questions.h"
#include "codec/result.h"

namespace tutte {

/// The moves of the walk at vertices that the region has already. For `Script` see codec/questions.h.
template <class Script>
class SplitBoundary : public Boundary<Script> {
 public:
  Index splits() const { return splits_; }

 protected:
  using Base = Boundary<Script>;
  using Face = typename Base::Face;
  using Base::become, Base::closeBoundary, Base::corners_, Base::error_, Base::fail, Base::gaps_, Base::kAnyReach,
      Base::know, Base::pairLast, Base::requeue, Base::script_, Base::take, Base::umbrellas_;

  using Base::Base;

  // A vertex of the region; becomes the current one. Where it keeps no free slot on its far side, the face goes on
  // along the boundary.
  [[gnu::noinline]] Face split(Face face) {
    const SplitAnswer answer = script_.split(face.question(), gaps_);
    if (script_.faulty()) return fail(script_.fault()), face;
    error_ = Error::kMalformed;
    if (answer.gap >= gaps_.highWater() || !gaps_[answer.gap].queued) return face;
    Gap& gap = gaps_[answer.gap];
    if (gap.free_slots < 2 || answer.slots_after > gap.free_slots - 2) return face;
    ++splits_;
    Gap& before = divide(gap, answer.slots_after);
    closeBoundary(before, *face.current, face.corner - 1, face);
    segments_.push_back({face.stretch, &before});
    become(gap, face, false);
    --face.missing;
    ++face.found;
    know(gap, face);
    while (face.current->free_slots == 0) {
      Gap &used = *face.current, &next = *used.next;
      if (face.missing == 0 || !take(next, face)) return face;
      pairLast(used.behind, face);
      gaps_.release(used);
      become(next, face, false);
      --face.missing;
    }
    face.stretch = face.current;
    error_ = Error::kNone;
    return face;
  }

  // After a face with splits. False: it visits an umbrella twice, which no encoder writes.
  [[gnu::noinline]] bool finishSplits(Face face) {
    for (const Segment& segment : segments_)
      Base::template gather<kAnyReach>(segment.tail, segment.head, face), requeue(segment.tail, segment.head);
    segments_.clear();
    last_face_.resize(umbrellas_, kNone);
    for (size_t corner = face.first_corner; corner < face.corner; ++corner) {
      Index& last = last_face_[corners_.umbrellas()[corner]];
      if (last == face.first_corner) return fail(Error::kMalformed);
      last = static_cast<Index>(face.first_corner);
    }
    return true;
  }

 private:
  // Cuts a gap in two around the slot that the face takes: a new one keeps the arriving edge, the old one the leaving.
  Gap& divide(Gap& gap, Index slots_after) {
    gaps_.dequeue(gap);
    Gap& before = gaps_.create();
    const Index number = before.number;
    before = gap;
    before.number = number;
    before.free_slots -= 1 + slots_after;
    before.prev->next = &before;
    gap.free_slots = slots_after;
    return before;
  }

  // A stretch of the boundary along the current face, from a split back.
  struct Segment {
    Gap *tail, *head;
  };

  std::vector<Index> last_face_;   // per umbrella, as far as there were splits: first corner of the last face with any
  std::vector<Segment> segments_;  // of the current face
  Index splits_ = 0;
};

}  // namespace tutte
