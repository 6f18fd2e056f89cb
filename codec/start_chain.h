#pragma once
// Where the polygons of FB_ngon_encoding start.

#include <array>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Chooses the wedge that each fan starts at, so that no two neighbours in the order start at the same one. A triangle
/// may start at any of its corners, a quad at either end of its diagonal, a larger fan at its apex only: the choices
/// form a chain, which one pass forwards and one back settle. O(n).
class StartChain {
 public:
  /// The next polygon: the wedges that it may start at, 1 to 3, the preferred ones first; none if it is no fan.
  void add(std::span<const Index> starts) {
    Link link;
    for (const Index start : starts) link.starts[link.count++] = start;
    links_.push_back(link);
  }

  /// False when some polygon is no fan, or neighbours cannot be told apart; most others are right even then.
  bool choose() {
    bool all = true;
    for (size_t i = 0; i < links_.size(); ++i) all &= reach(i);
    for (size_t i = links_.size(); i-- > 0;) settle(i);
    return all;
  }

  /// After choose(): which of polygon i's starts was taken.
  Index chosen(size_t i) const { return links_[i].chosen; }

 private:
  struct Link {
    std::array<Index, 3> starts{};
    uint8_t count = 0;
    uint8_t reachable = 0;  ///< bit s: start s goes with some start of the polygon before
    uint8_t chosen = 0;
  };

  bool reach(size_t i) {
    Link& link = links_[i];
    for (int s = 0; s < link.count; ++s) link.reachable |= static_cast<uint8_t>(follows(i, link.starts[s]) << s);
    if (link.reachable != 0) return true;
    link.reachable = static_cast<uint8_t>((1 << link.count) - 1);
    return false;
  }

  bool follows(size_t i, Index start) const {
    if (i == 0 || links_[i - 1].count == 0) return true;
    const Link& before = links_[i - 1];
    for (int s = 0; s < before.count; ++s) {
      if ((before.reachable >> s & 1) && before.starts[s] != start) return true;
    }
    return false;
  }

  void settle(size_t i) {
    Link& link = links_[i];
    const bool last = i + 1 == links_.size() || links_[i + 1].count == 0;
    const Index after = last ? kNone : links_[i + 1].starts[links_[i + 1].chosen];
    for (int s = link.count; s-- > 0;) {
      if ((link.reachable >> s & 1) && link.starts[s] != after) link.chosen = static_cast<uint8_t>(s);
    }
  }

  std::vector<Link> links_;
};

}  // namespace tutte
