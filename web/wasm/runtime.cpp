// What libraries do when they cannot go on. libc's and libc++'s own versions print, which would need a system; and
// libc++'s operator new, built without exceptions, returns null, which in WebAssembly is memory like any other. These
// trap: the caller of the instance gets an error and makes a new one.

#include <cstddef>
#include <cstdlib>
#include <new>

extern "C" {
_Noreturn void abort() { __builtin_trap(); }
_Noreturn void __cxa_pure_virtual() { __builtin_trap(); }
_Noreturn void _Exit(int) { __builtin_trap(); }

int __cxa_atexit(void (*)(void*), void*, void*) { return 0; }  // a module never ends
}

void* operator new(size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) abort();
  return memory;
}
void* operator new[](size_t size) { return operator new(size); }
void* operator new(size_t size, std::align_val_t alignment) {
  const size_t step = static_cast<size_t>(alignment);
  void* const memory = std::aligned_alloc(step, (size + step - 1) / step * step);
  if (memory == nullptr) abort();
  return memory;
}
void* operator new(size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
