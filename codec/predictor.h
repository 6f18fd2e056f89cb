#pragma once
// One stream's binary decisions, each predicted in several contexts at once and mixed.
//
// A symbol is coded as a few decisions, its *nodes*. Before its first decision, every context of the symbol is hashed
// to a place in one table of slots. Node n has the slot at place XOR n: all are in one cache line of 16, and contexts
// that share a line mostly have their frequent nodes at different ends of it. Slots may collide, which costs a little
// compression and nothing else.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "codec/borrowed.h"
#include "codec/mesh.h"
#include "codec/mixer.h"
#include "codec/sure_run.h"

namespace tutte {

/// What a Predictor's table lies in. It remembers which lines were used, unless they were many, so that a small mesh
/// does not pay for clearing all of them.
class TableMemory {
 public:
  /// As many lines, as new.
  Slot* clear(size_t lines) {
    if (lines_.size() == lines && left_ > 0) {
      for (Index line : touched_) lines_[line] = Line();
    } else {
      lines_.assign(lines, Line());
    }
    touched_.clear();
    left_ = lines / 2;
    touched_.reserve(left_ + 16);
    return lines_.data()->slot.data();
  }

  /// To be told the places that are used for a symbol, as long as logs().
  template <size_t n>
  void touch(std::span<const uint32_t, n> places) {
    for (const uint32_t place : places) touched_.push_back(place / kNodes);
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

/// The table of `kContexts` contexts and, for more than one context, the weights. `kRich`: three weight sets and a
/// final map instead of one weight set. One more input is free for a matched prediction.
template <int kContexts, bool kRich>
class Predictor {
 public:
  static constexpr bool kMixes = kContexts > 1;
  static constexpr int kInputs = kContexts < 8 ? 8 : 16;
  static constexpr int kSituations = 320;
  static constexpr int kMatchLengths = 8;
  static constexpr int kSure = kRich ? 31 : 15;
  static_assert(kContexts < 16);

  /// A table of 2^line_bits lines, and 2^run_bits runs, as new.
  Predictor(int line_bits, int run_bits, TableMemory& memory)
      : shift_(64 - line_bits - kNodeBits), run_shift_(64 - run_bits), memory_(memory) {
    slots_ = memory_->clear(size_t{1} << line_bits);
    if (kMixes) memory_->runs.assign(size_t{1} << run_bits, {});
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
    run_ = &runs_[key * kHash >> run_shift_];
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

  /// Selects the places for a symbol.
  [[gnu::always_inline]] void enter(const std::array<uint64_t, kContexts>& keys) {
    for (uint64_t i = 0; i < kContexts; ++i) {
      place_[i] = static_cast<uint32_t>((keys[i] * kHash + i * kContextHash) >> shift_);
    }
    if (memory_->logs()) memory_->touch(std::span<const uint32_t>(place_).template first<kContexts>());
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
    Slot& slot = slots_[place_[0] ^ static_cast<uint32_t>(selectors.node)];
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
  using Places = std::array<uint32_t, kMixes ? kInputs : 1>;  // more than contexts, so that they fill registers

  template <bool kMatched, class Port>
  [[gnu::always_inline]] bool mixed(Port& port, Selectors selectors, Slot* match, int match_length, bool value) {
    constexpr int kUsed = kContexts + kMatched;
    const Places at = placesAt(selectors.node);
    const auto inputs = inputsOf<kUsed>(at, match, std::make_index_sequence<kInputs / 8>());
    const int32_t error = decide(port, selectors, inputs, match_length, value);
    const bool bit = error > 0;
    if (!isLarge(error)) return bit;
    // All are read before any is written: a slot that contexts share learns once.
    using Eight = std::make_index_sequence<8>;
    const auto words = updated<0, kUsed>(at, match, bit, Eight());
    if constexpr (kUsed > 8) setWords<8, kUsed>(at, match, updated<8, kUsed>(at, match, bit, Eight()), Eight());
    setWords<0, kUsed>(at, match, words, Eight());
    return bit;
  }

  // Where a node's slots are.
  [[gnu::always_inline]] Places placesAt(int node) const {
    Places at;
    for (size_t i = 0; i < at.size(); ++i) at[i] = place_[i] ^ static_cast<uint32_t>(node);
    return at;
  }

  // The slot of an input; what has none is `match`.
  template <int kInput>
  [[gnu::always_inline]] Slot& slotOf(const Places& at, Slot* match) const {
    if constexpr (kInput < kContexts) return slots_[at[kInput]];
    return *match;
  }

  template <int kUsed, size_t... group>
  [[gnu::always_inline]] Inputs<kInputs> inputsOf(const Places& at, Slot* match, std::index_sequence<group...>) const {
    return {opinionsOf<8 * group, kUsed>(at, match, std::make_index_sequence<8>())...};
  }

  // Inputs that are not used have no opinion.
  template <int kFirst, int kUsed, size_t... i>
  [[gnu::always_inline]] Lanes opinionsOf(const Places& at, Slot* match, std::index_sequence<i...>) const {
    return Lanes({(kFirst + i < kUsed ? slotOf<kFirst + i>(at, match).stretched() : int16_t{0})...});
  }

  template <int kFirst, int kUsed, size_t... i>
  [[gnu::always_inline]] std::array<uint32_t, 8> updated(const Places& at, Slot* match, bool bit,
                                                         std::index_sequence<i...>) {
    return updatedSlots({(kFirst + i < kUsed ? slotOf<kFirst + i>(at, match).word() : 0)...}, bit);
  }

  template <int kFirst, int kUsed, size_t... i>
  [[gnu::always_inline]] void setWords(const Places& at, Slot* match, const std::array<uint32_t, 8>& words,
                                       std::index_sequence<i...>) {
    ((kFirst + i < kUsed ? slotOf<kFirst + i>(at, match).setWord(words[i]) : void()), ...);
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

  static constexpr uint64_t kHash = 0x9E3779B97F4A7C15u, kContextHash = 0xD1B54A32D192ED03u;

  int shift_, run_shift_;
  Borrowed<TableMemory> memory_;
  Slot* slots_ = nullptr;
  Places place_{};
  TableMemory::Run* runs_ = nullptr;  // by key: how often in a row the first decision was a yes
  TableMemory::Run* run_ = nullptr;
  std::conditional_t<kRich, RichWeights, PlainWeights> weights_;
  LearningRate rate_;
  [[no_unique_address]] std::conditional_t<kRich, FinalMap<kNodes>, NoMap> final_;
};

}  // namespace tutte
