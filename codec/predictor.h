#pragma once
// One stream's binary decisions, each predicted in several contexts at once and mixed.
//
// A symbol is coded as a few decisions, its *nodes*. Before its first decision, every context of the symbol is hashed
// to a *line* of 16 slots, one per node; lines may collide, which costs a little compression and nothing else.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "codec/borrowed.h"
#include "codec/mesh.h"
#include "codec/mixer.h"
#include "codec/sure_run.h"

namespace tutte {

inline constexpr int kNodes = 16;

struct alignas(64) Line {
  std::array<Slot, kNodes> slot;
};

/// What a Predictor's tables lie in. It remembers which lines were used, unless they were many, so that a small mesh
/// does not pay for clearing all of them.
class TableMemory {
 public:
  /// As many lines, as new. They belong to contexts by as many lines.
  Line* clear(size_t lines) {
    if (lines_.size() == lines && left_ > 0) {
      for (Index line : touched_) lines_[line] = Line();
    } else {
      lines_.assign(lines, Line());
    }
    touched_.clear();
    left_ = lines / 2;
    touched_.reserve(left_ + 16);
    return lines_.data();
  }

  /// To be told the lines that are used for a symbol, as long as logs().
  template <size_t n>
  void touch(const std::array<Line*, n>& lines) {
    for (Line* line : lines) touched_.push_back(static_cast<Index>(line - lines_.data()));
    left_ -= std::min(left_, n);
  }
  bool logs() const { return left_ > 0; }

  using Run = SureRun<8>;
  std::vector<Run> runs;

 private:
  std::vector<Line> lines_;
  std::vector<Index> touched_;
  size_t left_ = 0;
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
  static constexpr int kSure = kRich ? 31 : 15;
  static_assert(kContexts < 16);

  /// Tables of 2^table_bits lines, as new.
  Predictor(int table_bits, TableMemory& memory)
      : shift_(64 - table_bits), table_lines_(size_t{1} << table_bits), memory_(memory) {
    lines_ = memory_->clear(table_lines_ * kContexts);
    if (kMixes) memory_->runs.assign(table_lines_, {});
    runs_ = memory_->runs.data();
    weights_.by_node.fill(kInitial);
    if constexpr (kRich) {
      weights_.by_situation.fill(kInitial);
      weights_.by_match.fill(kInitial);
    }
  }

  /// With several contexts: has the first decision always been a yes lately where this key stood? Most of a regular
  /// mesh is coded so, without looking at any context.
  [[gnu::always_inline]] bool isSure(uint64_t key) {
    if constexpr (!kMixes) return false;
    run_ = &runs_[key * 0x9E3779B97F4A7C15u >> shift_];
    return run_->isSure(kSure);
  }

  /// Codes a first decision of which isSure() said so.
  template <class Port>
  [[gnu::always_inline]] bool codeSure(Port& port, bool value) {
    return run_->code(port, value);
  }

  /// To be told every other first decision, after isSure().
  [[gnu::always_inline]] void noteFirst(bool bit) {
    if constexpr (!kMixes) return;
    run_->note(bit);
  }

  /// Selects the lines for a symbol.
  [[gnu::always_inline]] void enter(const std::array<uint64_t, kContexts>& keys) {
    Line* table = lines_;
    for (int i = 0; i < kContexts; ++i, table += table_lines_) {
      line_[i] = &table[keys[i] * 0x9E3779B97F4A7C15u >> shift_];
    }
    if (memory_->logs()) memory_->touch(line_);
  }

  /// Codes one decision.
  template <class Port>
  bool code(Port& port, Selectors selectors, bool value) requires(kMixes) {
#if defined(TUTTE_COMPACT)
    Slot unused;  // without an opinion, so that there is one text for both
    return code(port, selectors, unused, 0, value);
#else
    return mixed<false>(port, selectors, nullptr, 0, value);
#endif
  }
  template <class Port>
  [[gnu::always_inline]] bool code(Port& port, Selectors selectors, bool value) requires(!kMixes) {
    Slot& slot = line_[0]->slot[selectors.node];
    const bool bit = port.code(slot.probability(), value);
    slot.update(bit);
    return bit;
  }

  /// Likewise, with a slot that has its own opinion. `match_length` 0 to 7.
  template <class Port>
  bool code(Port& port, Selectors selectors, Slot& match, int match_length, bool value) {
    return mixed<true>(port, selectors, &match, match_length, value);
  }

 private:
  template <bool kMatched, class Port>
  [[gnu::always_inline]] bool mixed(Port& port, Selectors selectors, Slot* match, int match_length, bool value) {
    constexpr int kUsed = kContexts + kMatched;
    const auto inputs = inputsOf<kUsed>(selectors.node, match, std::make_index_sequence<kInputs / 8>());
    const int32_t error = decide(port, selectors, inputs, match_length, value);
    const bool bit = error > 0;
    if (!isLarge(error)) return bit;
    update<0, kUsed>(selectors.node, match, bit, std::make_index_sequence<8>());
    if constexpr (kUsed > 8) update<8, kUsed>(selectors.node, match, bit, std::make_index_sequence<8>());
    return bit;
  }

  // The slot of an input; what has none is `match`.
  template <int kInput>
  [[gnu::always_inline]] Slot& slotOf(int node, Slot* match) const {
    if constexpr (kInput < kContexts) return line_[kInput]->slot[node];
    return *match;
  }

  template <int kUsed, size_t... group>
  [[gnu::always_inline]] Inputs<kInputs> inputsOf(int node, Slot* match, std::index_sequence<group...>) const {
    return {opinionsOf<8 * group, kUsed>(node, match, std::make_index_sequence<8>())...};
  }

  // Inputs that are not used have no opinion.
  template <int kFirst, int kUsed, size_t... i>
  [[gnu::always_inline]] Lanes opinionsOf(int node, Slot* match, std::index_sequence<i...>) const {
    return Lanes({(kFirst + i < kUsed ? slotOf<kFirst + i>(node, match).stretched() : int16_t{0})...});
  }

  template <int kFirst, int kUsed, size_t... i>
  [[gnu::always_inline]] void update(int node, Slot* match, bool bit, std::index_sequence<i...>) {
    const auto words = updatedSlots({(kFirst + i < kUsed ? slotOf<kFirst + i>(node, match).word() : 0)...}, bit);
    ((kFirst + i < kUsed ? slotOf<kFirst + i>(node, match).setWord(words[i]) : void()), ...);
  }

  // Nothing is learned from what was as good as certain: that takes fewer bytes than learning from all, and less time.
  // `error`: what the probability of a 1 lacked, in 1/65536.
  static bool isLarge(int32_t error) {
    constexpr int32_t kLeast = 1024;
    return static_cast<uint32_t>(error + (kLeast - 1)) > 2 * (kLeast - 1);
  }

  // Returns the error: above 0 if the decision is a 1, else below.
  template <class Port>
  [[gnu::always_inline]] int32_t decide(Port& port, Selectors selectors, const Inputs<kInputs>& inputs,
                                        int match_length, bool value) {
    if constexpr (kRich) {
      return decideRich(port, selectors, inputs, match_length, value);
    } else {
      Weights<kInputs>& weights = weights_.by_node[selectors.node];
      const uint32_t mixed = squash(weights.mix(inputs));
      const int32_t error = (port.code(mixed, value) ? 65536 : 0) - static_cast<int32_t>(mixed);
      if (!isLarge(error)) return error;
      rate_.advance();
      weights.learn(inputs, rate_.step(error));
      return error;
    }
  }

  template <class Port>
  [[gnu::always_inline]] int32_t decideRich(Port& port, Selectors selectors, const Inputs<kInputs>& inputs,
                                            int match_length, bool value) {
    Weights<kInputs>& by_node = weights_.by_node[selectors.node];
    Weights<kInputs>& by_situation = weights_.by_situation[selectors.situation];
    Weights<kInputs>& by_match = weights_.by_match[match_length];
    const int32_t first = by_node.mix(inputs), second = by_situation.mix(inputs), third = by_match.mix(inputs);
    const int32_t average = (first + second + third) * 21845 >> 16;
    const uint32_t refined = final_.refine(selectors.node, average);
    const uint32_t mixed = std::clamp((squash(average) + refined + 1) >> 1, 2u, 65534u);
    const bool bit = port.code(mixed, value);
    final_.update(bit);
    const int32_t error = (bit << 16) - static_cast<int32_t>(mixed);
    if (!isLarge(error)) return error;
    rate_.advance();
    const auto learn = [&](Weights<kInputs>& set, int32_t opinion) {
      set.learn(inputs, rate_.step((bit << 16) - static_cast<int32_t>(squash(opinion))));
    };
    learn(by_node, first);
    learn(by_situation, second);
    learn(by_match, third);
    return error;
  }

  struct PlainWeights {
    std::array<Weights<kInputs>, kNodes> by_node;
  };
  struct RichWeights : PlainWeights {
    std::array<Weights<kInputs>, kSituations> by_situation;
    std::array<Weights<kInputs>, kMatchLengths> by_match;
  };
  struct NoMap {};

  static constexpr Weights<kInputs> kInitial = [] {
    Weights<kInputs> weights;
    weights.weight.fill(static_cast<int16_t>(std::min(27 * 16384 / 100, 189 * 16384 / (100 * (kContexts + 1)))));
    return weights;
  }();

  int shift_;
  size_t table_lines_;
  Borrowed<TableMemory> memory_;
  Line* lines_ = nullptr;
  std::array<Line*, kContexts> line_{};
  TableMemory::Run* runs_ = nullptr;  // by key: how often in a row the first decision was a yes
  TableMemory::Run* run_ = nullptr;
  std::conditional_t<kRich, RichWeights, PlainWeights> weights_;
  LearningRate rate_;
  [[no_unique_address]] std::conditional_t<kRich, FinalMap<kNodes>, NoMap> final_;
};

}  // namespace tutte
