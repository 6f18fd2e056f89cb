#pragma once
// How much memory a step takes.

#include <cstdint>

namespace tutte {

/// Counts what is allocated by `new` in the whole program, libraries included, and not yet freed, from its construction
/// on. One at a time.
class HeapMeter {
 public:
  HeapMeter();

  /// The most that was in use at once, beyond what was in use at construction.
  uint64_t peakBytes() const;

 private:
  int64_t start_;
};

}  // namespace tutte
