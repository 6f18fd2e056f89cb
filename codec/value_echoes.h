#pragma once
// Values that come again where surfaces touch without sharing vertices: cracks, and parts that were put side by side.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "codec/value_graph.h"
#include "codec/value_model.h"
#include "codec/value_nodes.h"

namespace tutte::values {

/// Codes sites whose value an earlier site has. If an edge at a boundary leads to a known site, and that one's value is
/// also at another boundary, then the next site there is a candidate. Sites without known neighbours may name any
/// earlier site. 8 to 12 bytes per site.
template <int C>
class Echoes {
 public:
  Echoes(const ValueGraph& graph, const Nodes<C>& nodes, int components)
      : graph_(graph),
        nodes_(nodes),
        components_(components),
        shift_(32 - std::clamp(static_cast<int>(std::bit_width(graph.siteCount())), 1, 28)),
        last_(size_t{1} << (32 - shift_), kNone),
        same_(graph.siteCount(), kNone) {}

  /// The earlier site that has the value of this one, or kNone. A writer looks for `value`.
  template <class Port>
  Index code(Port& port, Index site, bool has_neighbours, const Vec<C, int32_t>& value) {
    if (!has_neighbours) return codePlace(port, site, value);
    const Index candidate = candidateFor(site);
    if (candidate == kNone) return kNone;
    const bool same = hits_[history_].code(port, nodes_[candidate].value == value);
    history_ = (history_ << 1 | static_cast<uint32_t>(same)) & 7;
    return same ? candidate : kNone;
  }

  /// A site's value is known: the last one that nodes have.
  void learn(Index site) {
    Index& last = last_[slotOf(nodes_[site].value)];
    if (last != kNone && nodes_[last].value == nodes_[site].value) same_[site] = last;
    last = site;
  }

 private:
  static constexpr int kMostSame = 4;

  size_t slotOf(const Vec<C, int32_t>& value) const {
    uint32_t hash = 0;
    for (int i = 0; i < components_; ++i) hash = (hash ^ static_cast<uint32_t>(value[i])) * 0x9E3779B1u + 0x7F4A7C15u;
    return (hash ^ hash >> 15) * 0x85EBCA6Bu >> shift_;
  }

  Index candidateFor(Index site) const {
    Index found = kNone;
    graph_.forEachOpenFan(site, [&](Index ahead, Index behind) {
      if (nodes_.known(ahead)) found = beside(ahead, true);
      if (found == kNone && nodes_.known(behind)) found = beside(behind, false);
      return found != kNone;
    });
    return found;
  }

  // The other boundary runs the other way: `onwards`, from a site that has the value of `neighbour` to the candidate,
  // otherwise from the candidate to it.
  Index beside(Index neighbour, bool onwards) const {
    Index found = kNone, same = same_[neighbour];
    for (int i = 0; i < kMostSame && same != kNone && found == kNone; ++i, same = same_[same]) {
      graph_.forEachOpenFan(same, [&](Index ahead, Index behind) {
        const Index candidate = onwards ? ahead : behind;
        if (nodes_.known(candidate)) found = candidate;
        return found != kNone;
      });
    }
    return found;
  }

  // How many sites ago: the number of binary digits of that, one by one, and the digits.
  template <class Port>
  Index codePlace(Port& port, Index site, const Vec<C, int32_t>& value) {
    Index ago = 0;
    if constexpr (Port::kWriting) {
      const Index last = last_[slotOf(value)];
      if (last != kNone && nodes_[last].value == value) ago = site - last;
    }
    const int digits = std::bit_width(ago), most = std::bit_width(site);
    int length = 0;
    while (length < most && longer_[static_cast<size_t>(length)].code(port, digits > length)) ++length;
    if (length == 0) return kNone;
    const uint32_t top = 1u << (length - 1);
    ago = top | port.bits(length - 1, ago & (top - 1));
    return site - std::min(ago, site);
  }

  const ValueGraph& graph_;
  const Nodes<C>& nodes_;
  const int components_, shift_;
  std::vector<Index> last_;  // per hash: the last site with such a value
  std::vector<Index> same_;  // per site: an earlier one with the same value
  std::array<Chance, 8> hits_;
  std::array<Chance, 33> longer_;
  uint32_t history_ = 0;
};

}  // namespace tutte::values
