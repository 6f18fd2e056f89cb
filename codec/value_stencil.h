#pragma once
// What the known surroundings say about a value: parallelograms, their average and their disagreement.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "codec/value_graph.h"
#include "codec/value_order.h"
#include "codec/value_tables.h"

namespace tutte::values {

/// Vectors of `C` components, three of them padded to four. Numbers of type `T`: 32 bits hold everything about values
/// below 2^20 with their fractions.
template <int C, class T>
using Vec = std::array<T, C == 3 ? 4 : C>;

/// A site while values are coded.
template <int C>
struct alignas(C >= 3 ? 16 : 8) Node {
  Vec<C, int32_t> value{};
  Vec<C, int32_t> error{};  ///< how far the prediction was off, in 1/16; at most kLargestError
};

inline constexpr int32_t kLargestError = 1 << 20;

/// All sites and their order. Nodes of unknown sites hold zeros.
template <int C>
class Nodes {
 public:
  explicit Nodes(Index sites) : order(sites), nodes_(sites) {}

  const Node<C>& operator[](Index site) const { return nodes_[site]; }
  bool known(Index site) const { return order.known(site); }
  /// A single parallelogram was its prediction.
  bool picked(Index site) const { return order.marked(site); }

  Node<C>& learn(Index site, bool picked) {
    order.learn(site, picked);
    return nodes_[site];
  }

  SiteOrder order;

 private:
  std::vector<Node<C>> nodes_;
};

/// Which kind of prediction was possible, best first.
enum class Source : uint8_t { kWithin, kAcrossTriangle, kAcrossFace, kStraight, kNeighbours, kLast };

/// The surroundings of one site. Predictions and spreads are in 1/16.
template <int C, class T>
class Stencil {
 public:
  using Values = Vec<C, T>;

  Stencil(const ValueGraph& graph, Nodes<C>& nodes) : graph_(graph), nodes_(nodes) {}

  /// Gathers everything for a site; `last` is used where nothing is known around it.
  /// Tells the order, too.
  void gather(Index site, const Vec<C, int32_t>& last, bool want_normal) {
    normal.fill(0);
    member_count = 0;
    want_normal_ = want_normal;
    Lists lists;
    graph_.forCorners(site, [&](Index corner) { visit(corner, lists); });
    nodes_.order.urge(lists.urgencies.entries());
    sumNeighbours(std::span(lists.around.data(), static_cast<size_t>(lists.neighbours)));
    makeMembers(std::span(lists.within.data(), static_cast<size_t>(lists.within_count)),
                std::span(lists.across.data(), static_cast<size_t>(lists.across_count)));
    settle(site, last);
  }

  static constexpr int kMostMembers = 8;

  /// Replaces what was gathered by better predictions: their average and all of them.
  void adopt(Source from, const Values& average, std::span<const Values> predictions) {
    source = from;
    base = lean = average;
    member_count = static_cast<int>(predictions.size());
    std::copy(predictions.begin(), predictions.end(), members.begin());
    member_count > 1 ? spreadOfMembers() : spread.fill(0);
  }

  Source source = Source::kLast;
  int member_count = 0;  ///< parallelograms, if `source` is one of the first two
  std::array<Values, kMostMembers> members;
  Values base;             ///< the prediction
  Values spread;           ///< how much the predictions disagree
  Values lean;             ///< another prediction: the value is likelier on its side of the base
  int32_t neighbours = 0;  ///< known ones
  int32_t picked_neighbours = 0;
  Values error_sum;               ///< of the neighbours' errors
  std::array<int64_t, 3> normal;  ///< of the surroundings, not of unit length; 0: unknown

 private:
  static constexpr int kWidth = static_cast<int>(std::tuple_size_v<Values>);
  static constexpr T kOne = 1 << kFraction;

  const Vec<C, int32_t>& value(Index site) const { return nodes_[site].value; }

  // What is known around a site. Whether something is known is hard to foresee, so nothing is decided while the lists
  // are made: they grow by 0 or 1.
  struct Lists {
    std::array<Index, 2 * ValueGraph::kMostCorners + 1> around;
    std::array<Index, ValueGraph::kMostCorners + 1> within,
        across;  // a quad's corner; the twin of a triangle's far edge
    int neighbours = 0, within_count = 0, across_count = 0;
    Urgencies urgencies;
  };

  [[gnu::always_inline]] void visit(Index corner, Lists& lists) {
    const Index next = graph_.next(corner), prev = graph_.prev(corner), degree = graph_.degree(corner);
    const Index a = graph_.site(next), b = graph_.site(prev);
    const bool know_a = nodes_.known(a), know_b = nodes_.known(b);
    lists.around[lists.neighbours] = a;
    lists.neighbours += know_a;
    lists.around[lists.neighbours] = b;
    lists.neighbours += know_b & (graph_.twin(prev) == kNone);
    if (degree == 3) {
      const Index twin = graph_.twin(next);
      lists.across[lists.across_count] = twin;
      lists.across_count += know_a & know_b & knowsBeyond(twin);
      lists.urgencies.addTriangle(a, know_a, b, know_b);
    } else if (degree == 4) {
      const Index c = graph_.site(graph_.next(next));
      const bool know_c = nodes_.known(c);
      lists.within[lists.within_count] = corner;
      lists.within_count += know_a & know_b & know_c;
      lists.urgencies.addQuad(a, know_a, b, know_b, c, know_c);
    } else {
      visitPolygon(next, prev, degree, lists.urgencies);
    }
  }

  // Are the corners of the face at both sides of an edge known? In a triangle, these are one.
  [[gnu::always_inline]] bool knowsBeyond(Index twin) const {
    const Index edge = twin == kNone ? 0 : twin;
    const bool known = nodes_.known(graph_.site(graph_.prev(edge))) & (twin != kNone);
    return graph_.degree(edge) == 3 ? known : known && nodes_.known(graph_.site(graph_.next(graph_.next(edge))));
  }

  void sumNeighbours(std::span<const Index> around) {
    Values errors{}, values{};
    picked_neighbours = 0;
    for (const Index site : around) {
      const Node<C>& node = nodes_[site];
      picked_neighbours += nodes_.picked(site);
      for (int i = 0; i < kWidth; ++i) {
        errors[i] += node.error[i];
        values[i] += node.value[i];
      }
    }
    neighbours = static_cast<int32_t>(around.size());
    error_sum = errors;
    neighbour_sum_ = values;
  }

  // Parallelograms within polygons are better than those across edges.
  void makeMembers(std::span<const Index> within, std::span<const Index> across) {
    const bool inside = within.size() > 0 || member_count > 0;
    source = inside ? Source::kWithin : across.size() > 0 ? Source::kAcrossTriangle : Source::kLast;
    for (const Index corner : within) {
      const Index next = graph_.next(corner), c = graph_.site(graph_.next(next));
      addParallelogram(graph_.site(next), graph_.site(graph_.prev(corner)), c, c, true);
    }
    for (const Index twin : across) {
      const Index next = graph_.next(twin), x = graph_.site(graph_.prev(twin));
      const Index y = graph_.degree(twin) == 3 ? x : graph_.site(graph_.next(next));
      addParallelogram(graph_.site(next), graph_.site(twin), x, y, !inside);
    }
  }

  // a + b - (x + y) / 2
  void addParallelogram(Index a, Index b, Index x, Index y, bool as_member) {
    addNormal(b, a, x);
    if (!as_member || member_count == kMostMembers) return;
    Values& member = members[member_count++];
    for (int i = 0; i < kWidth; ++i) {
      member[i] = (2 * (T{value(a)[i]} + value(b)[i]) - value(x)[i] - value(y)[i]) * (kOne / 2);
    }
  }

  // A regular polygon's diagonal over three sides is parallel to the middle one.
  void visitPolygon(Index next, Index prev, Index degree, Urgencies& urgencies) {
    const Index next2 = graph_.next(next), prev2 = graph_.prev(prev);
    const Index a = graph_.site(next), b = graph_.site(prev), c = graph_.site(next2), d = graph_.site(prev2);
    const bool know_a = nodes_.known(a), know_b = nodes_.known(b), know_c = nodes_.known(c), know_d = nodes_.known(d);
    urgencies.addPolygon(a, know_a, b, know_b, know_c, know_d);
    const PolygonRatio ratio = kPolygonRatio[degree < kLargestPolygon ? degree : kLargestPolygon];
    if (know_a && know_b) {
      if (know_d) addScaled(b, a, d, ratio.inverse);
      if (know_c) addScaled(a, b, c, ratio.inverse);
      if (know_c) addNormal(b, a, c);
    } else if (know_b && know_d) {
      const Index e = graph_.site(graph_.prev(prev2));
      if (nodes_.known(e)) addScaled(e, b, d, ratio.k);
    } else if (know_a && know_c) {
      const Index e = graph_.site(graph_.next(next2));
      if (nodes_.known(e)) addScaled(e, a, c, ratio.k);
    }
  }

  // at + (to - from) * factor
  void addScaled(Index at, Index to, Index from, int32_t factor) {
    if (member_count == kMostMembers) return;
    Values& member = members[member_count++];
    for (int i = 0; i < kWidth; ++i) {
      const int64_t scaled = (int64_t{value(to)[i]} - value(from)[i]) * factor >> (12 - kFraction);
      member[i] = value(at)[i] * kOne + static_cast<T>(scaled);
    }
  }

  void addNormal(Index origin, Index first, Index second) {
    if constexpr (C == 3) {
      if (!want_normal_) return;
      std::array<int64_t, 3> u, w;
      for (int i = 0; i < 3; ++i) {
        u[i] = int64_t{value(first)[i]} - value(origin)[i];
        w[i] = int64_t{value(second)[i]} - value(origin)[i];
      }
      for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        // Unsigned, because thousands of faces around one vertex may wrap round.
        normal[i] =
            static_cast<int64_t>(static_cast<uint64_t>(normal[i]) + static_cast<uint64_t>(u[j] * w[k] - u[k] * w[j]));
      }
    }
  }

  static Values average(const Values& sum, int32_t count) {
    Values result;
    for (int i = 0; i < kWidth; ++i) result[i] = static_cast<T>(mean(int64_t{sum[i]}, static_cast<uint32_t>(count)));
    return result;
  }

  // Fills in base and spread from the best source.
  void settle(Index site, const Vec<C, int32_t>& last) {
    if (member_count == 1) base = members[0];
    if (member_count == 2) {
      for (int i = 0; i < kWidth; ++i) base[i] = (members[0][i] + members[1][i] + 1) >> 1;
    }
    if (member_count > 2) {
      Values sum = members[0];
      for (int m = 1; m < member_count; ++m) {
        for (int i = 0; i < kWidth; ++i) sum[i] += members[m][i];
      }
      base = average(sum, member_count);
    }
    if (member_count > 0) lean = base;
    member_count > 1 ? spreadOfMembers() : settleFromAfar(site, last);
  }

  void spreadOfMembers() {
    spread.fill(0);
    for (int m = 1; m < member_count; ++m) {
      for (int i = 0; i < kWidth; ++i) {
        const T off = members[m][i] - members[0][i];
        spread[i] = std::max(spread[i], off < 0 ? -off : off);
      }
    }
  }

  // Predictions of one weaker kind.
  struct Far {
    Values sum{};
    int32_t count = 0;
  };

  // Weaker predictions: the best is the base where there is no parallelogram, the next one measures its reliability.
  void settleFromAfar(Index site, const Vec<C, int32_t>& last) {
    Far across, straight;
    graph_.forCorners(site, [&](Index corner) {
      if (graph_.degree(corner) > 3) lookAcross(corner, across, straight);
    });
    spread.fill(0);
    bool have_base = member_count > 0, have_spread = false;
    const auto offer = [&](Source from, const Values& prediction) {
      if (!have_base) {
        base = lean = prediction;
        source = from;
        have_base = true;
      } else if (!have_spread) {
        for (int i = 0; i < kWidth; ++i) {
          const T off = prediction[i] - base[i];
          spread[i] = off < 0 ? -off : off;
        }
        lean = prediction;
        have_spread = true;
      }
    };
    if (across.count > 0) offer(Source::kAcrossFace, average(across.sum, across.count));
    if (straight.count > 0) offer(Source::kStraight, average(straight.sum, straight.count));
    if (neighbours > 0 && !have_spread) {
      Values mean_value;
      for (int i = 0; i < kWidth; ++i) {
        mean_value[i] = static_cast<T>(mean(int64_t{neighbour_sum_[i]} * kOne, static_cast<uint32_t>(neighbours)));
      }
      offer(Source::kNeighbours, mean_value);
    }
    if (!have_base) {
      source = Source::kLast;
      for (int i = 0; i < kWidth; ++i) base[i] = lean[i] = last[i] * kOne;
    }
  }

  void lookAcross(Index corner, Far& across, Far& straight) {
    const Index next = graph_.next(corner), prev = graph_.prev(corner), prev2 = graph_.prev(prev);
    const Index beyond_next = graph_.twin(next), beyond_prev = graph_.twin(prev2);
    const Index a = graph_.site(next), b = graph_.site(prev);
    if (nodes_.known(a) && beyond_next != kNone) {
      lookAcross(a, graph_.site(graph_.next(next)), graph_.next(graph_.next(beyond_next)), graph_.prev(beyond_next),
                 across, straight, graph_.degree(beyond_next));
    }
    if (nodes_.known(b) && beyond_prev != kNone) {
      lookAcross(b, graph_.site(prev2), graph_.prev(beyond_prev), graph_.next(graph_.next(beyond_prev)), across,
                 straight, graph_.degree(beyond_prev));
    }
  }

  // The face beyond the edge from a (the neighbour) to c: y lies beyond a, x beyond c.
  void lookAcross(Index a, Index c, Index beyond_a, Index beyond_c, Far& across, Far& straight, Index degree) {
    const Index x = graph_.site(beyond_c), y = graph_.site(beyond_a);
    if (nodes_.known(x) && nodes_.known(c) && across.count < kMostMembers) {
      for (int i = 0; i < kWidth; ++i) {
        across.sum[i] += degree == 3 ? (3 * T{value(a)[i]} + value(c)[i] - 2 * T{value(x)[i]}) * (kOne / 2)
                                     : (T{value(a)[i]} + value(c)[i] - value(x)[i]) * kOne;
      }
      ++across.count;
    }
    if (degree > 3 && nodes_.known(y) && straight.count < kMostMembers) {
      for (int i = 0; i < kWidth; ++i) straight.sum[i] += (2 * T{value(a)[i]} - value(y)[i]) * kOne;
      ++straight.count;
    }
  }

  const ValueGraph& graph_;
  Nodes<C>& nodes_;
  Values neighbour_sum_;
  bool want_normal_ = false;
};

}  // namespace tutte::values
