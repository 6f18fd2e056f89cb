#pragma once
// Values that are names rather than numbers: each is one of a list, and likely what its neighbours have.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/gated_flag.h"
#include "codec/value_graph.h"

namespace tutte::values {

/// Codes labels below `count` site by site: whether it is that of a neighbour, or else, as binary decisions from the
/// highest bit on, which it is; each is predicted from the labels around the site.
template <class Port>
class LabelCoder {
 public:
  LabelCoder(Port& port, const ValueGraph& graph, uint32_t count)
      : port_(port),
        graph_(graph),
        bits_(static_cast<int>(std::bit_width(count - 1))),
        count_(count),
        table_bits_(std::clamp(static_cast<int>(std::bit_width(graph.siteCount())) + 1, 6, 14)),
        labels_(graph.siteCount(), kNone),
        digits_(tableSize(), {tableSize(), tableSize(), tableSize(), tableSize(), tableSize()}, 13) {}

  /// Codes the next site's label; a writer takes it from `labels`, which has all sites', a reader stores it there.
  void code(std::span<int32_t> labels) {
    const Index site = next_++;
    const auto label = static_cast<uint32_t>(labels[site]);
    const Around around = look(site);
    const auto contexts = contextsOf(around);
    uint32_t coded = around.beside[0];
    if (coded == kNone || !decide(contexts, kIsBeside, label == coded)) coded = codeDigits(contexts, label);
    labels_[site] = last_ = coded;
    labels[site] = static_cast<int32_t>(coded);
  }

 private:
  static constexpr int kInputs = 5, kGate = 1;
  static constexpr uint32_t kIsBeside = 0;  // in place of the digits that are known

  /// Labels around a site; kNone: there is none.
  struct Around {
    std::array<uint32_t, 2> beside{kNone, kNone};  ///< the first one, and the first that differs from it
    uint32_t across = kNone;                       ///< of a face
    uint32_t agreeing = 0;                         ///< how many beside it are the first one, at most 3
  };

  Around look(Index site) const {
    Around around;
    uint32_t found = 0, agreeing = 0;
    for (const Index corner : graph_.corners(site)) {
      for (const Index other : {graph_.next(corner), graph_.prev(corner)}) {
        const uint32_t label = labels_[graph_.site(other)];
        if (label == kNone) continue;
        if (found < 2 && (found == 0 || label != around.beside[0])) around.beside[found++] = label;
        agreeing += label == around.beside[0];
      }
      const uint32_t opposite = labels_[graph_.site(graph_.next(graph_.next(corner)))];
      if (opposite != kNone && around.across == kNone) around.across = opposite;
    }
    around.agreeing = std::min(agreeing, 3u);
    return around;
  }

  std::array<uint32_t, kInputs> contextsOf(const Around& around) const {
    const auto [first, second] = around.beside;
    return {0u, first * 4 + around.agreeing, first * 0x10001u + second * 3, around.across * 0x8003u + first, last_};
  }

  uint32_t codeDigits(const std::array<uint32_t, kInputs>& contexts, uint32_t label) {
    uint32_t node = 1;  // the bits so far below a leading one
    for (int i = bits_ - 1; i >= 0; --i) {
      // Labels at or beyond the count do not exist: there a 1 is impossible.
      const uint32_t upper = ((node << 1 | 1) << i) - (1u << bits_);
      bool bit = false;
      if (upper < count_) bit = decide(contexts, node, label >> i & 1);
      node = node << 1 | static_cast<uint32_t>(bit);
    }
    return node - (1u << bits_);
  }

  uint32_t tableSize() const { return 1u << table_bits_; }

  bool decide(const std::array<uint32_t, kInputs>& contexts, uint32_t node, bool bit) {
    const auto lineOf = [&](uint32_t context) {
      return ((context * 0x9E3779B1u ^ node * 0x85EBCA6Bu) * 0xC2B2AE35u) >> (32 - table_bits_);
    };
    const auto lines = [&] {
      std::array<uint32_t, kInputs> all;
      std::ranges::transform(contexts, all.begin(), lineOf);
      return all;
    };
    const auto digits = static_cast<uint32_t>(std::bit_width(node));
    return digits_.code(port_, lineOf(contexts[kGate]), lines, digits, bit);
  }

  Port& port_;
  const ValueGraph& graph_;
  const int bits_;
  const uint32_t count_;
  const int table_bits_;
  Index next_ = 0;
  uint32_t last_ = 0;
  std::vector<uint32_t> labels_;  // per site; kNone: unknown
  GatedFlag<kInputs> digits_;     // weights by how many are known; the first: is it beside?
};

}  // namespace tutte::values
