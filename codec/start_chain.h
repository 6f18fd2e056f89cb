#pragma once
// Where the polygons of FB_ngon_encoding start.

#include <array>
#include <cstdint>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// The wedges that a polygon may start at, the preferred ones first; none if it is no fan.
struct Starts {
  std::array<Index, 3> wedges{};
  uint32_t count = 0;
};

/// Chooses the wedge that each fan starts at, so that no two neighbours in the order start at the same one. A triangle
/// may start at any of its corners, a quad at either end of its diagonal, a larger fan at its apex only: the choices
/// form a chain, which one pass forwards and one back settle. O(n), a byte per polygon.
class StartChain {
 public:
  /// `startsOf(i)` gives polygon i's starts, each time the same. False when some polygon is no fan, or neighbours
  /// cannot be told apart; most others are right even then.
  template <class StartsOf>
  bool choose(size_t count, StartsOf startsOf) {
    choices_.resize(count);
    bool all = true;
    Reached reached;
    for (size_t i = 0; i < count; ++i) all &= reach(startsOf(i), reached, choices_[i]);
    Index after = kNone;
    for (size_t i = count; i-- > 0;) settle(startsOf(i), after, choices_[i]);
    return all;
  }

  /// After choose(): which of polygon i's starts was taken.
  Index chosen(size_t i) const { return choices_[i]; }

 private:
  /// The wedges that the last polygon may start at after all before it: any other than `single` can follow.
  struct Reached {
    Index single = kNone;  ///< kNone: several, or none of a polygon that is no fan
  };

  /// `choices`: bit s: start s goes with some start of the polygon before.
  static bool reach(const Starts& starts, Reached& reached, uint8_t& choices) {
    uint32_t reachable = 0;
    for (uint32_t s = 0; s < starts.count; ++s) reachable |= uint32_t{starts.wedges[s] != reached.single} << s;
    const bool some = reachable != 0;
    if (!some) reachable = (1u << starts.count) - 1;
    choices = static_cast<uint8_t>(reachable);
    reached.single = kNone;
    uint32_t others = 0;
    for (uint32_t s = starts.count; s-- > 0;) {
      if ((reachable >> s & 1) == 0) continue;
      others += reached.single != kNone && reached.single != starts.wedges[s];
      reached.single = starts.wedges[s];
    }
    if (others > 0) reached.single = kNone;
    return some;
  }

  /// From reachable starts to the one that is taken; `after` is where the next polygon starts.
  static void settle(const Starts& starts, Index& after, uint8_t& choice) {
    const uint8_t reachable = choice;
    choice = 0;
    for (uint32_t s = starts.count; s-- > 0;) {
      if ((reachable >> s & 1) && starts.wedges[s] != after) choice = static_cast<uint8_t>(s);
    }
    after = starts.count == 0 ? kNone : starts.wedges[choice];
  }

  std::vector<uint8_t> choices_;
};

}  // namespace tutte
