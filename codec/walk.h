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
#include <cstdint>
#include <utility>
#include <vector>

#include "codec/appender.h"
#include "codec/boundary.h"
#include "codec/gaps.h"
#include "codec/mesh.h"
#include "codec/questions.h"
#include "codec/result.h"

namespace tutte {

/// Runs a script to a mesh. A Script offers
///   bool component()                       is there another component?
///   Index original() const               the number of the one that it repeats, or kNone
///   FaceAnswer face(const FaceQuestion&)
///   VertexAnswer vertex(const VertexQuestion&)
///   SplitAnswer split(const VertexQuestion&, const Gaps&)
///   static constexpr bool kGathers         do its answers depend on what Gap gathers of the surroundings?
///   static constexpr bool kSums            ... on sums of valences?
///   bool faulty()                          must the walk stop? To be asked after each answer
///   Error fault()                          why
/// and follows, where it stands on an input mesh, the position of the walk:
///   void seed()                  before the first face of a component
///   void start(const Gap& gap)   at the far end of the edge that leaves the gap, in the face outside
///   void step()                  on to the next corner of the face
///   void cross(const Gap& gap)   the gap's leaving edge becomes the edge from the next corner back to this one
template <class Script>
class Walk : public Boundary<Script> {
 public:
  /// `least_degree`: 3, or 2 for a dual, where a valence of 2 is a degree. `expected_corners`: room that is reserved
  /// at once; there may be more or less.
  Walk(Script& script, TieRule tie, Index least_degree, const Limits& limits, size_t expected_corners)
      : Base(script, tie, expected_corners),
        least_degree_(least_degree),
        limits_(limits),
        degrees_(mesh_.face_degrees, expected_corners / 3) {}
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  /// Builds all components. O(corners). Fails only on damaged input or exceeded limits.
  Error run() {
    Error error = Error::kNone;
    while (error == Error::kNone && script_.component()) {
      starts_.push_back(corners_.size());
      error = seed();
      for (bool more = true; more && error == Error::kNone;) more = attach(error);
      noteCopy();
    }
    degrees_.finish();
    corners_.finish();
    Base::on_boundary_.resize(umbrellas_);
    mesh_.vertex_count = mesh_.umbrella_count = static_cast<Index>(umbrellas_);
    return error;
  }

  Connectivity& connectivity() { return mesh_; }
  Index splits() const { return splits_; }

  /// The umbrellas that stand for dummy faces.
  std::vector<Index> dummyUmbrellas() && { return std::move(dummy_umbrellas_); }

 private:
  using Base = Boundary<Script>;
  using Face = typename Base::Face;
  using Base::become, Base::closeBoundary, Base::corners_, Base::emit, Base::emitKnown, Base::gaps_, Base::gather,
      Base::know, Base::leave, Base::mesh_, Base::pairLast, Base::pinched_, Base::requeue, Base::script_, Base::take,
      Base::umbrellas_, Base::use;

  void noteCopy() {
    const Index original = script_.original(), start = starts_.back();
    if (original != kNone) mesh_.copies.push_back({start, starts_[original], corners_.size() - start});
  }

  // The first face of a component. All its vertices are new.
  Error seed() {
    gaps_.clear();
    script_.seed();
    Face face = Face::seed();
    face.answer = script_.face({});
    if (face.answer.dummy) return Error::kMalformed;
    if (!open(face)) return face.error;
    face.missing = face.answer.degree;
    while (face.missing > 0) {
      const VertexAnswer vertex = script_.seedVertex(face.question());
      if (vertex.valence == 0) return Error::kMalformed;
      if (!addVertex(vertex, face)) return face.error;
      if (face.stretch == nullptr) face.stretch = face.current;
    }
    closeBoundary(*face.stretch, *face.current, face.corner - 1, face);
    leave(face.stretch, face.current, face.answer);
    corners_.setSize(face.corner);
    return Error::kNone;
  }

  // One more face. False: there is none, or an error.
  [[gnu::always_inline]] bool attach(Error& error) {
    Face face;
    const bool attached = Base::choose(face) && grow(face);
    error = attached ? Error::kNone : face.error;
    return attached;
  }

  [[gnu::always_inline]] bool grow(Face& face) {
    script_.start(*face.start);
    face.error = Error::kMalformed;
    face.edges = 1;
    use(*face.start, face);
    use(*face.second, face);
    if (!Base::reachOut(face)) return false;
    face.answer = script_.face({face.start, face.second, face.head, face.tail, face.edges, face.closed});
    if (!open(face)) return false;
    const Gap* const stop = face.closed ? face.start : face.tail;
    emitKnown(*face.start, face);
    for (const Gap* gap = face.second; gap != stop; gap = gap->next) emitKnown(*gap, face);
    if (!face.closed && !fill(face)) return false;
    Base::release(face, stop);
    corners_.setSize(face.corner);
    return true;
  }

  // The rest of a face that is not closed: the missing vertices from its tail round to its head.
  [[gnu::always_inline]] bool fill(Face& face) {
    face.current = face.stretch = face.tail;
    face.before_tail = face.tail->prev;
    face.missing = face.answer.degree - face.edges - 1;
    const Index splits = splits_;
    const uint8_t after_head = Script::kGathers ? face.head->next->capped : uint8_t{0};
    if (Script::kGathers) face.before_current = face.before_tail->capped;
    emit(*face.tail, face);
    while (face.missing > 0) {
      const VertexAnswer vertex = script_.vertex(face.question());
      if (vertex.valence == 0) face = split(face);
      if (vertex.valence == 0 ? face.error != Error::kNone : !addVertex(vertex, face)) return false;
    }
    const Index last_corner = face.corner - 1;
    for (const Gap* gap = face.head; gap != face.start; gap = gap->next) emitKnown(*gap, face);
    Gap &head = *face.head, &last = *face.current;
    face.error = Error::kMalformed;
    if (last.free_slots == 0 || pinched_) return false;
    if (Script::kGathers && face.is_new) last.opposite_own = head.capped;
    closeBoundary(head, last, last_corner, face);
    if (Script::kGathers) head.opposite_own = after_head;
    if (splits_ != splits && !finishSplits(face)) return false;
    leave(face.stretch, face.head, face.answer);
    return true;
  }

  // A vertex that nobody knew; becomes the current one.
  [[gnu::always_inline]] bool addVertex(const VertexAnswer& vertex, Face& face) {
    if (script_.faulty()) return face.error = script_.fault(), false;
    face.error = Error::kLimitExceeded;
    if (umbrellas_ >= limits_.max_corners) return false;
    Gap& gap = gaps_.create();
    gap.umbrella = static_cast<Index>(umbrellas_++);
    gap.valence = vertex.valence;
    gap.free_slots = vertex.valence - 1;
    gap.flat = flatAngle(vertex.valence);
    gap.capped = static_cast<uint8_t>(std::min(vertex.valence, Index{14}));
    if (face.current != nullptr) Base::template closeBoundary<true>(gap, *face.current, face.corner - 1, face);
    if (vertex.dummy) dummy_umbrellas_.push_back(gap.umbrella);
    become(gap, face, true);
    --face.missing;
    ++face.found;
    know(gap, face);
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
    face.error = Error::kNone;
    return face;
  }

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

  // Checks the answer, and begins the face.
  [[gnu::always_inline]] bool open(Face& face) {
    const FaceAnswer& answer = face.answer;
    if (script_.faulty()) return face.error = script_.fault(), false;
    face.error = Error::kMalformed;
    if (answer.degree < least_degree_ || answer.degree < face.edges) return false;
    if (face.closed != (answer.degree == face.edges)) return false;
    face.error = Error::kLimitExceeded;
    face.first_corner = face.corner = corners_.size();
    // Every corner of a dummy face lies against a corner of the mesh.
    if (answer.degree > limits_.max_corners - (answer.dummy ? 0 : face.corner)) return false;
    corners_.makeRoom(face.corner + std::max(face.edges + 2, Base::kRoom));
    if (answer.dummy) return true;
    if (degrees_.size() >= limits_.max_faces) return false;
    degrees_.add(answer.degree);
    return true;
  }

  // A stretch of the boundary along the current face, from a split back.
  struct Segment {
    Gap *tail, *head;
  };

  Index least_degree_;
  Limits limits_;
  Appender degrees_;  // of the mesh's faces
  std::vector<Index> dummy_umbrellas_;
  std::vector<Index> last_face_;   // per umbrella, as far as there were splits: the last face with splits, plus 1
  std::vector<Segment> segments_;  // of the current face
  std::vector<Index> starts_;      // of components: their first corners
  Index splits_ = 0;
};

}  // namespace tutte
