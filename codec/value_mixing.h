#pragma once
// Adaptive coding of residuals digit by digit, every decision mixed from eight contexts. Small, not fast.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "codec/mesh.h"
#include "codec/mixer.h"
#include "codec/value_expectation.h"
#include "codec/value_model.h"

namespace tutte::values {

/// Codes residuals by their bit length (a walk up or down from the expected one, by mixed contexts), sign and digits.
class MixingCoder {
 public:
  static constexpr bool wantsAll() { return true; }

  /// The more sites, the larger the table.
  explicit MixingCoder(Index sites) : line_bits_(lineBitsFor(sites)), lines_(size_t{1} << line_bits_) {
    Weights<kInputs> initial;
    initial.weight.fill(kInitialWeight);
    weights_.fill(initial);
  }

  template <class Port>
  [[gnu::noinline]] int32_t code(Port& port, const Expectation& about, int32_t residual) {
    const auto magnitude = static_cast<uint32_t>(residual < 0 ? -residual : residual);
    const int expected = std::min(bitLength(static_cast<uint32_t>(about.estimate * 3 >> 6)), kLongest);
    const int length = codeLength(port, about, expected, static_cast<int>(std::bit_width(magnitude)));
    last_[static_cast<size_t>(about.rank)] = static_cast<uint32_t>(std::min(length, 15));
    if (length == 0) return 0;
    Chance& sign = signs_[static_cast<size_t>((signContext(about) * 3 + about.rank) * 3 + std::min(length, 3) - 1)];
    const bool negative = sign.code(port, residual < 0);
    const int digits = about.rank * 8 + std::clamp(length - expected, -3, 4) + 3;
    const auto decoded = static_cast<int32_t>(codeDigits(port, digits, length, magnitude));
    return negative ? -decoded : decoded;
  }

 private:
  static constexpr int kInputs = 8;
  static constexpr int kLongest = 18;  // of expected lengths
  static constexpr uint32_t kLengths = kLongest + 1;
  static constexpr int kBins = kNodes;  // "longer than expected?", eight steps up, seven steps down
  static constexpr int kUp = 1, kDown = 9;
  static constexpr int kLongestResidual = 30;
  static constexpr int16_t kInitialWeight = 16384 * 21 / 100;

  // Where the lines of each context begin.
  static constexpr std::array<uint32_t, kInputs + 1> kStarts = [] {
    constexpr std::array<uint32_t, kInputs> kCounts = {
        64 * 3 * 4,        15 * 4 * kLengths, 12 * 16 * kLengths, 3 * 4 * 16 * kLengths,
        16 * 3 * kLengths, 16 * 3 * kLengths, 16 * 4 * kLengths,  16 * 3 * kLengths};
    std::array<uint32_t, kInputs + 1> starts{};
    for (size_t i = 0; i < kInputs; ++i) starts[i + 1] = starts[i] + kCounts[i];
    return starts;
  }();

  static constexpr int kSigns = 8 * 3;
  static int signContext(const Expectation& about) {
    return static_cast<int>((about.fraction & 15) >> 1) * 3 + (about.side > 0) - (about.side < 0) + 1;
  }

  using Places = std::array<uint32_t, kInputs>;

  // About a line per site; where there are many, a third.
  static int lineBitsFor(Index sites) {
    const int bits = static_cast<int>(std::bit_width(sites));
    return std::clamp(bits - 2, std::clamp(bits, 5, 9), 12);
  }

  // All contexts share the slots. Bin b has the slot at a context's place XOR b.
  Places placesOf(const Expectation& about, int expected) const {
    const int level = about.level();
    const auto rank = static_cast<uint32_t>(about.rank), e = static_cast<uint32_t>(expected);
    Places places = {
        (static_cast<uint32_t>(level) * 3 + rank) * 4 + about.members,
        (about.relative(about.spread, level, -7, 7) * 4 + about.members) * kLengths + e,
        (about.relative(about.near, level, -5, 6) * 16 + about.relative(about.widest, level, -7, 8)) * kLengths + e,
        ((about.source * 4 + about.members) * 16 + about.relative(about.all, level, -7, 8)) * kLengths + e,
        (about.relative(about.so_far, level, -7, 8) * 3 + rank) * kLengths + e,
        (about.relative(about.apart, level, -7, 8) * 3 + rank) * kLengths + e,
        ((about.fraction & 15) * 4 + about.members) * kLengths + e,
        (last_[rank] * 3 + rank) * kLengths + e};
    const int shift = 32 - kNodeBits - line_bits_;
    for (size_t i = 0; i < kInputs; ++i) places[i] = (places[i] + kStarts[i]) * 0x9E3779B1u >> shift;
    return places;
  }

  template <class Port>
  int codeLength(Port& port, const Expectation& about, int expected, int length) {
    const Places places = placesOf(about, expected);
    int at = expected;
    if (decide(port, places, about.rank, 0, length > at)) {
      for (int bin = kUp; ++at < kLongestResidual; bin += bin < kDown - 1) {
        if (!decide(port, places, about.rank, bin, length > at)) break;
      }
    } else {
      for (int bin = kDown; at > 0; --at, bin += bin < kBins - 1) {
        if (!decide(port, places, about.rank, bin, length < at)) break;
      }
    }
    return at;
  }

  template <class Port>
  bool decide(Port& port, const Places& places, int rank, int bin, bool value) {
    return decide(port, places, static_cast<size_t>(rank * kBins + bin), static_cast<uint32_t>(bin), value,
                  std::make_index_sequence<kInputs>());
  }

  template <class Port, size_t... i>
  [[gnu::always_inline]] bool decide(Port& port, const Places& places, size_t kind, uint32_t bin, bool value,
                                     std::index_sequence<i...>) {
    Slot* const slots = lines_.data()->slot.data();
    const Inputs<kInputs> inputs{Lanes({slots[places[i] ^ bin].stretched()...})};
    Weights<kInputs>& weights = weights_[kind];
    const uint32_t mixed = squash(weights.mix(inputs));
    const bool bit = port.code(std::clamp(mixed, 24u, 65512u), value);
    rate_.advance();
    weights.learn(inputs, rate_.step((bit << 16) - static_cast<int32_t>(mixed)));
    const auto words = updatedSlots({slots[places[i] ^ bin].word()...}, bit);
    (slots[places[i] ^ bin].setWord(words[i]), ...);
    return bit;
  }

  // The two digits below the leading one are adaptive, the others plain.
  template <class Port>
  uint32_t codeDigits(Port& port, int context, int length, uint32_t magnitude) {
    uint32_t value = 1;
    int rest = length - 1;
    if (rest > 0) {
      --rest;
      value = value << 1 | static_cast<uint32_t>(digits_[context].code(port, magnitude >> rest & 1));
    }
    if (rest > 0) {
      --rest;
      value = value << 1 | static_cast<uint32_t>(seconds_[context * 2 + (value & 1)].code(port, magnitude >> rest & 1));
    }
    if (rest == 0) return value;
    return value << rest | port.bits(rest, magnitude & ((1u << rest) - 1));
  }

  int line_bits_;
  std::vector<Line> lines_;
  std::array<Weights<kInputs>, 3 * kBins> weights_;
  LearningRate rate_;
  std::array<uint32_t, 3> last_{};  // lengths, by rank
  std::array<Chance, kSigns * 3 * 3> signs_;
  std::array<Chance, 3 * 8> digits_;
  std::array<Chance, 3 * 8 * 2> seconds_;
};

}  // namespace tutte::values
