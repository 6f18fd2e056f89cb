#pragma once
// The ports of the value coder: a range coder for decisions, and beside it a stream of plain bits for the digits that
// no statistics would make shorter.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/bytes.h"
#include "codec/range_coder.h"

namespace tutte {

class ValueWriter {
 public:
  static constexpr bool kWriting = true;

  bool code(Probability one, bool value) { return range_.code(one, value); }

  /// The lowest `count` bits of a value, at most 32.
  uint32_t bits(int count, uint32_t value) {
    pending_ |= uint64_t{value} << pending_count_;
    pending_count_ += count;
    for (; pending_count_ >= 8; pending_count_ -= 8, pending_ >>= 8) plain_.push_back(static_cast<uint8_t>(pending_));
    return value;
  }

  bool overrun() const { return false; }

  /// Length of the range coder's bytes (varint), these bytes, then the plain bits, low ones first.
  void finish(ByteWriter& out) && {
    if (pending_count_ > 0) plain_.push_back(static_cast<uint8_t>(pending_));
    const std::vector<uint8_t> decisions = std::move(range_).finish();
    out.varint(static_cast<uint32_t>(decisions.size()));
    out.append(decisions);
    out.append(plain_);
  }

 private:
  RangeWriter range_;
  std::vector<uint8_t> plain_;
  uint64_t pending_ = 0;
  int pending_count_ = 0;
};

class ValueReader {
 public:
  static constexpr bool kWriting = false;

  ValueReader(std::span<const uint8_t> decisions, std::span<const uint8_t> plain) : range_(decisions), plain_(plain) {}

  bool code(Probability one, bool = false) { return range_.code(one); }

  uint32_t bits(int count, uint32_t = 0) {
    while (pending_count_ < count) {
      pending_ |= uint64_t{next_ < plain_.size() ? plain_[next_] : uint8_t{0}} << pending_count_;
      pending_count_ += 8;
      ++next_;
    }
    const auto value = static_cast<uint32_t>(pending_ & ((uint64_t{1} << count) - 1));
    pending_ >>= count;
    pending_count_ -= count;
    return value;
  }

  /// True once more was read than was written: the bytes are damaged.
  bool overrun() const { return range_.overrun() || next_ > plain_.size(); }

  /// True when bytes are left that no writer would have written.
  bool trailing() const { return range_.trailing() || next_ < plain_.size(); }

 private:
  RangeReader range_;
  std::span<const uint8_t> plain_;
  size_t next_ = 0;
  uint64_t pending_ = 0;
  int pending_count_ = 0;
};

}  // namespace tutte
