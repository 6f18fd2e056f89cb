#pragma once
// The order in which values are coded.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Always one of the sites with the most known surroundings is next, so that most values are predicted by several
/// parallelograms. A function of the graph alone. O(corners) in all.
///
/// Per site: urge() others, then learn() it.
class SiteOrder {
 public:
  explicit SiteOrder(Index sites) : states_(sites, kUnknown) {}

  /// The next site; there must be one that is not known.
  Index next() {
    for (; top_ >= 0; --top_) {
      Stack& stack = stacks_[static_cast<size_t>(top_)];
      while (!stack.empty()) {
        const Index site = stack.pop();
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

  /// A site, which is not known, becomes more urgent, by 64 at most.
  void urge(Index site, Index amount) {
    const Index before = states_[site] - kUnknown;
    if (before >= kEnough) return;
    const Index now = before + amount + (before + amount == 0);
    states_[site] = kUnknown + now;
    const int level = kLevelOf[now];
    if (level == kLevelOf[before]) return;
    stacks_[static_cast<size_t>(level)].push(site);
    top_ = std::max(top_, level);
  }

 private:
  static constexpr int kLevels = 6;
  static constexpr Index kEnough = 1u << (kLevels - 1);  // has the highest level
  static constexpr Index kUnknown = 1u << 31;

  // One less than the number of binary digits of the score, at most 5; without a score no level.
  static constexpr std::array<int8_t, kEnough + 64> kLevelOf = [] {
    std::array<int8_t, kEnough + 64> levels{};
    for (unsigned score = 0; score < levels.size(); ++score) {
      levels[score] = static_cast<int8_t>(std::min(static_cast<int>(std::bit_width(score)) - 1, kLevels - 1));
    }
    return levels;
  }();

  class Stack {
   public:
    bool empty() const { return size_ == 0; }
    Index pop() { return sites_[--size_]; }
    void push(Index site) {
      if (size_ == room_) grow();
      sites_[size_++] = site;
    }

   private:
    [[gnu::noinline]] void grow() {
      std::unique_ptr<Index[]> larger(new Index[2 * room_]);
      std::copy_n(sites_.get(), size_, larger.get());
      sites_ = std::move(larger);
      room_ *= 2;
    }

    uint32_t size_ = 0, room_ = 64;
    std::unique_ptr<Index[]> sites_{new Index[room_]};
  };

  std::vector<Index> states_;  // the rank of a known site; kUnknown and the score of others
  std::array<Stack, kLevels> stacks_;
  int top_ = -1;  // no higher stack has anything
  Index seed_ = 0, known_ = 0;
};

}  // namespace tutte
