#include "tools/heap_meter.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

// Of all threads; what is lost when two meet is a little precision.
std::atomic<int64_t> live{0}, peak{0};

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  const int64_t now = live.load(std::memory_order_relaxed) + static_cast<int64_t>(malloc_usable_size(memory));
  live.store(now, std::memory_order_relaxed);
  if (now > peak.load(std::memory_order_relaxed)) peak.store(now, std::memory_order_relaxed);
  return memory;
}

void release(void* memory) {
  if (memory == nullptr) return;
  const auto size = static_cast<int64_t>(malloc_usable_size(memory));
  live.store(live.load(std::memory_order_relaxed) - size, std::memory_order_relaxed);
  std::free(memory);
}

}  // namespace

// All other forms call these.
void* operator new(size_t size) { return counted(std::malloc(std::max<size_t>(size, 1))); }
void* operator new(size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<size_t>(alignment);
  return counted(std::aligned_alloc(unit, (std::max<size_t>(size, 1) + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { release(memory); }

namespace tutte {

HeapMeter::HeapMeter() : start_(live.load()) { peak.store(start_); }

uint64_t HeapMeter::peakBytes() const { return static_cast<uint64_t>(std::max<int64_t>(peak.load() - start_, 0)); }

}  // namespace tutte
