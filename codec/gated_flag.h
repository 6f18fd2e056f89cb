#pragma once
// Flags that are mostly plain to see, and sometimes need several contexts at once.

#include <array>
#include <cstdint>
#include <vector>

#include "codec/mixer.h"

namespace tutte {

/// One binary decision: by one probability as long as that is nearly certain, and mixed from several contexts
/// otherwise.
template <size_t kInputs>
class GatedFlag {
 public:
  /// How many contexts the first probability and each input have; `weight_sets`: how many sets of weights to choose
  /// from.
  GatedFlag(uint32_t gates, const std::array<uint32_t, kInputs>& contexts, uint32_t weight_sets)
      : gates_(gates), weights_(weight_sets, initialWeights()) {
    for (size_t i = 0; i < kInputs; ++i) tables_[i].resize(contexts[i]);
  }

  /// `contextsOf()` gives the inputs' contexts; it is called only where they are wanted.
  template <class Port, class ContextsOf>
  [[gnu::always_inline]] bool code(Port& port, uint32_t gate, ContextsOf contextsOf, uint32_t weight_set, bool value) {
    Slot& slot = gates_[gate];
    const uint32_t one = slot.probability();
    const bool bit = isCertain(one) ? port.code(one, value) : mix(port, contextsOf(), weights_[weight_set], value);
    slot.update(bit);
    return bit;
  }

 private:
  static_assert(kInputs <= 8);
  static constexpr uint32_t kDoubt = 65536 / 16;

  static bool isCertain(uint32_t one) { return one < kDoubt || one > 65536 - kDoubt; }

  static Weights<8> initialWeights() {
    Weights<8> weights;
    for (size_t i = 0; i < kInputs; ++i) weights.weight[i] = 16384 * 13 / (10 * static_cast<int>(kInputs));
    return weights;
  }

  template <class Port>
  [[gnu::noinline]] bool mix(Port& port, const std::array<uint32_t, kInputs>& contexts, Weights<8>& weights,
                             bool value) {
    std::array<Slot*, kInputs> slots;
    std::array<int16_t, 8> opinions{};
    for (size_t i = 0; i < kInputs; ++i) {
      slots[i] = &tables_[i][contexts[i]];
      opinions[i] = slots[i]->stretched();
    }
    const Inputs<8> inputs{Lanes(opinions)};
    const uint32_t one = squash(weights.mix(inputs));
    const bool bit = port.code(one, value);
    const int32_t error = (bit ? 65536 : 0) - static_cast<int32_t>(one);
    if (!isLarge(error)) return bit;
    rate_.advance();
    weights.learn(inputs, rate_.step(error));
    for (Slot* slot : slots) slot->update(bit);
    return bit;
  }

  std::vector<Slot> gates_;
  std::array<std::vector<Slot>, kInputs> tables_;
  std::vector<Weights<8>> weights_;
  LearningRate rate_;
};

}  // namespace tutte
