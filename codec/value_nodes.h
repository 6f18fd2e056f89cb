#pragma once
// The values that are known while others are coded.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "codec/mesh.h"

namespace tutte::values {

/// Vectors of `C` components, two or four; what is not used of them is 0. Numbers of type `T`: 32 bits hold everything
/// about values below 2^20 with their fractions.
template <int C, class T>
using Vec = std::array<T, C>;

/// The vector of f(i). Its numbers are stored after all others have been read, so that compilers see one operation.
template <int C, class T, class F>
[[gnu::always_inline]] inline Vec<C, T> eachOf(F f) {
  Vec<C, T> result;
  for (size_t i = 0; i < static_cast<size_t>(C); ++i) result[i] = f(i);
  return result;
}

/// A site whose value is known.
template <int C>
struct alignas(C == 4 ? 16 : 8) Node {
  Vec<C, int32_t> value;
  Vec<C, int32_t> error;  ///< how far the prediction was off, in 1/16; at most kLargestError
};

inline constexpr int32_t kLargestError = 1 << 20;

/// The nodes by site. Sites become known in the order of their numbers.
template <int C>
class Nodes {
 public:
  explicit Nodes(Index sites) : nodes_(std::make_unique_for_overwrite<Node<C>[]>(sites)) {}

  const Node<C>& operator[](Index site) const { return nodes_[site]; }

  bool known(Index site) const { return site < count_; }
  Index count() const { return count_; }

  void add(const Node<C>& node) { nodes_[count_++] = node; }

 private:
  std::unique_ptr<Node<C>[]> nodes_;
  Index count_ = 0;
};

}  // namespace tutte::values
