#pragma once
// The ports of the value coder: a stream of decisions and symbols, and beside it a stream of plain bits for the digits
// that no statistics would make shorter.
//
// Decisions are coded with an asymmetric numeral system: the reader's state is a number; each decision takes its part
// of the last 16 binary digits, and what is left becomes the next state, to which 32 bits are added when it has become
// small. The writer goes the other way, from the last decision to the first, so it notes all of them before. It begins
// with the state 0, with which the reader has to end.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "codec/bytes.h"
#include "codec/value_lanes.h"

namespace tutte {

/// States below this take more bits, as long as there are any.
inline constexpr uint64_t kLowState = uint64_t{1} << 31;

class ValueWriter {
 public:
  static constexpr bool kWriting = true;

  /// A decision; `one` is the probability of a 1, 1 to 65535 of 65536.
  bool code(uint32_t one, bool value) {
    value ? note(0, one) : note(one, 65536 - one);
    return value;
  }

  uint32_t symbol(const values::Parts& parts, uint32_t value) {
    note(2 * parts.begin(value), 2 * (parts.end(value) - parts.begin(value)));
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

  /// Length of the decisions' bytes (varint), these bytes, then the plain bits, low ones first.
  void finish(ByteWriter& out) && {
    if (pending_count_ > 0) plain_.push_back(static_cast<uint8_t>(pending_));
    const std::vector<uint8_t> decisions = decisionBytes();
    out.varint(static_cast<uint32_t>(decisions.size()));
    out.append(decisions);
    out.append(plain_);
  }

 private:
  struct Part {
    uint16_t begin, size;
  };

  void note(uint32_t begin, uint32_t size) {
    parts_.push_back({static_cast<uint16_t>(begin), static_cast<uint16_t>(size)});
  }

  // The last state, big-endian, and the words that it has lost, the last one first.
  std::vector<uint8_t> decisionBytes() const {
    uint64_t state = 0;
    std::vector<uint8_t> backwards;
    const auto lose = [&](int bytes) {
      for (; bytes > 0; --bytes, state >>= 8) backwards.push_back(static_cast<uint8_t>(state));
    };
    for (size_t i = parts_.size(); i-- > 0;) {
      const Part part = parts_[i];
      if (state >= (kLowState << 16) * part.size) lose(4);
      state = (state / part.size << 16) + state % part.size + part.begin;
    }
    const bool words = !backwards.empty();
    const int length = (static_cast<int>(std::bit_width(state)) + 7) / 8;
    lose(words && length == 4 ? 8 : length);
    std::ranges::reverse(backwards);
    return backwards;
  }

  std::vector<Part> parts_;
  std::vector<uint8_t> plain_;
  uint64_t pending_ = 0;
  int pending_count_ = 0;
};

class ValueReader {
 public:
  static constexpr bool kWriting = false;

  ValueReader(std::span<const uint8_t> decisions, std::span<const uint8_t> plain)
      : decisions_(decisions), plain_(plain.size() + 8), plain_size_(plain.size()) {
    std::ranges::copy(plain, plain_.begin());
    const size_t size = decisions.size(), head = size < 8 ? size : size % 4 == 0 ? 8 : 4 + size % 4;
    for (; at_ < head; ++at_) state_ = state_ << 8 | decisions[at_];
  }

  bool code(uint32_t one, bool = false) {
    const auto position = static_cast<uint32_t>(state_ & 0xFFFF);
    const bool value = position < one;
    // Masks, because compilers make decisions of conditions, and this one nobody foresees.
    const uint32_t zero = uint32_t{value} - 1;
    take(one & zero, (one ^ zero) + (65537 & zero));
    return value;
  }

  uint32_t symbol(const values::Parts& parts, uint32_t = 0) {
    const uint32_t value = parts.find(static_cast<uint32_t>(state_ & 0xFFFF) >> 1);
    const uint32_t begin = parts.begin(value);
    take(2 * begin, 2 * (parts.end(value) - begin));
    return value;
  }

  uint32_t bits(int count, uint32_t = 0) {
    if (plain_left_ < count) [[unlikely]]
      refill();
    const auto value = static_cast<uint32_t>(plain_word_ & ((uint64_t{1} << count) - 1));
    plain_word_ >>= count;
    plain_left_ -= count;
    return value;
  }

  /// True once more was read than there is: the bytes are damaged. To be asked now and then.
  bool overrun() const { return taken() > 8 * plain_size_; }

  /// True when bytes are left, or the end is none that a writer would have made.
  bool trailing() const { return at_ < decisions_.size() || state_ != 0 || 8 * plain_size_ > taken() + 7; }

 private:
  /// Plain bits that were read.
  size_t taken() const { return plain_end_ - static_cast<size_t>(plain_left_); }

  [[gnu::noinline]] void refill() {
    const size_t at = taken();
    plain_word_ = littleWord(&plain_[std::min(at >> 3, plain_size_)]) >> (at & 7);
    plain_left_ = 64 - static_cast<int>(at & 7);
    plain_end_ = at + static_cast<size_t>(plain_left_);
  }

  void take(uint32_t begin, uint32_t size) {
    state_ = size * (state_ >> 16) + (state_ & 0xFFFF) - begin;
    if (state_ < kLowState) [[unlikely]]
      renew();
  }

  // What is behind the first state are whole words.
  void renew() {
    if (at_ == decisions_.size()) return;
    const uint8_t* const from = &decisions_[at_];
    state_ = state_ << 32 | uint32_t{from[0]} << 24 | uint32_t{from[1]} << 16 | uint32_t{from[2]} << 8 | from[3];
    at_ += 4;
  }

  static uint64_t littleWord(const uint8_t* from) {
    uint64_t word = 0;
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(&word, from, 8);
    } else {
      for (int i = 0; i < 8; ++i) word |= uint64_t{from[i]} << (8 * i);
    }
    return word;
  }

  const std::span<const uint8_t> decisions_;
  std::vector<uint8_t> plain_;  // and zeros behind, so that eight bytes can be read anywhere
  const size_t plain_size_;
  uint64_t state_ = 0;
  size_t at_ = 0;            // in the decisions
  uint64_t plain_word_ = 0;  // the next plain bits,
  int plain_left_ = 0;       // so many,
  size_t plain_end_ = 0;     // and where they end
};

}  // namespace tutte
