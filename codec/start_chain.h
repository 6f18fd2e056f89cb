#pragma once
// Where the polygons of FB_ngon_encoding start.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// The wedges that a polygon may start at, the preferred ones first; none if it is no fan.
class Starts {
 public:
  Starts() = default;
  /// Of a fan round corner `apex` of a ring of wedges: a triangle may start at any of its corners, a quad at either end
  /// of its diagonal, a larger fan at its apex only.
  Starts(const Index* ring, Index degree, Index apex)
      : ring_(ring),
        degree_(degree),
        apex_(apex),
        count_(degree == 3   ? 3
               : degree == 4 ? 2
                             : 1) {}

  uint32_t count() const { return count_; }
  /// The corner of a start.
  Index corner(uint32_t start) const {
    const Index local = apex_ + (degree_ == 4 ? 2 * start : start);
    return local < degree_ ? local : local - degree_;
  }
  Index wedge(uint32_t start) const { return ring_[corner(start)]; }

 private:
  const Index* ring_ = nullptr;
  Index degree_ = 0, apex_ = 0;
  uint32_t count_ = 0;
};

/// Chooses the wedge that each fan starts at, so that no two neighbours in the order start at the same one. The choices
/// form a chain, which one pass forwards and one back settle. O(n), a byte per polygon.
class StartChain {
 public:
  /// `startsOf(i)` gives polygon i's starts, each time the same. False when some polygon is no fan, or neighbours
  /// cannot be told apart; most others are right even then.
  template <class StartsOf>
  bool choose(size_t count, StartsOf startsOf) {
    choices_.resize(count);
    bool all = true;
    Index single = kNone;
    for (size_t i = 0; i < count; ++i) all &= reach(startsOf(i), single, choices_[i]);
    Index after = kNone;
    for (size_t i = count; i-- > 0;) settle(startsOf(i), after, choices_[i]);
    return all;
  }

  /// After choose(): which of polygon i's starts was taken.
  Index chosen(size_t i) const { return choices_[i]; }

 private:
  /// `single`: the only wedge that the last polygon may start at after all before it, which no other may follow with;
  /// kNone: there are several, or none of a polygon that is no fan. `choices` becomes a bit per start: it goes with
  /// some start of the polygon before.
  static bool reach(const Starts& starts, Index& single, uint8_t& choices) {
    const uint32_t count = starts.count(), every = (1u << count) - 1;
    choices = static_cast<uint8_t>(every);
    if (single == kNone && count > 1 && starts.wedge(0) != starts.wedge(1)) return true;  // as nearly always
    uint32_t reachable = 0;
    for (uint32_t s = 0; s < count; ++s) reachable |= uint32_t{starts.wedge(s) != single} << s;
    const bool some = reachable != 0;
    if (some) choices = static_cast<uint8_t>(reachable);
    single = onlyOf(starts, choices);
    return some;
  }

  /// The wedge that all of the chosen starts have; kNone if they differ.
  static Index onlyOf(const Starts& starts, uint32_t choices) {
    Index only = kNone;
    for (uint32_t s = 0; s < starts.count(); ++s) {
      if ((choices >> s & 1) == 0) continue;
      if (only != kNone && only != starts.wedge(s)) return kNone;
      only = starts.wedge(s);
    }
    return only;
  }

  /// From reachable starts to the first that differs from `after`, where the next polygon starts.
  static void settle(const Starts& starts, Index& after, uint8_t& choice) {
    if (starts.count() == 0) {
      after = kNone;
      return;
    }
    uint32_t s = 0;
    while (s < starts.count() && ((choice >> s & 1) == 0 || starts.wedge(s) == after)) ++s;
    if (s == starts.count()) s = 0;
    choice = static_cast<uint8_t>(s);
    after = starts.wedge(s);
  }

  std::vector<uint8_t> choices_;
};

}  // namespace tutte
