// The heap of a module. wasi-libc's takes ten kB of code; this one serves a single thread that makes some large arrays,
// gives all of them back after each mesh, and never returns memory to anybody.
//
// The heap is a row of blocks. Each begins with a header, behind which the caller's memory is aligned to 16 bytes; a
// free block keeps its links there. Free blocks are listed by the binary logarithm of their size and never touch.

#include <bit>
#include <cstddef>
#include <cstdint>

extern "C" {
extern std::byte __heap_base;  // where the linker's own data ends
}

namespace {

constexpr size_t kAlignment = 16, kPage = 65536;
constexpr size_t kFree = 1;  // beside a size, which is a multiple of 16

struct Block {
  size_t before;  // size of the block in front of this one; 0: none
  size_t tagged;  // own size, header included, and whether it is free; 0: the end of the heap
  Block* next;    // of a free block
  Block* prev;

  size_t size() const { return tagged & ~kFree; }
  bool isFree() const { return (tagged & kFree) != 0; }
  Block* after() { return at(size()); }
  Block* inFront() { return at(size_t{0} - before); }
  void* memory() { return &next; }
  static Block* of(void* memory) { return reinterpret_cast<Block*>(static_cast<std::byte*>(memory) - kHeader); }

  static constexpr size_t kHeader = 2 * sizeof(size_t);

  Block* at(size_t offset) { return reinterpret_cast<Block*>(reinterpret_cast<uintptr_t>(this) + offset); }
};
static_assert(sizeof(Block) == kAlignment);

constinit Block* lists[32] = {};
constinit uint32_t filled = 0;  // bit i: list i is not empty
constinit Block* end = nullptr;

int listOf(size_t size) { return std::bit_width(size) - 1; }

void setSize(Block* block, size_t size, size_t free) {
  block->tagged = size | free;
  block->at(size)->before = size;
}

void add(Block* block, size_t size) {
  setSize(block, size, kFree);
  const int list = listOf(size);
  block->next = lists[list];
  block->prev = nullptr;
  if (block->next) block->next->prev = block;
  lists[list] = block;
  filled |= uint32_t{1} << list;
}

void remove(Block* block) {
  const int list = listOf(block->size());
  if (block->next) block->next->prev = block->prev;
  (block->prev ? block->prev->next : lists[list]) = block->next;
  if (!lists[list]) filled &= ~(uint32_t{1} << list);
}

// Makes a block free and one with its free neighbours.
Block* release(Block* block) {
  size_t size = block->size();
  Block* const after = block->after();
  if (after->isFree()) {
    remove(after);
    size += after->size();
  }
  if (block->before != 0 && block->inFront()->isFree()) {
    block = block->inFront();
    remove(block);
    size += block->size();
  }
  add(block, size);
  return block;
}

// Room for a block at the heap's end. Every header lies 8 bytes before a multiple of 16.
Block* extend(size_t size) {
  if (!end) {
    const uintptr_t base = reinterpret_cast<uintptr_t>(&__heap_base) + Block::kHeader;
    end = Block::of(reinterpret_cast<void*>((base + kAlignment - 1) & ~(kAlignment - 1)));
    if (reinterpret_cast<uintptr_t>(end->memory()) > __builtin_wasm_memory_size(0) * kPage &&
        __builtin_wasm_memory_grow(0, 1) == SIZE_MAX) {
      end = nullptr;
      return nullptr;
    }
    end->before = end->tagged = 0;
  }
  const uintptr_t memory_end = __builtin_wasm_memory_size(0) * kPage;
  const size_t last = end->before != 0 && end->inFront()->isFree() ? end->before : 0;
  const size_t have = memory_end - reinterpret_cast<uintptr_t>(end->memory()) + last;
  if (have < size) {
    const size_t pages = (size - have + kPage - 1) / kPage, more = memory_end / 8 / kPage;
    if ((pages >= more || __builtin_wasm_memory_grow(0, more) == SIZE_MAX) &&
        __builtin_wasm_memory_grow(0, pages) == SIZE_MAX) {
      return nullptr;
    }
  }
  // All that there is becomes a block, whose rest is free.
  Block* const block = end;
  const size_t all = __builtin_wasm_memory_size(0) * kPage - reinterpret_cast<uintptr_t>(block->memory());
  setSize(block, all & ~(kAlignment - 1), 0);
  end = block->after();
  end->tagged = 0;
  return release(block);
}

// A free block of at least that size. Of the list in which some blocks are too small, a few are tried.
Block* find(size_t size) {
  const int list = listOf(size);
  int tries = 8;
  for (Block* block = lists[list]; block && tries > 0; block = block->next, --tries) {
    if (block->size() >= size) return block;
  }
  const uint32_t larger = list == 31 ? 0 : filled >> (list + 1) << (list + 1);
  return larger != 0 ? lists[std::countr_zero(larger)] : extend(size);
}

void* allocate(size_t bytes) {
  if (bytes > SIZE_MAX - kPage) return nullptr;
  const size_t size = (bytes + Block::kHeader + kAlignment - 1) & ~(kAlignment - 1);
  Block* const block = find(size);
  if (!block) return nullptr;
  remove(block);
  const size_t rest = block->size() - size;
  setSize(block, size, 0);
  if (rest > 0) add(block->after(), rest);
  return block->memory();
}

}  // namespace

extern "C" {

void* malloc(size_t size) { return allocate(size); }

void free(void* memory) {
  if (memory) release(Block::of(memory));
}

void* calloc(size_t count, size_t size) {
  size_t bytes;
  if (__builtin_mul_overflow(count, size, &bytes)) return nullptr;
  void* const memory = allocate(bytes);
  if (memory) __builtin_memset(memory, 0, bytes);
  return memory;
}

void* realloc(void* memory, size_t size) {
  void* const larger = allocate(size);
  if (!larger || !memory) return larger;
  const size_t old = Block::of(memory)->size() - Block::kHeader;
  __builtin_memcpy(larger, memory, old < size ? old : size);
  free(memory);
  return larger;
}

void* aligned_alloc(size_t alignment, size_t size) {
  if (alignment <= kAlignment) return allocate(size);
  if (size > SIZE_MAX - alignment) return nullptr;
  void* const memory = allocate(size + alignment);
  const uintptr_t address = reinterpret_cast<uintptr_t>(memory);
  const size_t skipped = (0 - address) & (alignment - 1);
  if (!memory || skipped == 0) return memory;
  Block* const block = Block::of(memory);
  const size_t rest = block->size() - skipped;
  setSize(block, skipped, 0);
  setSize(block->after(), rest, 0);
  Block* const aligned = block->after();
  release(block);
  return aligned->memory();
}

// By these names libc itself asks for memory.
void* __libc_malloc(size_t size) { return allocate(size); }
void __libc_free(void* memory) { free(memory); }
void* __libc_calloc(size_t count, size_t size) { return calloc(count, size); }

// With bulk memory operations these are one instruction each.
void* memcpy(void* to, const void* from, size_t size) { return __builtin_memcpy(to, from, size); }
void* memmove(void* to, const void* from, size_t size) { return __builtin_memmove(to, from, size); }
void* memset(void* to, int value, size_t size) { return __builtin_memset(to, value, size); }
}
