#pragma once
// The values of a PLY file, in text or binary.

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tools/ply_header.h"
#include "tools/text.h"

namespace tutte {

/// The values behind the header, one after the other.
class PlyValues {
 public:
  PlyValues(std::span<const uint8_t> bytes, const PlyHeader& header)
      : bytes_(bytes.subspan(header.size)),
        text_(reinterpret_cast<const char*>(bytes_.data()), bytes_.size()),
        format_(header.format) {}

  /// Nothing at the end of the file, or where there is no number.
  std::optional<double> next(PlyType type) { return format_ == PlyFormat::kText ? nextWordValue() : nextBytes(type); }

  bool atEnd() const { return format_ == PlyFormat::kText ? text_.empty() : bytes_.empty(); }

 private:
  std::optional<double> nextWordValue() {
    const size_t start = text_.find_first_not_of(" \t\r\n\v\f");
    text_.remove_prefix(std::min(start, text_.size()));
    const size_t end = std::min(text_.find_first_of(" \t\r\n\v\f"), text_.size());
    std::string_view word = text_.substr(0, end);
    text_.remove_prefix(end);
    if (const auto integer = parseInteger<int64_t>(word)) return static_cast<double>(*integer);
    const auto value = parseFloat(word);
    return value ? std::optional<double>(*value) : std::nullopt;
  }

  std::optional<double> nextBytes(PlyType type) {
    switch (type) {
      case PlyType::kInt8: return take<uint8_t, int8_t>();
      case PlyType::kUint8: return take<uint8_t, uint8_t>();
      case PlyType::kInt16: return take<uint16_t, int16_t>();
      case PlyType::kUint16: return take<uint16_t, uint16_t>();
      case PlyType::kInt32: return take<uint32_t, int32_t>();
      case PlyType::kUint32: return take<uint32_t, uint32_t>();
      case PlyType::kFloat: return take<uint32_t, float>();
      case PlyType::kDouble: return take<uint64_t, double>();
    }
    return {};
  }

  template <class Bits, class T>
  std::optional<double> take() {
    if (bytes_.size() < sizeof(Bits)) return {};
    Bits bits = 0;
    for (size_t i = 0; i < sizeof(Bits); ++i) {
      const size_t shift = 8 * (format_ == PlyFormat::kBigEndian ? sizeof(Bits) - 1 - i : i);
      bits = static_cast<Bits>(bits | static_cast<Bits>(Bits{bytes_[i]} << shift));
    }
    bytes_ = bytes_.subspan(sizeof(Bits));
    return static_cast<double>(std::bit_cast<T>(bits));
  }

  std::span<const uint8_t> bytes_;
  std::string_view text_;
  PlyFormat format_;
};

}  // namespace tutte
