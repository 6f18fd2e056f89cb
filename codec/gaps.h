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

  // What contexts want to know of the surroundings, gathered while the region grows, if the statistics ask for it.
  uint64_t met = 0;    ///< of the edges of the umbrella seen by this gap: 2^32 plus the valence at the far end
  uint32_t angle = 0;  ///< sum over the real faces around it of 1 - 2 / degree, in 1/65536

  // Valences, up to 14.
  uint16_t capped = 0;         ///< the umbrella's
  uint16_t opposite_next = 0;  ///< in the face behind: that of the vertex beyond the next gap's
  uint16_t opposite_own = 0;   ///< in the face behind: that of the vertex beyond this gap's own

  bool queued = false;  ///< in the boundary and not part of the current face
  bool dummy = false;   ///< a dummy face touches the umbrella
};

/// Gap records by number, with a queue by free slots: every operation is O(1). Numbers of released gaps are
/// used again, last released first, so that both sides number alike.
class Gaps {
 public:
  static constexpr Index kLists = 64;

  explicit Gaps(TieRule tie) : oldest_first_(tie == TieRule::kOldestFirst), links_(kLists) {
    for (Index list = 0; list < kLists; ++list) links_[list] = {list, list};
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

  /// The list of a gap with as many free slots: 64 and more count alike.
  static Index listOf(Index free_slots) { return free_slots < kLists ? free_slots : kLists - 1; }

  /// The lowest list that is not empty; kLists when the queue is empty.
  Index lowestList() {
    for (; used_ != 0; used_ &= used_ - 1) {
      const Index list = static_cast<Index>(std::countr_zero(used_));
      if (links_[list].after != list) return list;
    }
    return kLists;
  }

  /// Would a gap of one list that joins the queue now come before all of another?
  bool comesFirst(Index list, Index other) const { return oldest_first_ ? list < other : list <= other; }

  /// Takes the first gap of a list that is not empty out of the queue.
  Index pop(Index list) {
    const Index gap = (oldest_first_ ? links_[list].before : links_[list].after) - kLists;
    dequeue(gap);
    return gap;
  }

  void enqueue(Index gap) {
    const Index list = listOf(records_[gap].free_slots), link = gap + kLists, after = links_[list].after;
    links_[link].after = after;
    links_[link].before = list;
    links_[list].after = link;
    links_[after].before = link;
    used_ |= uint64_t{1} << list;
    records_[gap].queued = true;
  }

  void dequeue(Index gap) {
    const Index after = links_[gap + kLists].after, before = links_[gap + kLists].before;
    links_[before].after = after;
    links_[after].before = before;
    records_[gap].queued = false;
  }

 private:
  /// Of the queue, newest first: each list is a ring through its end. First come the ends, then the gaps.
  struct Link {
    Index after, before;
  };

  [[gnu::noinline]] Index extend() {
    if (high_water_ == records_.size()) {
      records_.resize(std::max<size_t>(64, 2 * high_water_));
      links_.resize(records_.size() + kLists);
    }
    records_[high_water_] = Gap{};
    return static_cast<Index>(high_water_++);
  }

  // None of these is an Index: so compilers know that what is written to records leaves them as they are.
  bool oldest_first_;
  uint64_t used_ = 0;  // lists that may hold gaps
  size_t free_ = kNone, high_water_ = 0;
  std::vector<Gap> records_;
  std::vector<Link> links_;
};

}  // namespace tutte
