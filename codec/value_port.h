#pragma once
// The ports of the value coder: a stream of decisions, symbols, and plain bits, the digits that no statistics would
// make shorter.
//
// They are coded with an asymmetric numeral system: the reader's state is a number; each decision takes its part of the
// last 16 binary digits, and what is left becomes the next state, to which 32 bits are added when it has become small.
// The writer goes the other way, from the last decision to the first, so it notes all of them before. It begins with
// the state 0, with which the reader has to end.

#include <algorithm>
#include <bit>
#include <cstdint>
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

  /// A value of `count` bits, at most 31.
  uint32_t bits(int count, uint32_t value) {
    parts_.push_back({value & ((1u << count) - 1), kPlain + static_cast<uint32_t>(count)});
    return value;
  }

  /// Appends the bytes. Nothing may follow them.
  void finish(ByteWriter& out) && { out.append(decisionBytes()); }

 private:
  static constexpr uint32_t kPlain = 1u << 16;  // of plain bits, that and their number

  struct Part {
    uint32_t begin, size;
  };

  void note(uint32_t begin, uint32_t size) { parts_.push_back({begin, size}); }

  // The last state, big-endian, and the words that it has lost, the last one first.
  std::vector<uint8_t> decisionBytes() const {
    uint64_t state = 0;
    std::vector<uint8_t> backwards;
    const auto lose = [&](int bytes) {
      for (; bytes > 0; --bytes, state >>= 8) backwards.push_back(static_cast<uint8_t>(state));
    };
    for (size_t i = parts_.size(); i-- > 0;) {
      const Part part = parts_[i];
      if (part.size >= kPlain) {
        const uint32_t count = part.size - kPlain;
        if (state >= kLowState << (32 - count)) lose(4);
        state = state << count | part.begin;
        continue;
      }
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
};

class ValueReader {
 public:
  static constexpr bool kWriting = false;

  explicit ValueReader(std::span<const uint8_t> bytes) : bytes_(bytes) {
    const size_t size = bytes.size(), head = size < 8 ? size : size % 4 == 0 ? 8 : 4 + size % 4;
    for (; at_ < head; ++at_) state_ = state_ << 8 | bytes[at_];
  }

  bool code(uint32_t one, bool = false) {
    const auto position = static_cast<uint32_t>(state_ & 0xFFFF);
    const bool value = position < one;
    // Masks, because compilers make decisions of conditions, and this one nobody foresees.
    const uint32_t zero = uint32_t{value} - 1;
    take(one & zero, (one ^ zero) + (65537 & zero));
    return value;
  }

  [[gnu::always_inline]] uint32_t symbol(const values::Parts& parts, uint32_t = 0) {
    const uint32_t value = parts.find(static_cast<uint32_t>(state_ & 0xFFFF) >> 1);
    const uint32_t begin = parts.begin(value);
    take(2 * begin, 2 * (parts.end(value) - begin));
    return value;
  }

  uint32_t bits(int count, uint32_t = 0) {
    const auto value = static_cast<uint32_t>(state_) & ((1u << count) - 1);
    state_ >>= count;
    if (state_ < kLowState) [[unlikely]]
      renew();
    return value;
  }

  /// True when the bytes end elsewhere: they are damaged.
  bool wrongEnd() const { return at_ < bytes_.size() || state_ != 0; }

 private:
  void take(uint32_t begin, uint32_t size) {
    state_ = size * (state_ >> 16) + (state_ & 0xFFFF) - begin;
    if (state_ < kLowState) [[unlikely]]
      renew();
  }

  // What is behind the first state are whole words.
  void renew() {
    if (at_ == bytes_.size()) return;
    const uint8_t* const from = &bytes_[at_];
    state_ = state_ << 32 | uint32_t{from[0]} << 24 | uint32_t{from[1]} << 16 | uint32_t{from[2]} << 8 | from[3];
    at_ += 4;
  }

  const std::span<const uint8_t> bytes_;
  uint64_t state_ = 0;
  size_t at_ = 0;
};

}  // namespace tutte
