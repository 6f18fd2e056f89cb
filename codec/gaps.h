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
#include <memory>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Where a new gap is queued among those with as many free slots. Part of the bit stream.
enum class TieRule : uint8_t { kOldestFirst = 0, kNewestFirst = 1 };

/// All that the walk and its contexts read about a gap stands in one cache line.
struct alignas(64) Gap {
  Gap* next = nullptr;  ///< the gap at the far end of the leaving edge; in a free record, the next free one
  Gap* prev = nullptr;
  Index number = 0;
  Index umbrella = 0;
  Index free_slots = 0;
  Index behind = kNone;     ///< coded corner of the processed face whose edge runs back along the leaving edge;
                            ///< kNone behind a dummy face
  Index degree_behind = 0;  ///< that face's degree, 0 for a dummy face
  Index valence = 0;        ///< of the umbrella
  int32_t flat = 0;         ///< flatAngle(valence)

  // What contexts want to know of the surroundings, gathered while the region grows, if the statistics ask for it.
  uint32_t angle = 0;  ///< sum over the real faces around it of 1 - 2 / degree, in 1/65536
  uint64_t met = 0;    ///< of the edges of the umbrella seen by this gap: 2^32 plus the valence at the far end

  // Valences, up to 14.
  uint8_t capped = 0;         ///< the umbrella's
  uint8_t opposite_next = 0;  ///< in the face behind: that of the vertex beyond the next gap's
  uint8_t opposite_own = 0;   ///< in the face behind: that of the vertex beyond this gap's own

  bool queued = false;  ///< in the boundary and not part of the current face
  bool dummy = false;   ///< a dummy face touches the umbrella

  /// As new, but for the number. Field by field: compilers make slow code of an assignment as a whole.
  [[gnu::always_inline]] void reset() {
    next = prev = nullptr;
    umbrella = free_slots = degree_behind = valence = 0;
    behind = kNone;
    flat = 0;
    angle = 0;
    met = 0;
    capped = opposite_next = opposite_own = 0;
    queued = dummy = false;
  }
};

/// Gap records, with numbers and a queue by free slots: every operation is O(1), and records never move. Numbers of
/// released gaps are used again, last released first, so that both sides number alike.
class Gaps {
 public:
  static constexpr Index kLists = 64;

  explicit Gaps(TieRule tie) : oldest_first_(tie == TieRule::kOldestFirst), links_(kLists) {
    for (Index list = 0; list < kLists; ++list) links_[list] = {list, list};
  }

  /// The gap of a number below highWater().
  const Gap& operator[](Index number) const { return *record(number); }
  Gap& operator[](Index number) { return *record(number); }

  /// Forgets all gaps, so that numbers begin at 0 again. The boundary must be empty.
  void clear() {
    free_ = nullptr;
    high_water_ = 0;
    fresh_ = fresh_end_ = nullptr;
  }

  /// One more than the largest number given since clear().
  Index highWater() const { return static_cast<Index>(high_water_); }

  /// A record that is in no list and no queue.
  [[gnu::always_inline]] Gap& create() {
    if (free_ == nullptr) return extend();
    Gap& gap = *free_;
    free_ = gap.next;
    gap.reset();
    return gap;
  }

  void release(Gap& gap) {
    gap.free_slots = 0;
    gap.next = free_;
    free_ = &gap;
  }

  /// The list of a gap with as many free slots: 64 and more count alike.
  static Index listOf(Index free_slots) { return std::min(free_slots, kLists - 1); }

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
  Gap& pop(Index list) {
    Gap& gap = *record((oldest_first_ ? links_[list].before : links_[list].after) - kLists);
    dequeue(gap);
    return gap;
  }

  [[gnu::always_inline]] void enqueue(Gap& gap) {
    const Index list = listOf(gap.free_slots), link = gap.number + kLists;
    Link* const links = links_.data();
    const Index after = links[list].after;
    links[link].after = after;
    links[link].before = list;
    links[list].after = link;
    links[after].before = link;
    used_ |= uint64_t{1} << list;
    gap.queued = true;
  }

  [[gnu::always_inline]] void dequeue(Gap& gap) {
    Link* const links = links_.data();
    const Index after = links[gap.number + kLists].after, before = links[gap.number + kLists].before;
    links[before].after = after;
    links[after].before = before;
    gap.queued = false;
  }

 private:
  static constexpr Index kFirstBlock = 64;

  /// Of the queue, newest first: each list is a ring through its end. First come the ends, then the gaps.
  struct Link {
    Index after, before;
  };

  // Blocks double all records: block 0 holds the first 64, block 1 the next 64, block 2 the next 128.
  Gap* record(Index number) const {
    const int block = std::bit_width(number / kFirstBlock);
    return &blocks_[block][block == 0 ? number : number - (kFirstBlock << (block - 1))];
  }

  [[gnu::noinline]] Gap& extend() {
    if (fresh_ == fresh_end_) openBlock();
    Gap& gap = *fresh_++;
    gap.reset();
    gap.number = static_cast<Index>(high_water_++);
    return gap;
  }

  void openBlock() {
    const Index block = static_cast<Index>(std::bit_width(high_water_ / kFirstBlock));
    const size_t size = block == 0 ? kFirstBlock : kFirstBlock << (block - 1);
    if (block == blocks_.size()) {
      blocks_.push_back(std::make_unique_for_overwrite<Gap[]>(size));
      links_.resize(kLists + high_water_ + size);
    }
    fresh_ = blocks_[block].get();
    fresh_end_ = fresh_ + size;
  }

  // None of these is an Index: so compilers know that what is written to records leaves them as they are.
  bool oldest_first_;
  uint64_t used_ = 0;  // lists that may hold gaps
  size_t high_water_ = 0;
  Gap* free_ = nullptr;
  Gap *fresh_ = nullptr, *fresh_end_ = nullptr;  // of the last block that is in use
  std::vector<std::unique_ptr<Gap[]>> blocks_;
  std::vector<Link> links_;
};

}  // namespace tutte
