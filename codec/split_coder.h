#pragma once
// Splits: which gap, and which of its slots. Most splits go to a gap near by along the boundary, so a gap is told by
// its distance there, counting only gaps that a split can go to; far ones and those on other loops by number.

#include <array>

#include "codec/gaps.h"
#include "codec/model.h"
#include "codec/walk.h"

namespace tutte {

class SplitCoder {
 public:
  /// The gap kNone is returned for a split that cannot be, which only damaged input asks for.
  template <class Port>
  SplitAnswer code(Port& port, const VertexQuestion& question, const Gaps& gaps, const SplitAnswer& truth) {
    const bool last = question.missing == 1;
    const Index least_slots = last ? 3 : 2;
    Place place;
    if constexpr (Port::kWriting) place = find(question, least_slots, truth.gap);
    SplitAnswer answer;
    if (near_[last].code(port, place.near)) {
      place.backward = backward_[last].code(port, place.backward);
      place.distance = distance_[last].code(port, place.distance);
      answer.gap = gapAt(question, least_slots, place);
    } else {
      answer.gap = port.uniform(gaps.highWater(), truth.gap);
    }
    if (answer.gap == kNone || !gaps[answer.gap].queued || gaps[answer.gap].free_slots < least_slots) return {};
    // At least one slot remains before the face, and one after its last vertex.
    const Index choices = gaps[answer.gap].free_slots - least_slots + 1, shift = last ? 1 : 0;
    const Index class_of_choices = choices < 4 ? choices : 4;
    const bool first = choices == 1 || first_[last][class_of_choices].code(port, truth.slots_after == shift);
    answer.slots_after = first ? shift : shift + 1 + port.uniform(choices - 1, truth.slots_after - shift - 1);
    return answer;
  }

 private:
  static constexpr Index kReach = 1024;  // steps along the boundary, in each direction

  struct Place {
    bool near = false;
    bool backward = false;
    Index distance = 0;
  };

  // Visits the gaps of the current loop that a split can go to, from the current vertex on or from head back, until
  // visit(gap, number of such gaps before it) returns true or the reach ends.
  template <class Visit>
  static void alongBoundary(const VertexQuestion& question, Index least_slots, bool backward, Visit&& visit) {
    const Gap* gap = backward ? question.head : question.current;
    Index passed = 0;
    for (Index step = 0; step < kReach; ++step) {
      gap = backward ? gap->prev : gap->next;
      if (!gap->queued) return;  // round to the current face
      if (gap->free_slots < least_slots) continue;
      if (visit(gap->number, passed)) return;
      ++passed;
    }
  }

  static Place find(const VertexQuestion& question, Index least_slots, Index target) {
    Place best;
    for (const bool backward : {false, true}) {
      alongBoundary(question, least_slots, backward, [&](Index gap, Index passed) {
        if (best.near && passed >= best.distance) return true;
        if (gap != target) return false;
        best = {true, backward, passed};
        return true;
      });
    }
    return best;
  }

  static Index gapAt(const VertexQuestion& question, Index least_slots, const Place& place) {
    Index found = kNone;
    alongBoundary(question, least_slots, place.backward, [&](Index gap, Index passed) {
      if (passed == place.distance) found = gap;
      return found != kNone;
    });
    return found;
  }

  // Each by whether the vertex is the face's last missing one.
  std::array<Bit, 2> near_, backward_;
  std::array<NumberModel, 2> distance_;
  std::array<std::array<Bit, 5>, 2> first_;
};

}  // namespace tutte
