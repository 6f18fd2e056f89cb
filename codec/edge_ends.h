#pragma once
// What is known of the ends of edges, and the rings that they form round umbrellas.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "codec/mesh.h"
#include "codec/umbrella_ways.h"

namespace tutte {

/// What is known of an edge-end. The lower two bits are what is shown of it to contexts: 0 for nothing.
enum EndState : uint8_t {
  kAsked = 0,   ///< it is to be coded
  kJoined = 1,  ///< the two corners are alike
  kParted = 2,  ///< they differ
  kNoEnd = 4,   ///< nothing is coded: a boundary, or the corners are known to be alike
};

/// The states of all ends of a mesh.
class EdgeEnds {
 public:
  static constexpr uint8_t kShown = 3;

  /// `states`: per corner its EndState; those that are parted are given. Ways must outlive it.
  EdgeEnds(const UmbrellaWays& ways, std::vector<uint8_t> states)
      : ways_(ways), states_(std::move(states)), edges_(states_.size()) {}

  const UmbrellaWays& ways() const { return ways_; }
  Index count() const { return static_cast<Index>(states_.size()); }
  uint8_t state(Index end) const { return states_[end]; }
  uint8_t shown(Index end) const { return states_[end] & kShown; }
  std::vector<uint8_t> takeStates() && { return std::move(states_); }

  /// Of the edge of an end: the larger one of the states of both, without those that were given.
  uint8_t edge(Index end) const { return edges_[end]; }

  void set(Index end, EndState state) {
    const Index twin = ways_.twin(end);
    states_[end] = state;
    edges_[end] = edges_[twin] = std::max<uint8_t>(edges_[end], state);
  }

  bool isAsked(Index end) const { return states_[end] == kAsked; }

  /// An end of the umbrella is.
  bool isAnyAsked(Index umbrella) const {
    const Index first = ways_.first(umbrella);
    Index corner = first;
    do {
      if (isAsked(corner)) return true;
      corner = ways_.back(corner);
    } while (corner != kNone && corner != first);
    return false;
  }

 private:
  const UmbrellaWays& ways_;
  std::vector<uint8_t> states_;
  std::vector<uint8_t> edges_;
};

/// A touched umbrella: the ends of its corners, as they follow each other in goRound().
struct EndRing {
  Index umbrella = 0;
  Index first = 0, count = 0;  ///< where it is in EndRings
  Index left = 0;              ///< asked ends that are still to come
  uint8_t parted = 0;          ///< ends that are, up to 2
  uint8_t required = 1;        ///< parted ends that must still come
  bool closed = false;

  Index touched_neighbours = 0;  ///< that are known, by edges
  Index unknown_neighbours = 0;  ///< by edges

  Index end() const { return first + count; }
};

/// The rings of touched umbrellas.
class EndRings {
 public:
  explicit EndRings(EdgeEnds& ends)
      : ends_(ends),
        numbers_(ends.ways().mesh().umbrella_count),
        corners_(std::make_unique_for_overwrite<Index[]>(ends.count())) {}

  /// The ring of an umbrella, which has none yet.
  EndRing& add(Index umbrella) {
    EndRing ring;
    ring.umbrella = umbrella;
    ring.first = count_;
    Index* corner_at = &corners_[count_];
    uint8_t parted = 0;
    ends_.ways().goRound(umbrella, [&](Index corner) {
      const uint8_t state = ends_.state(corner);
      ring.left += state == kAsked;
      parted |= state & kParted;
      *corner_at++ = corner;
    });
    count_ = static_cast<Index>(corner_at - corners_.get());
    ring.count = count_ - ring.first;
    ring.closed = ends_.ways().twin(corners_[ring.first]) != kNone;
    ring.parted = parted;
    if (ring.closed && parted == 0) ring.required = 2;
    rings_.push_back(ring);
    numbers_[umbrella] = static_cast<Index>(rings_.size());
    return rings_.back();
  }

  /// Says what an asked end of the ring is.
  void set(EndRing& ring, Index end, bool parted) {
    --ring.left;
    if (parted) {
      ring.parted = static_cast<uint8_t>(std::min(ring.parted + 1, 2));
      ring.required = static_cast<uint8_t>(ring.required - (ring.required > 0));
    }
    ends_.set(end, parted ? kParted : kJoined);
  }

  bool isTouched(Index umbrella) const { return numbers_[umbrella] != 0; }
  /// Null when it is not touched.
  EndRing* find(Index umbrella) { return isTouched(umbrella) ? &rings_[numbers_[umbrella] - 1] : nullptr; }
  std::span<EndRing> rings() { return rings_; }
  std::span<const EndRing> rings() const { return rings_; }

  Index placeCount() const { return count_; }
  Index corner(Index place) const { return corners_[place]; }
  bool isParted(Index place) const { return ends_.state(corners_[place]) == kParted; }
  /// Of one of a ring's corners. O(valence).
  Index place(const EndRing& ring, Index corner) const {
    Index place = ring.first;
    while (place + 1 < ring.end() && corners_[place] != corner) ++place;
    return place;
  }

  /// Of the end so many places on in its ring, no more than twice the way round: what is shown of it. Nothing beyond
  /// either end of an open ring, and of an end that has the ring for itself.
  [[gnu::always_inline]] uint32_t shown(const EndRing& ring, Index place, int steps) const {
    Index at = place + static_cast<Index>(steps);
    if (at - ring.first >= ring.count) {
      if (!ring.closed || ring.count == 1) return 0;
      at = steps < 0 ? at + ring.count : at - ring.count;
    }
    return ends_.shown(corners_[at]);
  }

 private:
  EdgeEnds& ends_;
  std::vector<Index> numbers_;  // per umbrella: of its ring, from 1 on; 0: not touched
  std::vector<EndRing> rings_;
  const std::unique_ptr<Index[]> corners_;  // ring by ring
  Index count_ = 0;                         // of corners so far
};

}  // namespace tutte
