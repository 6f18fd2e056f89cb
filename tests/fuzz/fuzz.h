#pragma once
// What the fuzz targets share.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "codec/mesh.h"
#include "tests/codec/checks.h"

namespace tutte::fuzz {

/// Large enough for every path, small enough for many runs per second.
inline constexpr Limits kLimits{1u << 12, 1u << 12, 1u << 14};

/// Ends the run, so that the fuzzer keeps the input.
inline void demand(const testing::AssertionResult& result) {
  if (result) return;
  std::fprintf(stderr, "%s\n", result.message());
  std::abort();
}

inline void demand(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

/// Takes an input apart from its front.
class Input {
 public:
  Input(const uint8_t* data, size_t size) : rest_(data, size) {}

  uint8_t byte() {
    if (rest_.empty()) return 0;
    const uint8_t first = rest_[0];
    rest_ = rest_.subspan(1);
    return first;
  }

  /// At most `count` bytes.
  std::span<const uint8_t> take(size_t count) {
    const auto taken = rest_.first(count < rest_.size() ? count : rest_.size());
    rest_ = rest_.subspan(taken.size());
    return taken;
  }

  /// As many bytes as the next two say.
  std::span<const uint8_t> chunk() {
    const size_t low = byte();
    return take(low | size_t{byte()} << 8);
  }

  std::span<const uint8_t> rest() const { return rest_; }

 private:
  std::span<const uint8_t> rest_;
};

}  // namespace tutte::fuzz
