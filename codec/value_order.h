#pragma once
// The order in which values are coded.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/value_graph.h"

namespace tutte {

/// Sites that have become more urgent, and by how much, after one site has become known.
class Urgencies {
 public:
  /// A site, and in the upper half by how much.
  using Entry = uint64_t;

  /// Whether a site is known is hard to foresee, so nothing is decided here: the list grows by 0 or 1.
  void add(Index site, Index amount, bool really) {
    entries_[count_] = Entry{amount} << 32 | site;
    count_ += really;
  }

  void clear() { count_ = 0; }
  std::span<const Entry> entries() const { return {entries_.data(), count_}; }

 private:
  // Of each corner two sites beside it, and one that is opposite.
  std::array<Entry, 3 * CornerList::kMost + 1> entries_;
  size_t count_ = 0;
};

/// Always one of the sites with the most known surroundings is next, so that most values are predicted by several
/// parallelograms. A function of the graph alone. O(corners) in all.
///
/// Per site: urge(), then learn().
class SiteOrder {
 public:
  explicit SiteOrder(Index sites) : states_(sites, kUnknown) {
    for (Stack& stack : stacks_) stack.sites.resize(64);
  }

  /// The next site; there must be one that is not known.
  Index next() {
    for (; top_ >= 0; --top_) {
      Stack& stack = stacks_[top_];
      while (stack.size > 0) {
        const Index site = stack.sites[--stack.size];
        if (!known(site)) return site;
      }
    }
    while (known(seed_)) ++seed_;
    return seed_;
  }

  /// How many sites were known before that one; unknown ones have larger numbers than that.
  Index rank(Index site) const { return states_[site]; }
  static constexpr bool isRank(Index rank) { return rank < kUnknown; }
  bool known(Index site) const { return isRank(rank(site)); }
  std::span<const Index> ranks() const { return states_; }
  Index knownCount() const { return known_; }

  /// A site is known from now on.
  void learn(Index site) { states_[site] = known_++; }

  /// The sites must not be known.
  void urge(std::span<const Urgencies::Entry> entries) {
    for (const Urgencies::Entry entry : entries) {
      const auto site = static_cast<Index>(entry), amount = static_cast<Index>(entry >> 32);
      const unsigned before = states_[site] - kUnknown;
      const unsigned now = std::clamp(before + amount, 1u, kMost);
      states_[site] = kUnknown + now;
      const unsigned level = kLevelOf[now];
      const bool rises = level != kLevelOf[before];
      Stack& stack = stacks_[level];
      stack.sites[stack.size] = site;
      stack.size += rises;
      if (stack.size == stack.sites.size()) stack.sites.resize(2 * stack.size);
      top_ = rises ? std::max(top_, static_cast<int>(level)) : top_;
    }
  }

 private:
  static constexpr int kLevels = 6;
  static constexpr unsigned kMost = 253;
  static constexpr Index kUnknown = 1u << 31;

  // One less than the number of binary digits of the score, at most 5; without a score no level.
  static constexpr std::array<uint8_t, kMost + 1> kLevelOf = [] {
    std::array<uint8_t, kMost + 1> levels{};
    for (unsigned score = 0; score <= kMost; ++score) {
      levels[score] = static_cast<uint8_t>(std::min<unsigned>(static_cast<unsigned>(std::bit_width(score)) - 1, 5));
    }
    levels[0] = 255;
    return levels;
  }();

  struct Stack {
    std::vector<Index> sites;  // with room for one more
    size_t size = 0;
  };

  std::vector<Index> states_;  // the rank of a known site; kUnknown and the score of others
  std::array<Stack, kLevels> stacks_;
  int top_ = -1;  // no higher stack has anything
  Index seed_ = 0, known_ = 0;
};

}  // namespace tutte
