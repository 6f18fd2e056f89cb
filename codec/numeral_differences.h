#pragma once
// Differences between numbers and what was expected of them.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "codec/mixed_flag.h"
#include "codec/value_model.h"

namespace tutte::numerals {

/// Differences of any size up to 2^46: bit length from the expected one on, sign, two adaptive digits, plain digits.
template <class Port>
class DifferenceCoder {
 public:
  struct Context {
    int kind = 0;        ///< below kKinds
    int expected = 0;    ///< bit length, 0 to 31
    uint32_t size = 0;   ///< of the expected difference: two steps per doubling, 0 to 63
    uint32_t ratio = 0;  ///< of disagreement and expectation, 0 to 14
    uint32_t members = 0;
  };
  static constexpr int kKinds = 5;

  explicit DifferenceCoder(Port& port)
      : port_(port), lengths_({64 * kKinds * 4 * kBins, 15 * 4 * 32 * kBins}, kKinds * kBins) {}

  int64_t code(const Context& context, int64_t difference) {
    const auto magnitude = static_cast<uint64_t>(difference < 0 ? -difference : difference);
    const int length = codeLength(context, static_cast<int>(std::bit_width(magnitude)));
    if (length == 0) return 0;
    const bool negative = signs_[context.kind * 3 + std::min(length, 3) - 1].code(port_, difference < 0);
    const auto decoded = static_cast<int64_t>(codeDigits(context, length, magnitude));
    return negative ? -decoded : decoded;
  }

 private:
  static constexpr int kBins = 19;  // "longer than expected?", ten steps up, eight steps down
  static constexpr int kUp = 1, kDown = 11, kLongest = 46;

  int codeLength(const Context& context, int length) {
    const uint32_t first = ((context.size * kKinds + context.kind) * 4 + context.members) * kBins;
    const uint32_t second = ((context.ratio * 4 + context.members) * 32 + context.expected) * kBins;
    const auto decide = [&](int bin, bool value) {
      const auto b = static_cast<uint32_t>(bin);
      return lengths_.code(port_, {first + b, second + b}, static_cast<uint32_t>(context.kind) * kBins + b, value);
    };
    int at = context.expected;
    if (decide(0, length > at)) {
      for (int bin = kUp; ++at < kLongest; bin += bin < kDown - 1) {
        if (!decide(bin, length > at)) break;
      }
    } else {
      for (int bin = kDown; at > 0; --at, bin += bin < kBins - 1) {
        if (!decide(bin, length < at)) break;
      }
    }
    return at;
  }

  uint64_t codeDigits(const Context& context, int length, uint64_t magnitude) {
    uint64_t value = 1;
    int rest = length - 1;
    const int off = context.kind * 8 + std::clamp(length - context.expected, -3, 4) + 3;
    if (rest > 0) {
      --rest;
      value = value << 1 | uint64_t{firsts_[off].code(port_, magnitude >> rest & 1)};
    }
    if (rest > 0) {
      --rest;
      value = value << 1 | uint64_t{seconds_[off * 2 + (value & 1)].code(port_, magnitude >> rest & 1)};
    }
    while (rest > 0) {
      const int chunk = std::min(rest, 16);
      rest -= chunk;
      const uint32_t mask = (1u << chunk) - 1;
      value = value << chunk | port_.uniform(mask + 1, static_cast<uint32_t>(magnitude >> rest) & mask);
    }
    return value;
  }

  Port& port_;
  MixedFlag<2> lengths_;
  std::array<values::Chance, kKinds * 3> signs_;
  std::array<values::Chance, kKinds * 8> firsts_;
  std::array<values::Chance, kKinds * 8 * 2> seconds_;
};

}  // namespace tutte::numerals
