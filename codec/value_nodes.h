#pragma once
// The values that are known while others are coded.

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "codec/mesh.h"

namespace tutte::values {

/// Vectors of `C` components, two or four; what is not used of them is 0. Numbers of type `T`: 32 bits hold everything
/// about values below 2^20 with their fractions.
template <int C, class T>
using Vec = std::array<T, C>;

/// A site whose value is known.
template <int C>
struct alignas(C == 4 ? 16 : 8) Node {
  Vec<C, int32_t> value{};
  Vec<C, int32_t> error{};  ///< how far the prediction was off, in 1/16; at most kLargestError
};

inline constexpr int32_t kLargestError = 1 << 20;

/// The nodes in the order in which they became known, so that what is asked for together lies together.
template <int C>
class Nodes {
 public:
  /// `ranks` as SurroundingsFinder::ranks().
  explicit Nodes(std::span<const Index> ranks)
      : ranks_(ranks), nodes_(new Node<C>[ranks.size()]), picked_(new uint8_t[ranks.size()]) {}

  const Node<C>& operator[](Index rank) const { return nodes_[rank]; }
  /// A single parallelogram was its prediction.
  bool picked(Index rank) const { return picked_[rank] != 0; }

  bool known(Index site) const { return ranks_[site] < count_; }
  Index rankOf(Index site) const { return ranks_[site]; }
  Index count() const { return count_; }

  void add(const Node<C>& node, bool picked) {
    nodes_[count_] = node;
    picked_[count_++] = picked;
  }

 private:
  std::span<const Index> ranks_;
  std::unique_ptr<Node<C>[]> nodes_;
  std::unique_ptr<uint8_t[]> picked_;
  Index count_ = 0;
};

}  // namespace tutte::values
