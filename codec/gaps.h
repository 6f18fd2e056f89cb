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

#include "codec/borrowed.h"
#include "codec/mesh.h"

namespace tutte {

/// Where a new gap is queued among those with as many free slots. Part of the bit stream.
enum class TieRule : uint8_t { kOldestFirst = 0, kNewestFirst = 1 };

/// What counts an edge in the upper half of a number; below, a valence of 4 comes to 0 modulo 16.
inline constexpr uint32_t kMet = (1u << 16) + 12;

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
  uint32_t met = 0;    ///< of the edges of the umbrella seen by this gap, each: kMet plus the valence at the far end

  // Valences, up to 14. Not bytes: compilers let those be anything's.
  uint16_t capped = 0;         ///< the umbrella's
  uint16_t opposite_next = 0;  ///< in the face behind: that of the vertex beyond the next gap's
  uint16_t opposite_own = 0;   ///< in the face behind: that of the vertex beyond this gap's own

  bool queued = false;  ///< in the boundary and not part of the current face
  bool dummy = false;   ///< a dummy face touches the umbrella
};

/// What Gaps lie in.
class GapMemory {
  friend class Gaps;

  /// Of a link: a gap's number, or below 0 the end of a list.
  using Place = int32_t;

  /// Of the queue, newest first: each list is a ring through its end.
  struct Link {
    Place after, before;
  };

  std::vector<std::unique_ptr<Gap[]>> blocks;
  std::vector<Gap*> records;  // by number
  std::vector<Link> links;    // the lists' ends, then the gaps'
};

/// Gap records, with numbers and a queue by free slots: every operation is O(1), and records never move. Numbers of
/// released gaps are used again, last released first, so that both sides number alike.
class Gaps {
 public:
  static constexpr Index kLists = 64;

  Gaps(TieRule tie, GapMemory& memory) : memory_(memory), oldest_first_(tie == TieRule::kOldestFirst) {
    reach(memory_->records.size());
    for (Index list = 0; list < kLists; ++list) first_[endOf(list)] = {endOf(list), endOf(list)};
  }

  /// The gap of a number below highWater().
  const Gap& operator[](Index number) const { return *records_[number]; }
  Gap& operator[](Index number) { return *records_[number]; }

  /// Forgets all gaps, so that numbers begin at 0 again. The boundary must be empty.
  void clear() {
    free_ = nullptr;
    high_water_ = 0;
    fresh_ = fresh_end_ = nullptr;
  }

  /// One more than the largest number given since clear().
  Index highWater() const { return static_cast<Index>(high_water_); }

  /// A record that is in no list and no queue. Only its number is set.
  [[gnu::always_inline]] Gap& create() {
    if (free_ == nullptr) return extend();
    Gap& gap = *free_;
    free_ = gap.next;
    return gap;
  }

  /// Of a gap that is not queued.
  void release(Gap& gap) {
    gap.next = free_;
    free_ = &gap;
  }

  /// The list of a gap with as many free slots: 64 and more count alike.
  static Index listOf(Index free_slots) { return std::min(free_slots, kLists - 1); }

  /// The lowest list that is not empty; kLists when the queue is empty.
  Index lowestList() const { return static_cast<Index>(std::countr_zero(used_)); }

  /// Would a gap of one list that joins the queue now come before all that are queued and before one of `other`?
  bool comesFirst(Index list, Index other) const {
    const uint64_t before = ((uint64_t{1} << oldest_first_) << list) - 1;  // lists that it does not come before
    return (used_ & before) == 0 && list + oldest_first_ <= other;
  }

  /// Takes the first gap of a list that is not empty out of the queue.
  [[gnu::always_inline]] Gap& pop(Index list) {
    const Link& end = first_[endOf(list)];
    Gap& gap = *records_[static_cast<size_t>(oldest_first_ ? end.before : end.after)];
    dequeue(gap);
    return gap;
  }

  [[gnu::always_inline]] void enqueue(Gap& gap) {
    const Index list = listOf(gap.free_slots);
    const Place end = endOf(list), place = static_cast<Place>(gap.number);
    Link* const links = first_;
    const Place after = links[end].after;
    links[place].after = after;
    links[place].before = end;
    links[end].after = place;
    links[after].before = place;
    used_ |= uint64_t{1} << list;
    gap.queued = true;
  }

  [[gnu::always_inline]] void dequeue(Gap& gap) {
    Link* const links = first_;
    const Link& link = links[static_cast<Place>(gap.number)];
    const Place after = link.after, before = link.before;
    links[before].after = after;
    links[after].before = before;
    if (after == before) used_ &= ~(uint64_t{1} << (-1 - after));  // the list's end alone is left
    gap.queued = false;
  }

 private:
  static constexpr Index kFirstBlock = 64;

  using Place = GapMemory::Place;
  using Link = GapMemory::Link;

  static Place endOf(Index list) { return -1 - static_cast<Place>(list); }

  // Makes links for as many gaps.
  void reach(size_t gaps) {
    memory_->links.resize(kLists + gaps);
    first_ = memory_->links.data() + kLists;
    records_ = memory_->records.data();
  }

  [[gnu::noinline]] Gap& extend() {
    if (fresh_ == fresh_end_) openBlock();
    Gap& gap = *fresh_++;
    gap.number = static_cast<Index>(high_water_++);
    gap.queued = false;
    return gap;
  }

  // Blocks double all records: block 0 holds the first 64, block 1 the next 64, block 2 the next 128.
  void openBlock() {
    const Index block = static_cast<Index>(std::bit_width(high_water_ / kFirstBlock));
    const size_t size = block == 0 ? kFirstBlock : kFirstBlock << (block - 1);
    auto& blocks = memory_->blocks;
    if (block == blocks.size()) {
      blocks.push_back(std::make_unique_for_overwrite<Gap[]>(size));
      for (size_t i = 0; i < size; ++i) memory_->records.push_back(&blocks[block][i]);
      reach(high_water_ + size);
    }
    fresh_ = blocks[block].get();
    fresh_end_ = fresh_ + size;
  }

  Borrowed<GapMemory> memory_;

  // None of these is an Index: so compilers know that what is written to records leaves them as they are.
  bool oldest_first_;
  uint64_t used_ = 0;  // lists that hold gaps
  size_t high_water_ = 0;
  Gap* free_ = nullptr;
  Gap *fresh_ = nullptr, *fresh_end_ = nullptr;  // of the last block that is in use
  Gap* const* records_ = nullptr;                // by number
  Link* first_ = nullptr;                        // of the gaps; the lists' ends are before it
};

}  // namespace tutte
