#pragma once
// Bytes in and out, with bounds and without surprises: little-endian numbers, LEB128 varints, CRC-32.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/made_table.h"
#include "codec/result.h"

namespace tutte {

namespace detail {

// The reflected polynomial of IEEE 802.3: what a byte does to the sum, and what it does with one to three bytes of 0
// behind it.
TUTTE_TABLE std::array<std::array<uint32_t, 256>, 4> kCrcTables = madeTable([] {
  std::array<std::array<uint32_t, 256>, 4> tables{};
  for (uint32_t i = 0; i < 256; ++i) {
    uint32_t crc = i;
    for (uint32_t bit = 0; bit < 32; ++bit) {
      crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0u);
      if (bit % 8 == 7) tables[bit / 8][i] = crc;
    }
  }
  return tables;
});

}  // namespace detail

/// CRC-32 (IEEE 802.3, as in zip and PNG) of `bytes`. To continue over several spans, pass the previous result.
constexpr uint32_t crc32(std::span<const uint8_t> bytes, uint32_t previous = 0) {
  const auto& tables = detail::kCrcTables;
  uint32_t crc = ~previous;
  size_t at = 0;
  for (; bytes.size() - at >= 4; at += 4) {  // four look-ups that do not wait for each other
    const uint8_t* const next = &bytes[at];
    crc ^= next[0] | next[1] << 8 | next[2] << 16 | uint32_t{next[3]} << 24;
    crc = tables[3][crc & 0xFF] ^ tables[2][crc >> 8 & 0xFF] ^ tables[1][crc >> 16 & 0xFF] ^ tables[0][crc >> 24];
  }
  for (; at < bytes.size(); ++at) crc = tables[0][(crc ^ bytes[at]) & 0xFF] ^ crc >> 8;
  return ~crc;
}

/// Appends to a byte vector that it owns.
class ByteWriter {
 public:
  void byte(uint8_t value) { bytes_.push_back(value); }

  /// Four bytes, little-endian.
  void u32(uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) byte(static_cast<uint8_t>(value >> shift));
  }

  /// LEB128: seven bits per byte, low ones first, the top bit set on all bytes but the last. 1 to 5 bytes.
  void varint(uint32_t value) {
    for (; value >= 0x80; value >>= 7) byte(static_cast<uint8_t>(value | 0x80));
    byte(static_cast<uint8_t>(value));
  }

  void append(std::span<const uint8_t> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

  std::span<const uint8_t> bytes() const { return bytes_; }
  std::vector<uint8_t> take() && { return std::move(bytes_); }

 private:
  std::vector<uint8_t> bytes_;
};

/// Reads a span that somebody else owns. The first error sticks: afterwards everything reads as 0, so it is enough to
/// ask error() once, before the values are used.
class ByteReader {
 public:
  explicit ByteReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  uint8_t byte() {
    const auto one = take(1);
    return one.empty() ? 0 : one[0];
  }

  uint32_t u32() {
    const auto four = take(4);
    if (four.empty()) return 0;
    return four[0] | uint32_t{four[1]} << 8 | uint32_t{four[2]} << 16 | uint32_t{four[3]} << 24;
  }

  /// A varint of at most 5 bytes that is not longer than needed; anything else is kMalformed.
  uint32_t varint() {
    uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const uint8_t next = byte();
      value |= uint64_t{next & 0x7Fu} << shift;
      if (next >= 0x80) continue;
      if (value > 0xFFFFFFFFu || (next == 0 && shift != 0)) break;
      return error_ == Error::kNone ? static_cast<uint32_t>(value) : 0;
    }
    fail(Error::kMalformed);
    return 0;
  }

  /// The next `count` bytes; empty when there are not as many.
  std::span<const uint8_t> take(size_t count) {
    if (count > remaining()) fail(Error::kTruncated);
    if (error_ != Error::kNone) return {};
    const auto taken = bytes_.subspan(position_, count);
    position_ += count;
    return taken;
  }

  size_t position() const { return position_; }
  size_t remaining() const { return bytes_.size() - position_; }
  Error error() const { return error_; }

 private:
  void fail(Error error) {
    if (error_ == Error::kNone) error_ = error;
  }

  std::span<const uint8_t> bytes_;
  size_t position_ = 0;
  Error error_ = Error::kNone;
};

}  // namespace tutte
