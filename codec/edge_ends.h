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

/// What is known of an edge-end.
enum EndState : uint8_t {
  kNoEnd = 0,   ///< nothing, or there is no end, but a boundary
  kJoined = 1,  ///< the two corners are alike
  kParted = 2,  ///< they differ
};

/// The states of all ends of a mesh, and which of them are asked for.
class EdgeEnds {
 public:
  /// `states`: per corner its EndState; those that are parted are given. `candidates`: empty, or per corner kParted
  /// where it may become parted. Ways and candidates must outlive it.
  EdgeEnds(const UmbrellaWays& ways, std::vector<uint8_t> states, std::span<const uint8_t> candidates = {})
      : ways_(ways), states_(std::move(states)), candidates_(candidates), edges_(states_.size()) {}

  const UmbrellaWays& ways() const { return ways_; }
  Index count() const { return static_cast<Index>(states_.size()); }
  uint8_t state(Index end) const { return states_[end]; }
  std::vector<uint8_t> takeStates() && { return std::move(states_); }

  /// Of the edge of an end: the larger one of the states of both, without those that were given.
  uint8_t edge(Index end) const { return edges_[end]; }

  void set(Index end, EndState state) {
    const Index twin = ways_.twin(end);
    states_[end] = state;
    edges_[end] = edges_[twin] = std::max<uint8_t>(edges_[end], state);
  }

  /// Is it to be coded whether it is parted?
  bool isAsked(Index end) const {
    return states_[end] == kNoEnd && ways_.twin(end) != kNone && (candidates_.empty() || candidates_[end] == kParted);
  }

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
  std::span<const uint8_t> candidates_;
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

/// The rings of touched umbrellas, with the states of their ends side by side.
class EndRings {
 public:
  static constexpr Index kReach = 3;  ///< so far the states beside a ring's are its own again, or kNoEnd if it is open

  explicit EndRings(EdgeEnds& ends)
      : ends_(ends),
        numbers_(ends.ways().mesh().umbrella_count),
        places_(std::make_unique_for_overwrite<Index[]>(ends.count())),
        corners_(kReach),
        states_(kReach) {}

  /// The ring of an umbrella.
  EndRing& add(Index umbrella) {
    EndRing ring;
    ring.umbrella = umbrella;
    ring.first = static_cast<Index>(corners_.size());
    ends_.ways().goRound(umbrella, [&](Index corner) {
      const uint8_t state = ends_.state(corner);
      ring.left += ends_.isAsked(corner);
      if (state == kParted) ring.parted = 2;
      places_[corner] = static_cast<Index>(corners_.size());
      corners_.push_back(corner);
      states_.push_back(state);
    });
    ring.count = static_cast<Index>(corners_.size()) - ring.first;
    ring.closed = ends_.ways().twin(corners_[ring.first]) != kNone;
    if (ring.closed && ring.parted == 0) ring.required = 2;
    for (Index i = 0; i < kBeside; ++i) {
      corners_.push_back(kNone);
      states_.push_back(kNoEnd);
    }
    if (ring.parted != 0) {
      for (Index at = ring.first; at < ring.end(); ++at) show(ring, at, states_[at]);
    }
    rings_.push_back(ring);
    numbers_[umbrella] = static_cast<Index>(rings_.size());
    return rings_.back();
  }

  /// Says what an asked end is.
  void set(EndRing& ring, Index place, bool parted) {
    ring.parted = static_cast<uint8_t>(std::min(ring.parted + parted, 2));
    ring.required = static_cast<uint8_t>(ring.required - (ring.required > 0 && parted));
    --ring.left;
    const EndState state = parted ? kParted : kJoined;
    ends_.set(corners_[place], state);
    show(ring, place, state);
  }

  bool isTouched(Index umbrella) const { return numbers_[umbrella] != 0; }
  /// Null when it is not touched.
  EndRing* find(Index umbrella) { return isTouched(umbrella) ? &rings_[numbers_[umbrella] - 1] : nullptr; }
  std::span<EndRing> rings() { return rings_; }
  std::span<const EndRing> rings() const { return rings_; }

  Index placeCount() const { return static_cast<Index>(corners_.size()); }
  /// Of a corner of a touched umbrella.
  Index place(Index corner) const { return places_[corner]; }
  Index corner(Index place) const { return corners_[place]; }
  /// kReach of them may be looked at before and after it.
  const uint8_t* states(Index place) const { return &states_[place]; }

 private:
  static constexpr Index kBeside = 2 * kReach;  ///< places between rings

  void show(const EndRing& ring, Index place, uint8_t state) {
    states_[place] = state;
    if (!ring.closed) return;
    for (Index at = place + ring.count; at < ring.end() + kReach; at += ring.count) states_[at] = state;
    for (Index at = place; at + kReach >= ring.first + ring.count; at -= ring.count) states_[at - ring.count] = state;
  }

  EdgeEnds& ends_;
  std::vector<Index> numbers_;  // per umbrella: of its ring, from 1 on; 0: not touched
  const std::unique_ptr<Index[]> places_;
  std::vector<EndRing> rings_;
  std::vector<Index> corners_;
  std::vector<uint8_t> states_;
};

}  // namespace tutte
