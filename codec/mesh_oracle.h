#pragma once
// The encoder's answers to the walk's questions, from the input mesh.

#include <span>
#include <vector>

#include "codec/borrowed.h"
#include "codec/components.h"
#include "codec/gaps.h"
#include "codec/topology.h"
#include "codec/walk.h"

namespace tutte {

/// What a MeshOracle notes.
struct OracleMemory {
  std::vector<uint8_t> face_done, umbrella_known;
  std::vector<Index> outside;  ///< per gap: the corner whose edge is the leaving edge, in the face outside
  std::vector<Index> gap_at;   ///< per corner outside the region: the gap whose leaving edge is its edge
};

/// Follows the walk on a Topology. All answers take O(1), but for splits: O(min(x, y)) where a gap is cut into x and
/// y slots, which is O(n log n) in all.
class MeshOracle {
 public:
  /// The plans cover all components.
  MeshOracle(const Topology& topology, std::span<const ComponentPlan> plans, OracleMemory& memory)
      : topology_(topology), plans_(plans), memory_(memory) {
    face_done_.assign(topology.faces.faceCount(), 0);
    umbrella_known_.assign(topology.valence.size(), 0);
    gap_at_.resize(topology.twin.size());
    start_corners_.resize(topology.real_faces);
    umbrella_order_.resize(topology.valence.size());
  }

  /// In coded order: the topology's corner at which each real face begins, and the topology's umbrellas.
  std::vector<Index> startCorners() && {
    start_corners_.resize(faces_);
    return std::move(start_corners_);
  }
  std::vector<Index> umbrellaOrder() && {
    umbrella_order_.resize(umbrellas_);
    return std::move(umbrella_order_);
  }

  bool component() { return next_component_ < plans_.size(); }

  /// The earlier component that the next one repeats, or kNone.
  Index original() const { return plans_[next_component_].original; }

  void seed() {
    enter(plans_[next_component_++].seed);
    corner_ = corner_ == first_ ? end_ - 1 : corner_ - 1;  // the first step() leads to the first corner
  }
  [[gnu::always_inline]] void start(const Gap& gap) {
    enter(outside_[gap.number]);
    step();
  }
  [[gnu::always_inline]] void step() { corner_ = following(); }
  [[gnu::always_inline]] void cross(const Gap& gap) {
    if (gap.number >= outside_.size()) makeRoom(gap.number);
    const Index corner = outside_[gap.number] = topology_.twin[corner_];
    gap_at_[corner] = gap.number;
  }

  FaceAnswer face() const { return {end_ - first_, topology_.isDummy(face_)}; }

  [[gnu::always_inline]] VertexAnswer vertex() {
    const Index umbrella = topology_.faces.vertex[following()];
    if (umbrella_known_[umbrella]) return {};
    umbrella_known_[umbrella] = 1;
    umbrella_order_[umbrellas_++] = umbrella;
    const bool dummy = !topology_.dummy_umbrella.empty() && topology_.dummy_umbrella[umbrella];
    return {topology_.valence[umbrella], dummy};
  }

  /// Looks for the ends of the gap on both sides of the face's slot in turn.
  SplitAnswer split(const Gaps& gaps) const {
    const FaceCorners& faces = topology_.faces;
    Index after = following(), before = faces.prev(after);
    for (Index steps = 0;; ++steps) {
      if (done(topology_.twin[after])) return {gap_at_[after], steps};
      if (done(topology_.twin[before])) {
        const Gap& gap = *gaps[gap_at_[before]].next;
        return {gap.number, gap.free_slots - 1 - steps};
      }
      after = faces.next(topology_.twin[after]);
      before = faces.prev(topology_.twin[before]);
    }
  }

 private:
  [[gnu::noinline]] void makeRoom(Index gap) { outside_.resize(2 * gap + 64); }

  [[gnu::always_inline]] void enter(Index corner) {
    face_ = topology_.faces.faceOf(corner);
    face_done_[face_] = 1;
    if (!topology_.isDummy(face_)) start_corners_[faces_++] = corner;
    corner_ = corner;
    first_ = topology_.faces.first[face_];
    end_ = topology_.faces.first[face_ + 1];
  }

  /// The next corner of the current face.
  Index following() const { return corner_ + 1 == end_ ? first_ : corner_ + 1; }

  bool done(Index corner) const { return face_done_[topology_.faces.faceOf(corner)]; }

  const Topology& topology_;
  std::span<const ComponentPlan> plans_;
  Borrowed<OracleMemory> memory_;
  std::vector<uint8_t>&face_done_ = memory_->face_done, &umbrella_known_ = memory_->umbrella_known;
  std::vector<Index>&outside_ = memory_->outside, &gap_at_ = memory_->gap_at;
  std::vector<Index> start_corners_, umbrella_order_;  // as far as faces_ and umbrellas_
  size_t faces_ = 0, umbrellas_ = 0;
  size_t next_component_ = 0;
  Index face_ = 0, first_ = 0, end_ = 0, corner_ = 0;  // the current face, its corners, and the current one
};

}  // namespace tutte
