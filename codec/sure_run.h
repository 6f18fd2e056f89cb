#pragma once
// Flags that are nearly always a yes.

#include <algorithm>
#include <cstdint>

namespace tutte {

/// How often in a row a flag was a yes. After as often as its owner wants, it is coded by that number alone; a no
/// leaves one `kLoss`-th of it.
template <int kLoss>
class SureRun {
 public:
  bool isSure(int least) const { return length_ >= least; }

  /// Codes the flag, where isSure().
  template <class Port>
  [[gnu::always_inline]] bool code(Port& port, bool value) {
    const bool bit = port.code(65536 - 65536 / (length_ + 2u), value);
    note(bit);
    return bit;
  }

  /// To be told of the flag where it was coded otherwise.
  [[gnu::always_inline]] void note(bool bit) {
    length_ = static_cast<uint16_t>(bit ? std::min(length_ + 1, kMost) : length_ / kLoss);
  }

 private:
  static constexpr int kMost = 16383;

  uint16_t length_ = 0;
};

}  // namespace tutte
