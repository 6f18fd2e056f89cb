#pragma once
// Binary decisions with several contexts at once.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "codec/value_model.h"
#include "codec/value_tables.h"

namespace tutte {

/// One binary decision from several contexts: the stretched probabilities that they suggest are weighed, and the
/// weights learn. Integers only.
template <size_t kInputs>
class MixedFlag {
 public:
  /// `contexts`: how many each input has; `weight_sets`: how many sets of weights to choose from.
  MixedFlag(const std::array<uint32_t, kInputs>& contexts, uint32_t weight_sets)
      : weights_(weight_sets, initialWeights()) {
    for (size_t i = 0; i < kInputs; ++i) tables_[i].resize(contexts[i]);
  }

  template <class Port>
  bool code(Port& port, const std::array<uint32_t, kInputs>& contexts, uint32_t weight_set, bool value) {
    std::array<int32_t, kInputs>& weights = weights_[weight_set];
    std::array<int32_t, kInputs> inputs;
    int64_t sum = 0;
    for (size_t i = 0; i < kInputs; ++i) {
      inputs[i] = tables_[i][contexts[i]].trusted();
      sum += int64_t{inputs[i]} * weights[i];
    }
    const int64_t limit = values::kStretchLimit;
    const int32_t one = values::kSquash[static_cast<size_t>(std::clamp(sum >> 16, -limit, limit) + 2048)];
    const bool bit = port.code(static_cast<uint32_t>(std::clamp(one, 24, 65512)), value);
    const int32_t error = ((bit ? 65535 : 0) - one) >> 4;
    for (size_t i = 0; i < kInputs; ++i) {
      weights[i] = std::clamp(weights[i] + ((inputs[i] * error + 512) >> 10), -kLargestWeight, kLargestWeight);
      tables_[i][contexts[i]].update(bit);
    }
    return bit;
  }

 private:
  static constexpr int32_t kLargestWeight = 1 << 20;

  static std::array<int32_t, kInputs> initialWeights() {
    std::array<int32_t, kInputs> weights;
    weights.fill(65536 * 13 / (10 * static_cast<int32_t>(kInputs)));
    return weights;
  }

  std::array<std::vector<values::Chance>, kInputs> tables_;
  std::vector<std::array<int32_t, kInputs>> weights_;
};

}  // namespace tutte
