#include "codec/value_surroundings.h"

#include <algorithm>
#include <type_traits>

#include "codec/value_tables.h"

namespace tutte::values {

SurroundingsFinder::SurroundingsFinder(const ValueGraph& graph, bool want_edges)
    : graph_(graph), want_edges_(want_edges), order_(graph.siteCount()), lists_(new Lists) {}

void SurroundingsFinder::fill() {
  Lists& lists = *lists_;
  lists.neighbours.restart();
  for (auto* list : {&lists.within, &lists.across, &lists.planes}) list->restart();
  for (auto* list : {&lists.over, &lists.straight}) list->restart();
  lists.scaled.restart();
  lists.edges.restart();
  at_ = 0;
  count_ = static_cast<int>(std::min<Index>(kBatch, graph_.siteCount() - order_.knownCount()));
  graph_.withFaces([&](const auto& faces) {
    for (int i = 0; i < count_; ++i) find(faces, order_.next(), batch_[static_cast<size_t>(i)]);
  });
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::find(const Faces& faces, Index site, Surroundings& found) {
  Lists& lists = *lists_;
  urgencies_.clear();
  graph_.forFans(faces, site, [&](std::span<const Index> fan, bool closed) { visitFan(faces, fan, closed); });
  if constexpr (!Faces::kAllTriangles) {
    const int inside = lists.scaled.size() + lists.within.size();
    if (inside == 1 || (inside == 0 && lists.across.size() < 2)) {
      graph_.forFans(faces, site, [&](std::span<const Index> fan, bool) {
        for (const Index corner : fan) lookFar(faces, corner);
      });
    }
  }
  order_.urge(urgencies_.entries());
  order_.learn(site);
  found.site = site;
  found.neighbours = lists.neighbours.take();
  found.across = lists.across.take();
  if (want_edges_) found.edges = lists.edges.take();
  if constexpr (!Faces::kAllTriangles) {
    found.scaled = lists.scaled.take();
    found.within = lists.within.take();
    found.planes = lists.planes.take();
    found.over = lists.over.take();
    found.straight = lists.straight.take();
  }
}

[[gnu::always_inline]] inline void SurroundingsFinder::visitQuad(const AnyFaces& faces, Index corner, Side& a,
                                                                 Side& b) {
  const Index site = graph_.site(faces.next(faces.next(corner))), c = order_.rank(site);
  const bool know_c = SiteOrder::isRank(c);
  const int others = a.known() + b.known() + know_c;
  const Index amount = others == 2 ? 16 : others == 1 ? 2 : 0;
  a.urgency += amount;
  b.urgency += amount;
  urgencies_.add(site, amount, !know_c & (others == 2));
  lists_->within.add({a.rank, b.rank, c, c}, others == 3);
}

// Faces and sides take turns: face i lies between the sides i and i + 1.
template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::visitFan(const Faces& faces, std::span<const Index> fan,
                                                                bool closed) {
  std::array<Side, kCorners + 1> sides;
  const size_t count = fan.size();
  auto& neighbours = lists_->neighbours;
  Index* grown = neighbours.end;
  const auto addSide = [&](size_t i, Index corner, bool counts) {
    const Index site = graph_.site(corner), rank = order_.rank(site);
    sides[i] = {site, rank, 0};
    *grown = rank;
    grown += SiteOrder::isRank(rank) & counts;
  };
  for (size_t i = 0; i < count; ++i) addSide(i, faces.next(fan[i]), true);
  const Index end = faces.prev(fan[count - 1]);
  addSide(count, end, graph_.twin(end) == kNone);
  neighbours.end = grown;
  for (size_t i = 0; i < count; ++i) {
    Side &a = sides[i], &b = sides[i + 1];
    const Index degree = faces.degree(fan[i]);
    if (want_edges_) addEdges(faces, fan[i], a.site, b.site);
    if (degree == 3) visitTriangle(faces, fan[i], a, b);
    if constexpr (!Faces::kAllTriangles) {
      if (degree == 4) visitQuad(faces, fan[i], a, b);
      if (degree > 4) visitPolygon(faces, fan[i], a, b);
    }
  }
  if (closed) sides[0].urgency += sides[count].urgency;
  for (size_t i = count + !closed; i-- > 0;) urgencies_.add(sides[i].site, sides[i].urgency, !sides[i].known());
}

// Across the edge from a to b: the corners of the face beyond it at both sides, which are one in a triangle.
template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::visitTriangle(const Faces& faces, Index corner, Side& a,
                                                                     Side& b) {
  a.urgency += 2 * b.known();
  b.urgency += 2 * a.known();
  if (!(a.known() & b.known())) return;
  const Index twin = graph_.twin(faces.next(corner));
  if (twin == kNone) return;
  const Index x = order_.rank(graph_.site(faces.prev(twin)));
  Index y = x;
  if constexpr (!Faces::kAllTriangles) {
    if (faces.degree(twin) != 3) y = order_.rank(graph_.site(faces.next(faces.next(twin))));
  }
  lists_->across.add({a.rank, b.rank, x, y}, SiteOrder::isRank(x | y));
}

// A regular polygon's diagonal over three sides is parallel to the middle one.
void SurroundingsFinder::visitPolygon(const AnyFaces& faces, Index corner, Side& a, Side& b) {
  const Index next2 = faces.next(faces.next(corner)), prev2 = faces.prev(faces.prev(corner));
  const Index c = order_.rank(graph_.site(next2)), d = order_.rank(graph_.site(prev2));
  const bool know_a = a.known(), know_b = b.known(), know_c = SiteOrder::isRank(c), know_d = SiteOrder::isRank(d);
  a.urgency += know_c ? 8 : know_b ? 2 : 0;
  b.urgency += know_d ? 8 : know_a ? 2 : 0;
  const PolygonRatio ratio = kPolygonRatio[std::min(faces.degree(corner), kLargestPolygon)];
  const auto k = static_cast<Index>(ratio.k), inverse = static_cast<Index>(ratio.inverse);
  auto& scaled = lists_->scaled;
  if (know_a && know_b) {
    scaled.add({b.rank, a.rank, d, inverse}, know_d);
    scaled.add({a.rank, b.rank, c, inverse}, know_c);
    lists_->planes.add({b.rank, a.rank, c, 0}, know_c);
  } else if (know_b && know_d) {
    const Index e = order_.rank(graph_.site(faces.prev(prev2)));
    scaled.add({e, b.rank, d, k}, SiteOrder::isRank(e));
  } else if (know_a && know_c) {
    const Index e = order_.rank(graph_.site(faces.next(next2)));
    scaled.add({e, a.rank, c, k}, SiteOrder::isRank(e));
  }
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::addEdges(const Faces& faces, Index corner, Index a, Index b) {
  addEdge(a, b);
  if constexpr (!Faces::kAllTriangles) {
    if (faces.degree(corner) == 3) return;
    addEdge(a, graph_.site(faces.next(faces.next(corner))));
    addEdge(graph_.site(faces.prev(faces.prev(corner))), b);
  }
}

// The face beyond the edge from a (the neighbour) to c: y lies beyond a, x beyond c.
[[gnu::always_inline]] inline void SurroundingsFinder::lookFar(Index a, Index c, Index beyond_a, Index beyond_c,
                                                               Index degree) {
  const Index rank_a = order_.rank(a);
  if (!SiteOrder::isRank(rank_a)) return;
  const Index rank_c = order_.rank(c);
  const Index x = order_.rank(graph_.site(beyond_c)), y = order_.rank(graph_.site(beyond_a));
  const bool over = SiteOrder::isRank(rank_c | x), straight = SiteOrder::isRank(y) & (degree > 3);
  lists_->over.add({rank_a, rank_c, x, degree == 3}, over && lists_->over.size() < kMostFar);
  lists_->straight.add({rank_a, rank_a, y, 0}, straight && lists_->straight.size() < kMostFar);
}

// Over the edges that are opposite or beside; weaker than what is within.
void SurroundingsFinder::lookFar(const AnyFaces& faces, Index corner) {
  if (faces.degree(corner) <= 3) return;
  const Index next = faces.next(corner), prev = faces.prev(corner), prev2 = faces.prev(prev);
  const Index beyond_next = graph_.twin(next), beyond_prev = graph_.twin(prev2);
  if (beyond_next != kNone) {
    lookFar(graph_.site(next), graph_.site(faces.next(next)), faces.next(faces.next(beyond_next)),
            faces.prev(beyond_next), faces.degree(beyond_next));
  }
  if (beyond_prev != kNone) {
    lookFar(graph_.site(prev), graph_.site(prev2), faces.prev(beyond_prev), faces.next(faces.next(beyond_prev)),
            faces.degree(beyond_prev));
  }
}

}  // namespace tutte::values
