#pragma once
// The boundary of the processed region, as cyclic lists of gaps, and the queue that picks where to go on.
//
// A *gap* is a run of free slots of one umbrella, between two edges of the boundary: the edge that arrives from the
// previous gap and the edge that leaves to the next one. An umbrella that the boundary touches several times (after a
// split) owns several gaps. The gaps of one loop of the boundary are linked in the order in which an outside face
// passes them.

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Where a new gap is queued among those with as many free slots. Part of the bit stream.
enum class TieRule : uint8_t { kOldestFirst = 0, kNewestFirst = 1 };

/// All that the walk and its contexts read about a gap stands in one cache line.
struct alignas(64) Gap {
  Index umbrella = 0;
  Index free_slots = 0;
  Index next = kNone;  ///< the gap at the far end of the leaving edge; in a free record, the next free one
  Index prev = kNone;
  Index behind = kNone;     ///< coded corner of the processed face whose edge runs back along the leaving edge;
                            ///< kNone behind a dummy face
  Index degree_behind = 0;  ///< that face's degree, 0 for a dummy face
  Index valence = 0;        ///< of the umbrella
  Index outside = kNone;    ///< encoder only: input corner whose edge is the leaving edge, in the face outside
  Index queue_next = kNone;
  Index queue_prev = kNone;
  bool queued = false;  ///< in the boundary and not part of the current face

  // What the contexts want to know, gathered while the region grows.
  bool dummy = false;               ///< a dummy face touches the umbrella
  uint8_t opposite_next = 0;        ///< in the face behind: the valence (up to 14) of the vertex beyond the next gap's
  uint8_t opposite_own = 0;         ///< in the face behind: the valence of the vertex beyond this gap's own
  uint32_t neighbours = 0;          ///< edges of the umbrella seen by this gap
  uint32_t neighbour_valences = 0;  ///< sum of the valences (each up to 200) at their far ends
  uint32_t angle = 0;               ///< sum over the real faces around it of 1 - 2 / degree, in 1/65536
};

/// Gap records by number, with a bucket queue by free slots: every operation is O(1). Numbers of released gaps are
/// used again, last released first, so that both sides number alike.
class Gaps {
 public:
  explicit Gaps(TieRule tie) : tie_(tie) {
    head_.fill(kNone);
    tail_.fill(kNone);
  }

  Gap& operator[](Index gap) { return records_[gap]; }
  const Gap& operator[](Index gap) const { return records_[gap]; }

  /// Forgets all gaps, so that numbers begin at 0 again. The boundary must be empty.
  void clear() {
    records_.clear();
    free_ = kNone;
  }

  /// One more than the largest number given since clear().
  Index highWater() const { return static_cast<Index>(records_.size()); }

  /// A record that is in no list and no queue. Invalidates references.
  Index create() {
    if (free_ == kNone) {
      records_.emplace_back();
      return highWater() - 1;
    }
    const Index gap = free_;
    free_ = records_[gap].next;
    records_[gap] = Gap{};
    return gap;
  }

  void release(Index gap) {
    records_[gap].free_slots = 0;
    records_[gap].next = free_;
    free_ = gap;
  }

  /// A gap with the fewest free slots (64 and more count alike); kNone when the boundary is empty.
  Index first() const { return used_ == 0 ? kNone : head_[std::countr_zero(used_)]; }

  void enqueue(Index gap) {
    const int bucket = bucketOf(gap);
    if (tie_ == TieRule::kOldestFirst) {
      place(gap, tail_[bucket], kNone, bucket);
    } else {
      place(gap, kNone, head_[bucket], bucket);
    }
    used_ |= uint64_t{1} << bucket;
    records_[gap].queued = true;
  }

  /// Must be called before the gap's free slots change.
  void dequeue(Index gap) {
    const int bucket = bucketOf(gap);
    Gap& record = records_[gap];
    record.queued = false;
    (record.queue_prev == kNone ? head_[bucket] : records_[record.queue_prev].queue_next) = record.queue_next;
    (record.queue_next == kNone ? tail_[bucket] : records_[record.queue_next].queue_prev) = record.queue_prev;
    if (head_[bucket] == kNone) used_ &= ~(uint64_t{1} << bucket);
  }

 private:
  static constexpr int kBuckets = 64;

  int bucketOf(Index gap) const {
    const Index slots = records_[gap].free_slots;
    return static_cast<int>(slots < kBuckets ? slots : kBuckets - 1);
  }

  void place(Index gap, Index before, Index after, int bucket) {
    records_[gap].queue_prev = before;
    records_[gap].queue_next = after;
    (before == kNone ? head_[bucket] : records_[before].queue_next) = gap;
    (after == kNone ? tail_[bucket] : records_[after].queue_prev) = gap;
  }

  TieRule tie_;
  uint64_t used_ = 0;
  std::array<Index, kBuckets> head_;
  std::array<Index, kBuckets> tail_;
  Index free_ = kNone;
  std::vector<Gap> records_;
};

}  // namespace tutte
