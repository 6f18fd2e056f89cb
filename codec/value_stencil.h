#pragma once
// What the known surroundings say about a value: parallelograms, their average and their disagreement.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/value_graph.h"
#include "codec/value_tables.h"

namespace tutte::values {

/// A site while values are coded.
template <int C>
struct Node {
  std::array<int32_t, C> value{};
  std::array<uint32_t, C> error{};  ///< how far the prediction was off, in 1/16
  bool known = false;
  bool picked = false;  ///< a single parallelogram was picked for it
};

template <int C>
using Vec = std::array<int64_t, C>;

/// Which kind of prediction was possible, best first.
enum class Source : uint8_t { kWithin, kAcrossTriangle, kAcrossFace, kStraight, kNeighbours, kLast };

/// The surroundings of one site. Predictions and spreads are in 1/16.
template <int C>
class Stencil {
 public:
  Stencil(const ValueGraph& graph, const std::vector<Node<C>>& nodes) : graph_(graph), nodes_(nodes) {}

  /// Gathers everything for a site; `last` is used where nothing is known around it.
  void gather(Index site, const Vec<C>& last, bool want_normal) {
    member_count = neighbours = picked_neighbours = 0;
    source = Source::kLast;
    error_sum.fill(0);
    neighbour_sum_.fill(0);
    normal.fill(0);
    want_normal_ = want_normal;
    for (const Index corner : graph_.cornersOf(site)) visit(corner);
    settle(site, last);
  }

  static constexpr int kMostMembers = 8;

  /// Replaces what was gathered by better predictions: their average and all of them.
  void adopt(Source from, const Vec<C>& average, std::span<const Vec<C>> predictions) {
    source = from;
    base = lean = average;
    member_count = static_cast<int>(predictions.size());
    std::copy(predictions.begin(), predictions.end(), members.begin());
    member_count > 1 ? spreadOfMembers() : spread.fill(0);
  }

  Source source = Source::kLast;
  int member_count = 0;  ///< parallelograms, if `source` is one of the first two
  std::array<Vec<C>, kMostMembers> members;
  Vec<C> base;              ///< the prediction
  Vec<C> spread;            ///< how much the predictions disagree
  Vec<C> lean;              ///< another prediction: the value is likelier on its side of the base
  uint32_t neighbours = 0;  ///< known ones
  uint32_t picked_neighbours = 0;
  Vec<C> error_sum;               ///< of the neighbours' errors
  std::array<int64_t, 3> normal;  ///< of the surroundings, not of unit length; 0: unknown

 private:
  const Node<C>& node(Index corner) const { return nodes_[graph_.site(corner)]; }

  void visit(Index corner) {
    const Index next = graph_.next(corner), prev = graph_.prev(corner);
    const Node<C>&a = node(next), &b = node(prev);
    if (a.known) addNeighbour(a);
    if (b.known && graph_.twin(prev) == kNone) addNeighbour(b);
    const Index degree = graph_.degree(corner);
    if (degree > 4) return visitPolygon(next, prev, a, b, degree);
    if (!a.known || !b.known) return;
    if (degree == 3) return visitTriangle(next, a, b);
    const Node<C>& c = node(graph_.next(next));
    if (!c.known) return;
    addNormal(c, a, b);
    if (Vec<C>* member = newMember(Source::kWithin)) {
      for (int i = 0; i < C; ++i) (*member)[i] = (int64_t{a.value[i]} + b.value[i] - c.value[i]) * kOne;
    }
  }

  void visitTriangle(Index next, const Node<C>& a, const Node<C>& b) {
    const Index twin = graph_.twin(next);
    if (twin == kNone) return;
    const Index beyond_b = graph_.prev(twin);
    const Node<C>& x = node(beyond_b);
    if (!x.known) return;
    const bool triangle = graph_.degree(twin) == 3;
    const Node<C>& y = triangle ? x : node(graph_.next(graph_.next(twin)));
    if (!y.known) return;
    addNormal(b, a, x);
    if (Vec<C>* member = newMember(Source::kAcrossTriangle)) {
      for (int i = 0; i < C; ++i) {
        (*member)[i] = (2 * (int64_t{a.value[i]} + b.value[i]) - x.value[i] - y.value[i]) * (kOne / 2);
      }
    }
  }

  // A regular polygon's diagonal over three sides is parallel to the middle one.
  void visitPolygon(Index next, Index prev, const Node<C>& a, const Node<C>& b, Index degree) {
    const Index next2 = graph_.next(next), prev2 = graph_.prev(prev);
    const Node<C>&c = node(next2), &d = node(prev2);
    const PolygonRatio ratio = kPolygonRatio[degree < kLargestPolygon ? degree : kLargestPolygon];
    if (a.known && b.known) {
      if (d.known) addScaled(b, a, d, ratio.inverse);
      if (c.known) addScaled(a, b, c, ratio.inverse);
      if (c.known) addNormal(c, a, b);
    } else if (b.known && d.known) {
      const Node<C>& e = node(graph_.prev(prev2));
      if (e.known) addScaled(e, b, d, ratio.k);
    } else if (a.known && c.known) {
      const Node<C>& e = node(graph_.next(next2));
      if (e.known) addScaled(e, a, c, ratio.k);
    }
  }

  // at + (to - from) * factor
  void addScaled(const Node<C>& at, const Node<C>& to, const Node<C>& from, int32_t factor) {
    Vec<C>* member = newMember(Source::kWithin);
    if (!member) return;
    for (int i = 0; i < C; ++i) {
      (*member)[i] = at.value[i] * kOne + ((int64_t{to.value[i]} - from.value[i]) * factor >> (12 - kFraction));
    }
  }

  Vec<C>* newMember(Source from) {
    if (from < source) {
      source = from;
      member_count = 0;
    }
    return from == source && member_count < kMostMembers ? &members[member_count++] : nullptr;
  }

  void addNeighbour(const Node<C>& neighbour) {
    ++neighbours;
    picked_neighbours += neighbour.picked;
    for (int i = 0; i < C; ++i) {
      error_sum[i] += neighbour.error[i];
      neighbour_sum_[i] += neighbour.value[i];
    }
  }

  void addNormal(const Node<C>& origin, const Node<C>& first, const Node<C>& second) {
    if constexpr (C == 3) {
      if (!want_normal_) return;
      std::array<int64_t, 3> u, w;
      for (int i = 0; i < 3; ++i) {
        u[i] = int64_t{first.value[i]} - origin.value[i];
        w[i] = int64_t{second.value[i]} - origin.value[i];
      }
      for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        // Unsigned, because thousands of faces around one vertex may wrap round.
        normal[i] =
            static_cast<int64_t>(static_cast<uint64_t>(normal[i]) + static_cast<uint64_t>(u[j] * w[k] - u[k] * w[j]));
      }
    }
  }

  // Fills in base and spread from the best source.
  void settle(Index site, const Vec<C>& last) {
    if (member_count > 0) {
      for (int i = 0; i < C; ++i) {
        int64_t sum = 0;
        for (int m = 0; m < member_count; ++m) sum += members[m][i];
        base[i] = mean(sum, static_cast<uint32_t>(member_count));
      }
      lean = base;
      if (member_count > 1) return spreadOfMembers();
    }
    settleFromAfar(site, last);
  }

  void spreadOfMembers() {
    for (int i = 0; i < C; ++i) {
      int64_t widest = 0;
      for (int m = 1; m < member_count; ++m) {
        const int64_t off = members[m][i] - members[0][i];
        widest = std::max(widest, off < 0 ? -off : off);
      }
      spread[i] = widest;
    }
  }

  // Weaker predictions: the best is the base where there is no parallelogram, the next one measures its reliability.
  void settleFromAfar(Index site, const Vec<C>& last) {
    Far across, straight;
    for (const Index corner : graph_.cornersOf(site)) {
      if (graph_.degree(corner) < 4) continue;
      const Index next = graph_.next(corner), prev = graph_.prev(corner);
      const Index next2 = graph_.next(next), prev2 = graph_.prev(prev);
      const Index beyond_next = graph_.twin(next), beyond_prev = graph_.twin(prev2);
      if (node(next).known && beyond_next != kNone) {
        lookAcross(node(next), node(next2), graph_.next(graph_.next(beyond_next)), graph_.prev(beyond_next), across,
                   straight, graph_.degree(beyond_next));
      }
      if (node(prev).known && beyond_prev != kNone) {
        lookAcross(node(prev), node(prev2), graph_.prev(beyond_prev), graph_.next(graph_.next(beyond_prev)), across,
                   straight, graph_.degree(beyond_prev));
      }
    }
    spread.fill(0);
    bool have_base = member_count > 0, have_spread = false;
    const auto offer = [&](Source from, const Vec<C>& prediction) {
      if (!have_base) {
        base = lean = prediction;
        source = from;
        have_base = true;
      } else if (!have_spread) {
        for (int i = 0; i < C; ++i)
          spread[i] = prediction[i] < base[i] ? base[i] - prediction[i] : prediction[i] - base[i];
        lean = prediction;
        have_spread = true;
      }
    };
    if (across.count > 0) offer(Source::kAcrossFace, across.average());
    if (straight.count > 0) offer(Source::kStraight, straight.average());
    if (neighbours > 0) {
      Vec<C> average;
      for (int i = 0; i < C; ++i) average[i] = mean(neighbour_sum_[i] * kOne, neighbours);
      offer(Source::kNeighbours, average);
    }
    if (!have_base) {
      source = Source::kLast;
      for (int i = 0; i < C; ++i) base[i] = lean[i] = last[i] * kOne;
    }
  }

  struct Far {
    Vec<C> sum{};
    uint32_t count = 0;
    Vec<C> average() const {
      Vec<C> result;
      for (int i = 0; i < C; ++i) result[i] = mean(sum[i], count);
      return result;
    }
  };

  // The face beyond the edge from a (the neighbour) to c: y lies beyond a, x beyond c.
  void lookAcross(const Node<C>& a, const Node<C>& c, Index beyond_a, Index beyond_c, Far& across, Far& straight,
                  Index degree) {
    const Node<C>&x = node(beyond_c), &y = node(beyond_a);
    if (degree == 3) {
      if (!x.known || !c.known) return;
      for (int i = 0; i < C; ++i) {
        across.sum[i] += (3 * int64_t{a.value[i]} + c.value[i] - 2 * int64_t{x.value[i]}) * (kOne / 2);
      }
      ++across.count;
      return;
    }
    if (x.known && c.known) {
      for (int i = 0; i < C; ++i) across.sum[i] += (int64_t{a.value[i]} + c.value[i] - x.value[i]) * kOne;
      ++across.count;
    }
    if (y.known) {
      for (int i = 0; i < C; ++i) straight.sum[i] += (2 * int64_t{a.value[i]} - y.value[i]) * kOne;
      ++straight.count;
    }
  }

  static constexpr int64_t kOne = 1 << kFraction;

  const ValueGraph& graph_;
  const std::vector<Node<C>>& nodes_;
  Vec<C> neighbour_sum_;
  bool want_normal_ = false;
};

}  // namespace tutte::values
