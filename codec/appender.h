#pragma once
// Vectors that the walk's inner loop fills: adding to them is a store and a comparison, never a call.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

inline constexpr size_t kLeastBlock = 64;

/// Makes a vector longer by a block: as much as its room allows, but no more than what fits into a cache.
inline void growByBlock(std::vector<Index>& vector, Index fill) {
  constexpr size_t kMost = 4096;
  vector.resize(std::max(vector.size() + kLeastBlock, std::min(vector.size() + kMost, vector.capacity())), fill);
}

/// Appends to a vector that somebody else owns, which is longer than what was added until finish().
class Appender {
 public:
  /// `expected`: room that is reserved at once.
  Appender(std::vector<Index>& target, size_t expected) : target_(target) { target.reserve(expected); }

  Index size() const { return static_cast<Index>(size_); }

  [[gnu::always_inline]] void add(Index value) {
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

/// The corners of a mesh, likewise. Whoever adds some counts them, writes to umbrellas() and twins(), and tells size().
class CornerAppender {
 public:
  CornerAppender(Connectivity& mesh, size_t expected) : mesh_(mesh) {
    // With room behind the last ones, too, or the vectors would become twice as long for it.
    mesh.umbrellas.reserve(expected + kLeastBlock);
    mesh.twins.reserve(expected + kLeastBlock);
  }

  bool hasRoom(size_t corners) const { return corners <= room_; }

  /// `corners` elements, those that were not written included. New twins are kNone. May move the arrays. There is room
  /// for no more than `most`.
  void makeRoom(size_t corners, uint64_t most = kNone) {
    if (corners > room_) grow(corners, most);
  }
  Index* umbrellas() { return umbrellas_; }
  Index* twins() { return twins_; }

  size_t size() const { return size_; }
  void setSize(size_t size) { size_ = size; }

  void finish() {
    mesh_.umbrellas.resize(size_);
    mesh_.twins.resize(size_);
  }

 private:
  [[gnu::noinline]] void grow(size_t corners, uint64_t most) {
    while (corners > room_) {
      growByBlock(mesh_.umbrellas, 0);
      growByBlock(mesh_.twins, kNone);
      room_ = std::min<uint64_t>(std::min(mesh_.umbrellas.size(), mesh_.twins.size()), most);
    }
    umbrellas_ = mesh_.umbrellas.data();
    twins_ = mesh_.twins.data();
  }

  Connectivity& mesh_;
  Index* umbrellas_ = nullptr;
  Index* twins_ = nullptr;
  size_t size_ = 0, room_ = 0;  // not Index, for the same reason
};

}  // namespace tutte
