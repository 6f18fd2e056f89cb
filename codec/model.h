#pragma once
// Adaptive statistics. Integers only, so that every platform makes the same bytes.

#include <array>
#include <bit>
#include <cstdint>

#include "codec/made_table.h"
#include "codec/mesh.h"
#include "codec/range_coder.h"

namespace tutte {

/// An adaptive binary probability: fast at first, then ever slower, as the average over about 255 decisions.
class Bit {
 public:
  template <class Port>
  bool code(Port& port, bool value) {
    const bool bit = port.code(clamped(), value);
    update(bit);
    return bit;
  }

  Probability clamped() const { return one_ < 32 ? 32u : one_ > 65504 ? 65504u : one_; }

  void update(bool bit) {
    const int32_t target = bit ? 65535 : 0;
    one_ = static_cast<uint16_t>(one_ + ((target - static_cast<int32_t>(one_)) * kRate[seen_] >> 16));
    if (seen_ < 255) ++seen_;
  }

 private:
  // 65536 / (n + 1.9), as integers.
  static TUTTE_TABLE std::array<int32_t, 256> kRate = madeTable([] {
    std::array<int32_t, 256> rate{};
    for (int n = 0; n < 256; ++n) rate[n] = 655360 / (10 * n + 19);
    return rate;
  });

  uint16_t one_ = 32768;
  uint16_t seen_ = 0;
};

/// Adaptive frequencies of `kSymbols` symbols: the multi-symbol arithmetic coding model of section 3.4.
template <Index kSymbols>
class SymbolModel {
 public:
  SymbolModel() { counts_.fill(kInitial); }

  template <class Port>
  Index code(Port& port, Index value = 0) {
    if constexpr (!Port::kWriting) {
      Index at = port.position(total_);
      for (value = 0; at >= counts_[value]; ++value) at -= counts_[value];
    }
    Index start = 0;
    for (Index s = 0; s < value; ++s) start += counts_[s];
    port.take(start, counts_[value], total_);
    update(value);
    return value;
  }

 private:
  static constexpr Index kInitial = 1, kIncrement = 12, kLimit = 1u << 13;

  void update(Index value) {
    counts_[value] += kIncrement;
    total_ += kIncrement;
    if (total_ <= kLimit) return;
    total_ = 0;
    for (Index& count : counts_) total_ += count = (count + 1) / 2;
  }

  std::array<Index, kSymbols> counts_;
  Index total_ = kInitial * kSymbols;
};

/// Numbers of any size, small ones cheap: bit length of value + 1 in unary, then its bits below the leading one, of
/// which the first is adaptive. At most 2^31 - 2.
class NumberModel {
 public:
  template <class Port>
  Index code(Port& port, Index value = 0) {
    const int length = std::bit_width(value + 1u) - 1;
    int bits = 0;
    while (bits < 30 && length_[bits].code(port, bits < length)) ++bits;
    Index result = 1;
    for (int i = bits - 1; i >= 0; --i) {
      const bool bit = (value + 1u) >> i & 1;
      const bool decoded = i == bits - 1 ? first_[bits].code(port, bit) : port.code(32768, bit);
      result = result << 1 | static_cast<Index>(decoded);
    }
    return result - 1;
  }

 private:
  std::array<Bit, 32> length_;
  std::array<Bit, 32> first_;
};

}  // namespace tutte
