#pragma once
// The ports of the value coder: a range coder for decisions and symbols, and beside it a stream of plain bits for the
// digits that no statistics would make shorter.
//
// The range has 16 bits, so that all parts of a distribution are found by one vector multiplication. It is renewed bit
// by bit; the stream is big-endian, and a reader sees zeros behind its end.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/bytes.h"
#include "codec/value_lanes.h"

namespace tutte {

class ValueWriter {
 public:
  static constexpr bool kWriting = true;

  /// A decision; `one` is the probability of a 1, 2 to 65535 of 65536.
  bool code(uint32_t one, bool value) {
    const uint32_t split = range_ * one >> 16;
    value ? take(0, split) : take(split, range_ - split);
    return value;
  }

  int symbol(const values::Distribution& distribution, int value) {
    values::Thresholds parts;
    divide(distribution, range_, parts);
    take(parts.at(value + 1), parts.at(value) - parts.at(value + 1));
    return value;
  }

  /// The lowest `count` bits of a value, at most 32.
  uint32_t bits(int count, uint32_t value) {
    pending_ |= uint64_t{value} << pending_count_;
    pending_count_ += count;
    for (; pending_count_ >= 8; pending_count_ -= 8, pending_ >>= 8) plain_.push_back(static_cast<uint8_t>(pending_));
    return value;
  }

  bool overrun() const { return false; }

  /// How many bytes finish() would append, give or take a few.
  size_t size() const { return bytes_.size() + plain_.size(); }

  /// Length of the range coder's bytes (varint), these bytes, then the plain bits, low ones first.
  void finish(ByteWriter& out) && {
    if (pending_count_ > 0) plain_.push_back(static_cast<uint8_t>(pending_));
    finishRange();
    out.varint(static_cast<uint32_t>(bytes_.size()));
    out.append(bytes_);
    out.append(plain_);
  }

 private:
  void take(uint32_t start, uint32_t size) {
    low_ += start;
    const int shift = std::countl_zero(size) - 16;
    range_ = size << shift;
    low_ <<= shift;
    shifted_ += shift;
    if (shifted_ >= 32) emit();
  }

  // Of `low_`, the lowest 16 bits belong to the range, `shifted_` bits above them wait, and above these a carry.
  void emit() {
    const int rest = shifted_ - 16;
    const uint64_t word = low_ >> rest;
    low_ &= (uint64_t{1} << rest) - 1;
    shifted_ -= 32;
    if (word >> 32 != 0) propagateCarry();
    for (int shift = 24; shift >= 0; shift -= 8) bytes_.push_back(static_cast<uint8_t>(word >> shift));
  }

  void propagateCarry() {
    for (size_t i = bytes_.size(); i-- > 0;) {
      if (++bytes_[i] != 0) return;
    }
  }

  // The shortest bytes that select the final interval; zeros at their end go without saying.
  void finishRange() {
    const int width = shifted_ + 16;
    const uint64_t last = low_ + (range_ - 1);
    uint64_t value = last;
    for (int bit = 1; bit < width; ++bit) {
      const uint64_t shorter = last >> bit << bit;
      if (shorter < low_) break;
      value = shorter;
    }
    if (low_ == 0) value = 0;
    if (value >> width != 0) propagateCarry();
    for (uint64_t rest = value << (64 - width); rest != 0; rest <<= 8) {
      bytes_.push_back(static_cast<uint8_t>(rest >> 56));
    }
  }

  uint64_t low_ = 0;
  uint32_t range_ = 65535;
  int shifted_ = 0;
  std::vector<uint8_t> bytes_, plain_;
  uint64_t pending_ = 0;
  int pending_count_ = 0;
};

class ValueReader {
 public:
  static constexpr bool kWriting = false;

  ValueReader(std::span<const uint8_t> decisions, std::span<const uint8_t> plain)
      : decisions_(decisions), plain_(plain), number_(static_cast<uint32_t>(decisions_.bigWord(0) >> 48)) {}

  bool code(uint32_t one, bool = false) {
    const uint32_t split = range_ * one >> 16;
    const bool value = number_ < split;
    take(value ? 0 : split, value ? split : range_ - split);
    return value;
  }

  int symbol(const values::Distribution& distribution, int = 0) {
    values::Thresholds parts;
    divide(distribution, range_, parts);
    const int value = find(parts, number_);
    take(parts.at(value + 1), parts.at(value) - parts.at(value + 1));
    return value;
  }

  uint32_t bits(int count, uint32_t = 0) {
    const uint64_t word = plain_.littleWord(plain_taken_ >> 3) >> (plain_taken_ & 7);
    plain_taken_ += static_cast<size_t>(count);
    return static_cast<uint32_t>(word & ((uint64_t{1} << count) - 1));
  }

  /// True once more was read than any writer leaves out: the bytes are damaged. To be asked now and then.
  bool overrun() const { return taken_ > 8 * decisions_.size() + 64 || plain_taken_ > 8 * plain_.size(); }

  /// True when bytes are left that no writer would have written.
  bool trailing() const { return 8 * decisions_.size() > taken_ + 7 || 8 * plain_.size() > plain_taken_ + 7; }

 private:
  // The next bits are looked up every time: when to renew a buffer of them could not be foreseen.
  void take(uint32_t start, uint32_t size) {
    const uint64_t next = decisions_.bigWord(taken_ >> 3) << (taken_ & 7);
    const int shift = std::countl_zero(size) - 16;
    range_ = size << shift;
    number_ = (number_ - start) << shift | static_cast<uint32_t>(next >> 1 >> (63 - shift));
    taken_ += static_cast<size_t>(shift);
  }

  // A copy with zeros behind its end, so that eight bytes can be read anywhere.
  class Bytes {
   public:
    explicit Bytes(std::span<const uint8_t> bytes) : padded_(bytes.size() + 8) {
      std::ranges::copy(bytes, padded_.begin());
    }

    size_t size() const { return padded_.size() - 8; }
    uint64_t bigWord(size_t at) const {
      const uint8_t* const from = &padded_[std::min(at, size())];
      uint64_t word = 0;
      for (int i = 0; i < 8; ++i) word |= uint64_t{from[i]} << (56 - 8 * i);
      return word;
    }
    uint64_t littleWord(size_t at) const {
      const uint8_t* const from = &padded_[std::min(at, size())];
      uint64_t word = 0;
      for (int i = 0; i < 8; ++i) word |= uint64_t{from[i]} << (8 * i);
      return word;
    }

   private:
    std::vector<uint8_t> padded_;
  };

  Bytes decisions_, plain_;
  uint32_t range_ = 65535, number_;
  size_t taken_ = 16, plain_taken_ = 0;  // in bits; of the decisions, those that `number_` has seen
};

}  // namespace tutte
