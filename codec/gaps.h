#pragma once
// The boundary of the processed region, as cyclic lists of gaps, and the queue that picks where to go on.
//
// A *gap* is a run of free slots of one umbrella, between two edges of the boundary: the edge that arrives from the
// previous gap and the edge that leaves to the next one. An umbrella that the boundary touches several times (after a
// split) owns several gaps. The gaps of one loop of the boundary are linked in the order in which an outside face
// passes them.

#include <algorithm>
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
  int32_t flat = 0;         ///< flatAngle(valence)
  Index outside = kNone;    ///< encoder only: input corner whose edge is the leaving edge, in the face outside
  bool queued = false;      ///< in the boundary and not part of the current face
  bool dummy = false;       ///< a dummy face touches the umbrella

  // What contexts want to know of the surroundings, gathered while the region grows, if the statistics ask for it.
  uint16_t opposite_next = 0;       ///< in the face behind: the valence (up to 14) of the vertex beyond the next gap's
  uint16_t opposite_own = 0;        ///< in the face behind: the valence of the vertex beyond this gap's own
  uint32_t neighbours = 0;          ///< edges of the umbrella seen by this gap
  uint32_t neighbour_valences = 0;  ///< sum of the valences (each up to 200) at their far ends
  uint32_t angle = 0;               ///< sum over the real faces around it of 1 - 2 / degree, in 1/65536
};

/// Gap records by number, with a bucket queue by free slots: every operation is O(1). Numbers of released gaps are
/// used again, last released first, so that both sides number alike.
class Gaps {
 public:
  explicit Gaps(TieRule tie) : oldest_first_(tie == TieRule::kOldestFirst), links_(kBuckets) {
    for (Index bucket = 0; bucket < kBuckets; ++bucket) links_[bucket] = {bucket, bucket};
    clear();
  }

  Gap& operator[](Index gap) { return records_[gap]; }
  const Gap& operator[](Index gap) const { return records_[gap]; }

  /// Forgets all gaps, so that numbers begin at 0 again. The boundary must be empty.
  void clear() {
    free_ = kNone;
    high_water_ = 0;
  }

  /// One more than the largest number given since clear().
  Index highWater() const { return static_cast<Index>(high_water_); }

  /// A record that is in no list and no queue. Invalidates references.
  Index create() {
    if (free_ == kNone) return extend();
    const Index gap = static_cast<Index>(free_);
    free_ = records_[gap].next;
    records_[gap] = Gap{};
    return gap;
  }

  void release(Index gap) {
    records_[gap].free_slots = 0;
    records_[gap].next = static_cast<Index>(free_);
    free_ = gap;
  }

  /// Takes the gap with the fewest free slots (64 and more count alike) out of the queue; kNone when it is empty.
  Index pop() {
    while (used_ != 0) {
      const Index bucket = static_cast<Index>(std::countr_zero(used_));
      const Index link = oldest_first_ ? links_[bucket].before : links_[bucket].after;
      if (link != bucket) {
        dequeue(link - kBuckets);
        return link - kBuckets;
      }
      used_ &= used_ - 1;
    }
    return kNone;
  }

  void enqueue(Index gap) {
    const Index slots = records_[gap].free_slots, bucket = slots < kBuckets ? slots : kBuckets - 1;
    const Index link = gap + kBuckets, after = links_[bucket].after;
    links_[link].after = after;
    links_[link].before = bucket;
    links_[bucket].after = link;
    links_[after].before = link;
    used_ |= uint64_t{1} << bucket;
    records_[gap].queued = true;
  }

  void dequeue(Index gap) {
    const Index after = links_[gap + kBuckets].after, before = links_[gap + kBuckets].before;
    links_[before].after = after;
    links_[after].before = before;
    records_[gap].queued = false;
  }

 private:
  static constexpr Index kBuckets = 64;

  /// Of the queue, newest first: each bucket is a ring through its end. First come the ends, then the gaps.
  struct Link {
    Index after, before;
  };

  [[gnu::noinline]] Index extend() {
    if (high_water_ == records_.size()) {
      records_.resize(std::max<size_t>(64, 2 * high_water_));
      links_.resize(records_.size() + kBuckets);
    }
    records_[high_water_] = Gap{};
    return static_cast<Index>(high_water_++);
  }

  // None of these is an Index: so compilers know that what is written to records leaves them as they are.
  bool oldest_first_;
  uint64_t used_ = 0;  // buckets that may hold gaps
  size_t free_ = kNone, high_water_ = 0;
  std::vector<Gap> records_;
  std::vector<Link> links_;
};

}  // namespace tutte
