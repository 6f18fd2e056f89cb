#pragma once
// One stream's binary decisions, each predicted in several contexts at once and mixed.
//
// A symbol is coded as a few decisions, its *nodes*. Before its first decision, every context of the symbol is hashed
// to a *line* of 16 slots, one per node; lines may collide, which costs a little compression and nothing else.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "codec/mixer.h"

namespace tutte {

inline constexpr int kNodes = 16;

struct alignas(64) Line {
  std::array<Slot, kNodes> slot;
};

/// Which weights and corrections serve a decision.
struct Selectors {
  int node = 0;       ///< 0 to kNodes - 1
  int situation = 0;  ///< 0 to kSituations - 1
};

/// `kContexts` tables and, for more than one context, the weights. `kRich`: three weight sets and a final map instead
/// of one weight set. One more input is free for a matched prediction.
template <int kContexts, bool kRich>
class Predictor {
 public:
  static constexpr bool kMixes = kContexts > 1;
  static constexpr int kInputs = kContexts < 8 ? 8 : 16;
  static constexpr int kSituations = 512;
  static constexpr int kMatchLengths = 8;
  static_assert(kContexts < 16);

  /// Tables of 2^table_bits lines.
  explicit Predictor(int table_bits)
      : shift_(64 - table_bits), table_lines_(size_t{1} << table_bits), lines_(table_lines_ * kContexts) {
    if constexpr (!kMixes) return;
    Weights<kInputs> initial;
    initial.weight.fill(static_cast<int16_t>(std::min(27 * 16384 / 100, 189 * 16384 / (100 * (kContexts + 1)))));
    by_node_.assign(kNodes, initial);
    if constexpr (kRich) {
      by_situation_.assign(kSituations, initial);
      by_match_.assign(kMatchLengths, initial);
    }
  }

  /// Selects the lines for a symbol.
  [[gnu::always_inline]] void enter(const std::array<uint64_t, kContexts>& keys) {
    Line* table = lines_.data();
    for (int i = 0; i < kContexts; ++i, table += table_lines_) {
      line_[i] = &table[keys[i] * 0x9E3779B97F4A7C15u >> shift_];
    }
  }

  /// Codes one decision. `match`: a slot that has its own opinion, or null; `match_length` 0 to 7.
  template <class Port>
  bool code(Port& port, const Selectors& selectors, Slot* match, int match_length, bool value) {
    return codeOver(port, selectors, match, match_length, value, std::make_index_sequence<kContexts>());
  }

 private:
  template <class Port, size_t... i>
  [[gnu::always_inline]] bool codeOver(Port& port, const Selectors& selectors, Slot* match, int match_length,
                                       bool value, std::index_sequence<i...>) {
    if constexpr (!kMixes) {
      Slot& slot = line_[0]->slot[selectors.node];
      const bool bit = port.code(std::clamp(slot.probability(), 16u, 65520u), value);
      slot.update(bit);
      return bit;
    } else {
      Slot nobody;
      std::array<uint32_t*, kInputs> slots{line_[i]->slot[selectors.node].word()..., (match ? match : &nobody)->word()};
      for (int unused = kContexts + 1; unused < kInputs; ++unused) slots[unused] = nobody.word();
      SlotGroups groups = groupsOf(slots, std::make_index_sequence<kInputs / 8>());
      const Inputs<kInputs> inputs = inputsOf(groups, std::make_index_sequence<kInputs / 8>());
      const bool bit = kRich ? codeRich(port, selectors, inputs, match_length, value)
                             : codePlain(port, by_node_[selectors.node], inputs, value);
      for (SlotGroup& group : groups) group.update(bit);
      return bit;
    }
  }

  using SlotGroups = std::array<SlotGroup, kInputs / 8>;

  template <size_t... g>
  [[gnu::always_inline]] static SlotGroups groupsOf(const std::array<uint32_t*, kInputs>& at,
                                                    std::index_sequence<g...>) {
    return {SlotGroup({at[8 * g], at[8 * g + 1], at[8 * g + 2], at[8 * g + 3], at[8 * g + 4], at[8 * g + 5],
                       at[8 * g + 6], at[8 * g + 7]})...};
  }

  template <size_t... g>
  [[gnu::always_inline]] static Inputs<kInputs> inputsOf(const SlotGroups& groups, std::index_sequence<g...>) {
    return {groups[g].stretched()...};
  }

  template <class Port>
  [[gnu::always_inline]] bool codePlain(Port& port, Weights<kInputs>& weights, const Inputs<kInputs>& inputs,
                                        bool value) {
    const uint32_t mixed = squash(weights.mix(inputs));
    const bool bit = port.code(mixed, value);
    rate_.advance();
    weights.learn(inputs, rate_.step((bit << 16) - static_cast<int32_t>(mixed)));
    return bit;
  }

  template <class Port>
  [[gnu::always_inline]] bool codeRich(Port& port, const Selectors& selectors, const Inputs<kInputs>& inputs,
                                       int match_length, bool value) {
    Weights<kInputs>* const sets[3] = {&by_node_[selectors.node], &by_situation_[selectors.situation],
                                       &by_match_[match_length]};
    const int32_t opinions[3] = {sets[0]->mix(inputs), sets[1]->mix(inputs), sets[2]->mix(inputs)};
    const int32_t average = (opinions[0] + opinions[1] + opinions[2]) * 21845 >> 16;
    const uint32_t refined = final_.refine(selectors.node, average);
    const uint32_t mixed = std::clamp((squash(average) + refined + 1) >> 1, 2u, 65534u);
    const bool bit = port.code(mixed, value);
    rate_.advance();
    for (int i = 0; i < 3; ++i) {
      sets[i]->learn(inputs, rate_.step((bit << 16) - static_cast<int32_t>(squash(opinions[i]))));
    }
    final_.update(bit);
    return bit;
  }

  int shift_;
  size_t table_lines_;
  std::vector<Line> lines_;
  std::array<Line*, kContexts> line_{};
  std::vector<Weights<kInputs>> by_node_, by_situation_, by_match_;
  LearningRate rate_;
  FinalMap final_{kRich ? kNodes : 0};
};

}  // namespace tutte
