#pragma once
// Memory that outlives its user.

#include <utility>

namespace tutte {

/// A value that was somebody else's, and is again when this ends: vectors keep their memory from one user to the next.
template <class T>
class Borrowed {
 public:
  explicit Borrowed(T& owner) : value_(std::move(owner)), owner_(owner) {}
  ~Borrowed() { owner_ = std::move(value_); }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;

  T* operator->() { return &value_; }
  T& operator*() { return value_; }

 private:
  T value_;
  T& owner_;
};

}  // namespace tutte
