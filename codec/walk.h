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
#include "codec/gaps.h"
#include "codec/mesh.h"
#include "codec/questions.h"
#include "codec/result.h"
#include "codec/split_boundary.h"

namespace tutte {

/// Runs a Script (see codec/questions.h) to a mesh.
template <class Script>
class Walk : public SplitBoundary<Script> {
 public:
  /// `least_degree`: 3, or 2 for a dual, where a valence of 2 is a degree. `expected_corners`: room that is reserved
  /// at once; there may be more or less.
  Walk(Script& script, TieRule tie, Index least_degree, const Limits& limits, size_t expected_corners,
       GapMemory& memory)
      : Base(script, tie, expected_corners, memory),
        least_degree_(least_degree),
        limits_(limits),
        degrees_(mesh_.face_degrees, expected_corners / 3) {}
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  /// Builds all components. O(corners). Fails only on damaged input or exceeded limits.
  Error run() {
    while (error_ == Error::kNone && script_.component()) {
      starts_.push_back(static_cast<Index>(corners_.size()));
      grow();
      noteCopy();
    }
    if (error_ != Error::kNone && script_.faulty()) error_ = script_.fault();
    finish();
    return error_;
  }

  Connectivity& connectivity() { return mesh_; }

  /// The umbrellas that stand for dummy faces.
  std::vector<Index> dummyUmbrellas() && { return std::move(dummy_umbrellas_); }

 private:
  using Base = SplitBoundary<Script>;
  using Face = typename Base::Face;
  using Base::become, Base::closeBoundary, Base::corners_, Base::emit, Base::emitKnown, Base::error_, Base::fail,
      Base::finishSplits, Base::gaps_, Base::kAnyReach, Base::kDegree, Base::kGathers, Base::know, Base::mesh_,
      Base::pinched_, Base::script_, Base::split, Base::umbrellas_;

  void finish() {
    corners_.finish();
    degrees_.finish();
    if (kDegree != 0) mesh_.face_degrees.assign(corners_.size() / std::max(kDegree, Index{1}), kDegree);
    mesh_.vertex_count = mesh_.umbrella_count = static_cast<Index>(umbrellas_);
  }

  void noteCopy() {
    const Index original = script_.original(), start = starts_.back(), end = static_cast<Index>(corners_.size());
    if (original != kNone) mesh_.copies.push_back({start, starts_[original], end - start});
  }

  // A face was attached. `start`: where the next one is; null: the queue knows.
  struct Attached {
    bool ok = false;
    Gap* start = nullptr;
  };

  // One component, face by face.
  void grow() {
    gaps_.clear();
    Attached last = seed();
    while (last.ok) {
      Face face;
      if (!Base::choose(last.start, face)) return;
      last = attach(face);
    }
  }

  // The first face of a component. All its vertices are new.
  [[gnu::noinline]] Attached seed() {
    Face face = Face::seed();
    script_.seed();
    if (kDegree == 0) face.answer = script_.face({});
    if (face.dummy()) return {fail(Error::kMalformed)};
    if (!open(face)) return {};
    face.missing = face.degree();
    while (face.missing > 0) {
      const VertexAnswer vertex = script_.seedVertex(face.question());
      if (vertex.valence == 0) return {fail(Error::kMalformed)};
      if (!addVertex(vertex, face)) return {};
      if (face.stretch == nullptr) face.stretch = face.current;
    }
    closeBoundary(*face.stretch, *face.current, face.corner - 1, face);
    corners_.setSize(face.corner);
    return {true, Base::template leave<kAnyReach>(face.stretch, face.current, face)};
  }

  // Whether usual faces have texts of their own. Where a program's size counts more, there is one for all.
#if defined(TUTTE_COMPACT)
  static constexpr bool kUsualFaces = false;
#else
  static constexpr bool kUsualFaces = true;
#endif

  // One more face, of which choose() told where.
  [[gnu::always_inline]] Attached attach(Face& face) {
    script_.start(*face.start);
    if (kUsualFaces && face.second->free_slots != 0) {
      if (face.start->free_slots != 0) return attachWith<0>(face);
      const Gap& prev = *face.start->prev;
      if (prev.free_slots > 1 && &prev != face.second) {
        return Base::reachBack(face) ? attachWith<1>(face) : Attached{fail(Error::kMalformed)};
      }
    }
    return kUsualFaces ? attachFar(face) : attachAny(face);
  }

  [[gnu::noinline]] Attached attachFar(Face face) { return attachAny(face); }

  [[gnu::always_inline]] Attached attachAny(Face& face) {
    return Base::reachOut(face) ? attachWith<kAnyReach>(face) : Attached{fail(Error::kMalformed)};
  }

  template <int kReach>
  [[gnu::always_inline]] Attached attachWith(Face& face) {
    if (kDegree == 0) {
      face.answer = script_.face({face.start, face.second, face.head, face.tail, face.edges, face.closed});
    }
    // Quads are the usual faces of polygon meshes: what follows is there once more for them, with a constant.
    if (kDegree == 0 && kUsualFaces && kReach != kAnyReach && face.answer.degree == 4 && !face.answer.dummy) {
      face.answer = {4, false};
      return attachTold<kReach>(face);
    }
    return attachTold<kReach>(face);
  }

  // The same, once the degree is known.
  template <int kReach>
  [[gnu::always_inline]] Attached attachTold(Face& face) {
    if (!open(face)) return {};
    emitKnown(*face.start, face);
    if (kReach == kAnyReach) {
      const Gap* const stop = face.closed ? face.start : face.tail;
      for (const Gap* gap = face.second; gap != stop; gap = gap->next) emitKnown(*gap, face);
      if (face.closed) {
        finishFace<kReach>(face);
        return {true};
      }
    }
    face.current = face.stretch = face.tail;
    face.before_tail = kReach == kAnyReach ? face.tail->prev : face.start;
    face.missing = face.degree() - face.edges - 1;
    if (kGathers) face.before_current = face.before_tail->capped;
    emit(*face.tail, face);
    return fill<kReach>(face, false);
  }

  // The missing vertices of a face, from its tail round to its head.
  template <int kReach>
  [[gnu::always_inline]] Attached fill(Face& face, bool any_split) {
    const uint16_t after_head = kGathers ? face.head->next->capped : uint16_t{0};
    while (face.missing > 0) {
      const VertexAnswer vertex = script_.vertex(face.question());
      if (vertex.valence != 0) {
        if (!addVertex(vertex, face)) return {};
        continue;
      }
      if (kReach != kAnyReach) return fillSplit(face);
      face = split(face);
      if (error_ != Error::kNone) return {};
      any_split = true;
    }
    const size_t last_corner = face.corner - 1;
    Base::template emitHead<kReach>(face);
    Gap &head = *face.head, &last = *face.current;
    if (kReach == kAnyReach && (last.free_slots == 0 || &last == &head)) return {fail(Error::kMalformed)};
    if (kDegree == 0 && pinched_) return {fail(Error::kMalformed)};
    if (kGathers && face.is_new) last.opposite_own = head.capped;
    closeBoundary(head, last, last_corner, face);
    if (kGathers) head.opposite_own = after_head;
    if (any_split && !finishSplits(face)) return {};
    Gap* const start = Base::template leave<kReach>(face.stretch, face.head, face);
    finishFace<kReach>(face);
    return {true, start};
  }

  [[gnu::noinline]] Attached fillSplit(Face face) {
    face = split(face);
    return error_ == Error::kNone ? fill<kAnyReach>(face, true) : Attached{};
  }

  template <int kReach>
  [[gnu::always_inline]] void finishFace(const Face& face) {
    Base::template release<kReach>(face, face.closed ? face.start : face.tail);
    corners_.setSize(face.corner);
  }

  // A vertex that nobody knew; becomes the current one.
  [[gnu::always_inline]] bool addVertex(const VertexAnswer& vertex, Face& face) {
    if (kDegree == 0) {
      if (script_.faulty()) return fail(script_.fault());
      if (umbrellas_ >= limits_.max_corners) return fail(Error::kLimitExceeded);
    }
    Gap& gap = gaps_.create();
    gap.umbrella = static_cast<Index>(umbrellas_++);
    gap.free_slots = vertex.valence - 1;
    gap.flat = flatAngle(vertex.valence);
    if (Base::kTells) {
      gap.valence = vertex.valence;
      gap.capped = static_cast<uint16_t>(std::min(vertex.valence, Index{14}));
      gap.opposite_own = 0;
      gap.angle = 0;
      gap.dummy = false;
    }
    if (face.current != nullptr) {
      Base::template closeBoundary<true>(gap, *face.current, face.corner - 1, face);
    } else {
      beginBoundary(gap);
    }
    if (vertex.dummy) dummy_umbrellas_.push_back(gap.umbrella);
    become(gap, face, true);
    --face.missing;
    ++face.found;
    know(gap, face);
    return true;
  }

  // Of a seed's first gap: there is no other to link it with.
  static void beginBoundary(Gap& gap) {
    gap.next = gap.prev = nullptr;
    gap.behind = kNone;
    gap.degree_behind = 0;
    gap.met = 0;
    gap.opposite_next = 0;
  }

  // Checks the answer, and begins the face.
  [[gnu::always_inline]] bool open(Face& face) {
    if (kDegree == 0) return openTold(face);
    if (face.closed ? face.edges != kDegree : face.edges >= kDegree) return fail(Error::kMalformed);
    face.first_corner = face.corner = corners_.size();
    return corners_.hasRoom(face.corner + kDegree) || makeRoom(face.corner + kDegree);
  }

  [[gnu::always_inline]] bool openTold(Face& face) {
    const FaceAnswer& answer = face.answer;
    if (script_.faulty()) return fail(script_.fault());
    if (answer.degree < least_degree_ || answer.degree < face.edges) return fail(Error::kMalformed);
    if (face.closed != (answer.degree == face.edges)) return fail(Error::kMalformed);
    face.first_corner = face.corner = corners_.size();
    // Every corner of a dummy face lies against a corner of the mesh.
    const size_t before = answer.dummy ? 0 : face.corner;
    if (answer.degree > limits_.max_corners - before) return fail(Error::kLimitExceeded);
    corners_.makeRoom(face.corner + std::max(face.edges + 2, Base::kRoom));
    if (answer.dummy) return true;
    if (degrees_.size() >= limits_.max_faces) return fail(Error::kLimitExceeded);
    degrees_.add(answer.degree);
    return true;
  }

  // For faces of known degree: all limits are limits of corners, and looked at when there is no room.
  [[gnu::noinline]] bool makeRoom(size_t corners) {
    const uint64_t most = std::min<uint64_t>(limits_.max_corners, uint64_t{limits_.max_faces} * kDegree);
    if (script_.faulty()) return fail(script_.fault());
    if (corners > most) return fail(Error::kLimitExceeded);
    corners_.makeRoom(corners, most);
    return true;
  }

  Index least_degree_;
  Limits limits_;
  Appender degrees_;  // of the mesh's faces
  std::vector<Index> dummy_umbrellas_;
  std::vector<Index> starts_;  // of components: their first corners
};

}  // namespace tutte
