#pragma once
// The range coder. RangeWriter and RangeReader are the two *ports*: they have the same members, so that every model
// and every symbol is written down once, for both directions. The writer codes the value it is given and returns it;
// the reader ignores its argument and returns what it read. about() tells a port what the next decisions are about.
//
// A probability is 16 bits; the interval is 64 bits wide and is renewed in words of 32 bits. The stream is big-endian;
// of its last word only the bytes that matter are kept, and a reader sees zeros behind the end.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/topic.h"

namespace tutte {

/// Probability of a 1 in 1/65536, never 0.
using Probability = uint32_t;

class RangeWriter {
 public:
  static constexpr bool kWriting = true;

  static void about(Topic) {}

  bool code(Probability one, bool value) {
    const uint64_t split = (range_ >> 16) * one;
    if (value) {
      range_ = split;
    } else {
      advance(split);
      range_ -= split;
    }
    renew();
    return value;
  }

  /// One of `count` equally likely values. count <= 2^31.
  Index uniform(Index count, Index value) { return take(value, 1, count), value; }

  /// The part [start, start + size) of `total`. total <= 2^31.
  void take(Index start, Index size, Index total) {
    const uint64_t unit = range_ / total;
    advance(unit * start);
    range_ = unit * size;
    renew();
  }

  /// From how many bytes on nobody wants the stream: then overrun() says so.
  void wantAtMost(size_t bytes) { most_bytes_ = bytes; }
  void wantAll() { most_bytes_ = ~size_t{0}; }

  bool overrun() const { return bytes_.size() > most_bytes_; }

  /// Bits of information so far, rounded down.
  size_t bits() const { return 8 * bytes_.size() + 64 - static_cast<size_t>(std::bit_width(range_)); }

  /// Ends the stream: the shortest bytes that select the final interval.
  std::vector<uint8_t> finish() && {
    const uint64_t last = low_ + (range_ - 1);
    const bool carry = last < low_;
    const int free_bits = 63 - std::countl_zero(carry ? ~uint64_t{0} : low_ ^ last);
    uint64_t value = free_bits < 0 || carry ? 0 : last & ~((uint64_t{1} << free_bits) - 1);
    if (!carry && low_ == 0) value = 0;
    if (carry) propagateCarry();
    for (; value != 0; value <<= 8) bytes_.push_back(static_cast<uint8_t>(value >> 56));
    return std::move(bytes_);
  }

 private:
  void advance(uint64_t by) {
    low_ += by;
    if (low_ < by) propagateCarry();
  }

  void propagateCarry() {
    for (size_t i = bytes_.size(); i-- > 0;) {
      if (++bytes_[i] != 0) return;
    }
  }

  // Once is enough: no part of the interval is less than 2^-16 of it, or one of 2^31.
  void renew() {
    if (range_ >= uint64_t{1} << 32) return;
    for (int shift = 56; shift >= 32; shift -= 8) bytes_.push_back(static_cast<uint8_t>(low_ >> shift));
    low_ <<= 32;
    range_ <<= 32;
  }

  uint64_t low_ = 0;
  uint64_t range_ = ~uint64_t{0};
  size_t most_bytes_ = ~size_t{0};
  std::vector<uint8_t> bytes_;
};

class RangeReader {
 public:
  static constexpr bool kWriting = false;

  static void about(Topic) {}

  explicit RangeReader(std::span<const uint8_t> bytes) : bytes_(bytes) {
    code_ = word() << 32;
    code_ |= word();
  }

  bool code(Probability one, bool = false) {
    const uint64_t split = (range_ >> 16) * one;
    const bool value = code_ < split;
    code_ -= value ? 0 : split;
    range_ = value ? split : range_ - split;
    renew();
    return value;
  }

  Index uniform(Index count, Index = 0) {
    const Index value = position(count);
    take(value, 1, count);
    return value;
  }

  /// Where in [0, total) the stream points; the part that holds it must be taken.
  Index position(Index total) const {
    const uint64_t at = code_ / (range_ / total);
    return at < total ? static_cast<Index>(at) : total - 1;
  }

  void take(Index start, Index size, Index total) {
    const uint64_t unit = range_ / total;
    code_ -= unit * start;
    range_ = unit * size;
    if (code_ >= range_) code_ = range_ - 1;  // only damaged streams come here
    renew();
  }

  /// True once more was read than any writer leaves out: the stream is damaged. To be asked now and then, so that
  /// zeros behind the end cannot be decoded for ever.
  bool overrun() const { return next_ > bytes_.size() + 8; }

  /// True when bytes are left that no writer would have written.
  bool trailing() const { return next_ < bytes_.size(); }

 private:
  uint64_t word() {
    const size_t at = next_;
    next_ += 4;
    if (next_ > bytes_.size()) return wordAtEnd(at);
    const uint8_t* const word = bytes_.data() + at;
    return static_cast<uint32_t>(word[0]) << 24 | static_cast<uint32_t>(word[1]) << 16 |
           static_cast<uint32_t>(word[2]) << 8 | static_cast<uint32_t>(word[3]);
  }

  [[gnu::noinline]] uint64_t wordAtEnd(size_t at) const {
    uint64_t value = 0;
    for (size_t i = at; i < at + 4; ++i) value = value << 8 | (i < bytes_.size() ? bytes_[i] : 0);
    return value;
  }

  // Once is enough, as for the writer.
  void renew() {
    if (range_ >= uint64_t{1} << 32) return;
    code_ = code_ << 32 | word();
    range_ <<= 32;
  }

  std::span<const uint8_t> bytes_;
  size_t next_ = 0;
  uint64_t code_ = 0;
  uint64_t range_ = ~uint64_t{0};
};

}  // namespace tutte
