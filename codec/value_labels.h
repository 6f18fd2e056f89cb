#pragma once
// Values that are names rather than numbers: each is one of a list, and likely what its neighbours have.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/value_graph.h"
#include "codec/value_model.h"

namespace tutte::values {

/// Codes labels below `count` site by site, as binary decisions from the highest bit on; each is predicted from the
/// labels around the site.
template <class Port>
class LabelCoder {
 public:
  LabelCoder(Port& port, const ValueGraph& graph, uint32_t count)
      : port_(port),
        graph_(graph),
        bits_(static_cast<int>(std::bit_width(count - 1))),
        count_(count),
        labels_(graph.siteCount(), kNone),
        slots_(size_t{kInputs} << kTableBits) {
    mixer_.fill(Mixer<kInputs>());
  }

  /// Codes the next site's label; a writer takes it from `labels`, which has all sites', a reader stores it there.
  void code(std::span<int32_t> labels) {
    const Index site = next_++;
    const auto label = static_cast<uint32_t>(labels[site]);
    const std::array<uint32_t, kInputs> contexts = contextsOf(site);
    uint32_t node = 1;  // the bits so far below a leading one
    for (int i = bits_ - 1; i >= 0; --i) {
      // Labels at or beyond the count do not exist: there a 1 is impossible.
      const uint32_t upper = ((node << 1 | 1) << i) - (1u << bits_);
      bool bit = false;
      if (upper < count_) bit = decide(contexts, node, label >> i & 1);
      node = node << 1 | static_cast<uint32_t>(bit);
    }
    labels_[site] = last_ = node - (1u << bits_);
    labels[site] = static_cast<int32_t>(last_);
  }

 private:
  static constexpr int kInputs = 5;
  static constexpr int kTableBits = 14;

  // Two labels beside the site, one across a face from it, and the one that was coded last.
  std::array<uint32_t, kInputs> contextsOf(Index site) const {
    std::array<uint32_t, 4> around;
    around.fill(kNone);
    uint32_t found = 0, agreeing = 0;
    for (const Index corner : graph_.corners(site)) {
      for (const Index other : {graph_.next(corner), graph_.prev(corner)}) {
        const uint32_t label = labels_[graph_.site(other)];
        if (label == kNone) continue;
        if (found < 2 && (found == 0 || label != around[0])) around[found++] = label;
        agreeing += label == around[0];
      }
      const uint32_t opposite = labels_[graph_.site(graph_.next(graph_.next(corner)))];
      if (opposite != kNone && around[2] == kNone) around[2] = opposite;
    }
    agreeing = std::min(agreeing, 3u);
    return {0u, around[0] * 4 + agreeing, around[0] * 0x10001u + around[1] * 3, around[2] * 0x8003u + around[0], last_};
  }

  bool decide(const std::array<uint32_t, kInputs>& contexts, uint32_t node, bool bit) {
    std::array<Chance*, kInputs> lines;
    for (uint32_t i = 0; i < kInputs; ++i) {
      const uint32_t hash = (contexts[i] * 0x9E3779B1u ^ node * 0x85EBCA6Bu) * 0xC2B2AE35u;
      lines[i] = &slots_[(size_t{i} << kTableBits) + (hash >> (32 - kTableBits))];
    }
    return mixer_[static_cast<size_t>(std::bit_width(node)) - 1].code(port_, lines, bit);
  }

  Port& port_;
  const ValueGraph& graph_;
  const int bits_;
  const uint32_t count_;
  Index next_ = 0;
  uint32_t last_ = 0;
  std::vector<uint32_t> labels_;  // per site; kNone: unknown
  std::vector<Chance> slots_;
  std::array<Mixer<kInputs>, 16> mixer_;
};

}  // namespace tutte::values
