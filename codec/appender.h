#pragma once
// Vectors that the walk's inner loop fills: adding to them is a store and a comparison, never a call.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

/// Makes a vector longer by a block: as much as its room allows, but no more than what fits into a cache.
inline void growByBlock(std::vector<Index>& vector, Index fill) {
  constexpr size_t kLeast = 64, kMost = 4096;
  vector.resize(std::max(vector.size() + kLeast, std::min(vector.size() + kMost, vector.capacity())), fill);
}

/// Appends to a vector that somebody else owns, which is longer than what was added until finish().
class Appender {
 public:
  /// `expected`: room that is reserved at once.
  Appender(std::vector<Index>& target, size_t expected) : target_(target) { target.reserve(expected); }

  Index size() const { return static_cast<Index>(size_); }

  void add(Index value) {
    if (size_ == room_) grow();
    data_[size_++] = value;
  }

  void finish() { target_.resize(size_); }

 private:
  [[gnu::noinline]] void grow() {
    growByBlock(target_, 0);
    data_ = target_.data();
    room_ = target_.size();
  }

  std::vector<Index>& target_;
  Index* data_ = nullptr;
  size_t size_ = 0, room_ = 0;  // not Index, so that compilers know that no element written changes them
};

/// The same for the corners of a mesh.
class CornerAppender {
 public:
  CornerAppender(Connectivity& mesh, size_t expected) : mesh_(mesh) {
    mesh.umbrellas.reserve(expected);
    mesh.twins.reserve(expected);
  }

  Index size() const { return static_cast<Index>(size_); }
  Index umbrella(Index corner) const { return umbrellas_[corner]; }

  /// A corner without a twin.
  void add(Index umbrella) {
    if (size_ == room_) grow();
    umbrellas_[size_++] = umbrella;
  }

  /// Makes the last corner and an earlier one twins.
  void pairLast(Index corner) {
    twins_[size_ - 1] = corner;
    twins_[corner] = static_cast<Index>(size_ - 1);
  }

  void finish() {
    mesh_.umbrellas.resize(size_);
    mesh_.twins.resize(size_);
  }

 private:
  [[gnu::noinline]] void grow() {
    growByBlock(mesh_.umbrellas, 0);
    growByBlock(mesh_.twins, kNone);
    umbrellas_ = mesh_.umbrellas.data();
    twins_ = mesh_.twins.data();
    room_ = std::min(mesh_.umbrellas.size(), mesh_.twins.size());
  }

  Connectivity& mesh_;
  Index* umbrellas_ = nullptr;
  Index* twins_ = nullptr;
  size_t size_ = 0, room_ = 0;  // not Index, so that compilers know that no element written changes them
};

}  // namespace tutte
