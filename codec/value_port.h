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

  ValueReader(std::span<const uint8_t> decisions, std::span<const uint8_t> plain) : bytes_(decisions), plain_(plain) {
    window_ = uint64_t{word(bytes_, next_)} << 32;
    window_ |= word(bytes_, next_ + 4);
    next_ += 8;
  }

  bool code(uint32_t one, bool = false) {
    const uint32_t split = range_ * one >> 16;
    const bool value = position() < split;
    take(value ? 0 : split, value ? split : range_ - split);
    return value;
  }

  int symbol(const values::Distribution& distribution, int = 0) {
    values::Thresholds parts;
    divide(distribution, range_, parts);
    const int value = find(parts, position());
    take(parts.at(value + 1), parts.at(value) - parts.at(value + 1));
    return value;
  }

  uint32_t bits(int count, uint32_t = 0) {
    if (pending_count_ < count) {
      pending_ |= uint64_t{littleWord()} << pending_count_;
      pending_count_ += 32;
    }
    const auto value = static_cast<uint32_t>(pending_ & ((uint64_t{1} << count) - 1));
    pending_ >>= count;
    pending_count_ -= count;
    return value;
  }

  /// True once more was read than any writer leaves out: the bytes are damaged. To be asked now and then.
  bool overrun() const { return taken() > 8 * bytes_.size() + 64 || plainTaken() > 8 * plain_.size(); }

  /// True when bytes are left that no writer would have written.
  bool trailing() const { return 8 * bytes_.size() > taken() + 7 || 8 * plain_.size() > plainTaken() + 7; }

 private:
  uint32_t position() const { return static_cast<uint32_t>(window_ >> 48); }

  void take(uint32_t start, uint32_t size) {
    window_ -= uint64_t{start} << 48;
    const int shift = std::countl_zero(size) - 16;
    range_ = size << shift;
    window_ <<= shift;
    spare_ -= shift;
    if (spare_ < 16) {
      window_ |= uint64_t{word(bytes_, next_)} << (16 - spare_);
      next_ += 4;
      spare_ += 32;
    }
  }

  // Bits that the range has seen, and those that have been handed out.
  size_t taken() const { return 8 * next_ - static_cast<size_t>(spare_); }
  size_t plainTaken() const { return 8 * plain_next_ - static_cast<size_t>(pending_count_); }

  static uint32_t word(std::span<const uint8_t> bytes, size_t at) {
    uint32_t value = 0;
    if (at + 4 <= bytes.size()) {
      for (size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
    } else {
      for (size_t i = 0; i < 4; ++i) value = value << 8 | (at + i < bytes.size() ? bytes[at + i] : 0u);
    }
    return value;
  }

  uint32_t littleWord() {
    const uint32_t value = word(plain_, plain_next_);
    plain_next_ += 4;
    return value >> 24 | (value >> 8 & 0xFF00) | (value << 8 & 0xFF0000) | value << 24;
  }

  std::span<const uint8_t> bytes_, plain_;
  size_t next_ = 0, plain_next_ = 0;
  uint64_t window_ = 0;
  uint32_t range_ = 65535;
  int spare_ = 48;  // bits of the window below the upper 16
  uint64_t pending_ = 0;
  int pending_count_ = 0;
};

}  // namespace tutte
