#pragma once
// The one place where exceptions of the libraries below end.

#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace tutte {

/// What a library has thrown.
struct Thrown {
  bool memory;       ///< there was not enough, or a size was asked for that no memory has
  const char* what;  ///< a sentence; lives until `instead` returns
};

/// `work()`, or `instead(Thrown)` when a library below throws. In builds without exceptions, such as WebAssembly's,
/// nothing throws: where memory ends, the program does.
template <class Work, class Instead>
auto caught(Work&& work, [[maybe_unused]] Instead&& instead) -> decltype(work()) {
#if defined(__cpp_exceptions)
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return instead(Thrown{true, "out of memory"});
  } catch (const std::length_error&) {
    return instead(Thrown{true, "out of memory"});
  } catch (const std::exception& error) {
    return instead(Thrown{false, error.what()});
  }
#else
  return work();
#endif
}

}  // namespace tutte
