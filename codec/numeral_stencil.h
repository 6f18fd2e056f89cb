#pragma once
// Predictions of floats from the known values around a site.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "codec/value_graph.h"
#include "codec/value_tables.h"

namespace tutte::numerals {

inline constexpr int kMostComponents = 4;
using Row = std::array<int64_t, kMostComponents>;

/// A site whose value is known: its components in the units of their systems, and how far the predictions were off, in
/// 1/16 of these.
struct Node {
  std::array<int32_t, kMostComponents> value{};
  std::array<uint32_t, kMostComponents> error{};
  bool known = false;
};

/// floor((a + b / 2) / b), b > 0.
constexpr int64_t divideRounded(int64_t a, int64_t b) {
  const int64_t sum = a + b / 2;
  return sum >= 0 ? sum / b : -((-sum + b - 1) / b);
}

/// What is known around one site: parallelograms within its polygons or, without these, across the edges of its
/// triangles; else the mean of its neighbours; else the value before. All in 1/16.
class Stencil {
 public:
  Stencil(const ValueGraph& graph, int components)
      : graph_(graph), components_(components), nodes_(graph.siteCount()) {}

  void gather(Index site) {
    members_ = 0;
    neighbours_ = 0;
    within_ = false;
    error_sum_.fill(0);
    sum_.fill(0);
    for (const Index corner : graph_.corners(site)) visit(corner);
    settle();
  }

  Node& node(Index site) { return nodes_[site]; }
  void remember(Index site) { last_ = nodes_[site].value; }

  int members() const { return members_; }
  bool hasNeighbours() const { return neighbours_ > 0; }
  const Row& base() const { return base_; }
  const Row& spread() const { return spread_; }  ///< how far the parallelograms, or two predictions, are apart
  int64_t meanError(int component) const { return error_sum_[component] / neighbours_; }

 private:
  static constexpr int kMostMembers = 8;
  static constexpr int64_t kOne = 16;

  const Node& at(Index corner) const { return nodes_[graph_.site(corner)]; }

  void visit(Index corner) {
    const Index next = graph_.next(corner), prev = graph_.prev(corner);
    const Node &a = at(next), &b = at(prev);
    if (a.known) addNeighbour(a);
    if (b.known && graph_.twin(prev) == kNone) addNeighbour(b);
    if (!a.known || !b.known) return;
    const Index degree = graph_.degree(corner);
    if (degree == 3) return visitTriangle(graph_.twin(next), a, b);
    const int64_t scale = values::kPolygonRatio[std::min(degree, values::kLargestPolygon)].inverse;
    const Node &c = at(graph_.next(next)), &d = at(graph_.prev(prev));
    if (c.known) addWithin(a, b, c, scale);
    if (degree > 4 && d.known) addWithin(b, a, d, scale);
  }

  // from + (to - corner) / k, k being the ratio of a regular polygon's diagonal to its side.
  void addWithin(const Node& from, const Node& to, const Node& corner, int64_t scale) {
    if (!within_) members_ = 0;
    within_ = true;
    if (members_ == kMostMembers) return;
    for (int i = 0; i < components_; ++i) {
      member_[members_][i] = from.value[i] * kOne + ((int64_t{to.value[i]} - corner.value[i]) * scale >> 8);
    }
    ++members_;
  }

  void visitTriangle(Index twin, const Node& a, const Node& b) {
    if (within_ || twin == kNone || members_ == kMostMembers) return;
    const Node& x = at(graph_.prev(twin));
    const Node& y = graph_.degree(twin) == 3 ? x : at(graph_.next(graph_.next(twin)));
    if (!x.known || !y.known) return;
    for (int i = 0; i < components_; ++i) {
      member_[members_][i] = (2 * (int64_t{a.value[i]} + b.value[i]) - x.value[i] - y.value[i]) * (kOne / 2);
    }
    ++members_;
  }

  void addNeighbour(const Node& node) {
    ++neighbours_;
    for (int i = 0; i < components_; ++i) error_sum_[i] += node.error[i];
    for (int i = 0; i < components_; ++i) sum_[i] += node.value[i] * kOne;
  }

  void settle() {
    for (int i = 0; i < components_; ++i) {
      const int64_t around = neighbours_ > 0 ? divideRounded(sum_[i], neighbours_) : last_[i] * kOne;
      int64_t sum = 0, widest = 0;
      for (int m = 0; m < members_; ++m) {
        sum += member_[m][i];
        widest = std::max(widest, std::abs(member_[m][i] - member_[0][i]));
      }
      base_[i] = members_ > 0 ? divideRounded(sum, members_) : around;
      spread_[i] = members_ > 1 ? widest : std::abs(base_[i] - around);
    }
  }

  const ValueGraph& graph_;
  const int components_;
  std::vector<Node> nodes_;
  std::array<int32_t, kMostComponents> last_{};

  // Of the current site.
  int members_ = 0;
  bool within_ = false;
  int64_t neighbours_ = 0;
  std::array<Row, kMostMembers> member_;
  Row base_{}, spread_{}, sum_{}, error_sum_{};
};

}  // namespace tutte::numerals
