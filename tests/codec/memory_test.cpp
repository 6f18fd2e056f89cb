// What damaged bytes can make the decoder allocate, counted by an operator new of our own.

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "codec/decode.h"
#include "codec/encode.h"
#include "tests/shapes/shapes.h"

namespace {

size_t allocated = 0;
size_t peak = 0;

void* counted(void* memory) {
  if (memory == nullptr) std::abort();
  allocated += malloc_usable_size(memory);
  peak = std::max(peak, allocated);
  return memory;
}

void uncounted(void* memory) {
  allocated -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(size_t size) { return counted(std::malloc(size)); }
void* operator new(size_t size, const std::nothrow_t&) noexcept { return counted(std::malloc(size)); }
void* operator new(size_t size, std::align_val_t alignment) {
  const size_t step = static_cast<size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void operator delete(void* memory) noexcept { uncounted(memory); }
void operator delete(void* memory, size_t) noexcept { uncounted(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { uncounted(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { uncounted(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { uncounted(memory); }

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;

/// A hundred bytes can be a million regular faces, so what bounds memory is what the caller allows.
size_t peakOfDecoding(const Bytes& bytes) {
  const Limits limits{1000, 1000, 4000};
  const size_t before = peak = allocated;
  const bool decoded = decode(bytes, limits).ok();
  (void)decoded;
  return peak - before;
}

/// Mostly the first bytes, where the counts stand.
Bytes damaged(Bytes bytes, shapes::Random& random) {
  for (Index i = 1 + random.below(4); i > 0 && !bytes.empty(); --i) {
    const Index at =
        random.below(static_cast<Index>(random.below(2) ? std::min<size_t>(8, bytes.size()) : bytes.size()));
    bytes[at] = static_cast<uint8_t>(random.below(2) ? 0xFF : random.next());
  }
  return bytes;
}

TEST(HostileMemory, SmallInputsStaySmall) {
  std::vector<Bytes> streams = {Bytes(60)};
  for (const shapes::Named& named : shapes::allShapes()) {
    const Result<Encoded> encoded = encode(named.shape.mesh);
    if (encoded && encoded->bytes.size() <= 130) streams.push_back(encoded->bytes);
  }
  for (uint64_t seed = 0; seed < 20000; ++seed) {
    shapes::Random random(seed);
    const Bytes bytes = damaged(streams[random.below(static_cast<Index>(streams.size()))], random);
    ASSERT_LT(peakOfDecoding(bytes), 2u << 20) << "seed " << seed << ", " << bytes.size() << " bytes";
  }
}

}  // namespace
}  // namespace tutte
