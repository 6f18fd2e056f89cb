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
void SurroundingsFinder::find(const Faces& faces, Index site, Surroundings& found) {
  Lists& lists = *lists_;
  urgencies_.clear();
  const std::span<const Index> corners = graph_.corners(site);
  for (const Index corner : corners) visit(faces, corner);
  if constexpr (!Faces::kAllTriangles) {
    const int inside = lists.scaled.size() + lists.within.size();
    if (inside == 1 || (inside == 0 && lists.across.size() < 2)) {
      for (const Index corner : corners) lookFar(faces, corner);
    }
  }
  order_.urge(urgencies_.entries());
  order_.learn(site);
  found = {site,
           lists.neighbours.take(),
           lists.scaled.take(),
           lists.within.take(),
           lists.across.take(),
           lists.planes.take(),
           lists.over.take(),
           lists.straight.take(),
           lists.edges.take()};
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::visit(const Faces& faces, Index corner) {
  const Index next = faces.next(corner), prev = faces.prev(corner);
  const Index a = graph_.site(next), b = graph_.site(prev), rank_a = order_.rank(a), rank_b = order_.rank(b);
  const bool know_a = SiteOrder::isRank(rank_a), know_b = SiteOrder::isRank(rank_b);
  lists_->neighbours.add(rank_a, know_a);
  lists_->neighbours.add(rank_b, know_b & (graph_.twin(prev) == kNone));
  if (want_edges_) addEdge(a, b);
  const Index degree = faces.degree(corner);
  if (degree == 3) {
    visitTriangle(faces, next, rank_a, rank_b);
    return urgencies_.addTriangle(a, know_a, b, know_b);
  }
  if constexpr (!Faces::kAllTriangles) {
    if (want_edges_) addEdges(faces, corner);
    if (degree != 4) return visitPolygon(faces, corner);
    const Index c = graph_.site(faces.next(next)), rank_c = order_.rank(c);
    const bool know_c = SiteOrder::isRank(rank_c);
    lists_->within.add({rank_a, rank_b, rank_c, rank_c}, know_a & know_b & know_c);
    urgencies_.addQuad(a, know_a, b, know_b, c, know_c);
  }
}

// The corners of the face beyond the edge from a to b, at both sides; in a triangle, these are one.
template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::visitTriangle(const Faces& faces, Index next, Index rank_a,
                                                                     Index rank_b) {
  const Index twin = graph_.twin(next), edge = twin == kNone ? 0 : twin;
  const Index x = order_.rank(graph_.site(faces.prev(edge)));
  Index y = x;
  if constexpr (!Faces::kAllTriangles) {
    if (faces.degree(edge) != 3) y = order_.rank(graph_.site(faces.next(faces.next(edge))));
  }
  const bool known = SiteOrder::isRank(rank_a | rank_b | x | y);
  lists_->across.add({rank_a, rank_b, x, y}, known & (twin != kNone));
}

// A regular polygon's diagonal over three sides is parallel to the middle one.
void SurroundingsFinder::visitPolygon(const AnyFaces& faces, Index corner) {
  const Index next = faces.next(corner), prev = faces.prev(corner);
  const Index next2 = faces.next(next), prev2 = faces.prev(prev), degree = faces.degree(corner);
  const Index a = graph_.site(next), b = graph_.site(prev);
  const Index rank_a = order_.rank(a), rank_b = order_.rank(b);
  const Index rank_c = order_.rank(graph_.site(next2)), rank_d = order_.rank(graph_.site(prev2));
  const bool know_a = SiteOrder::isRank(rank_a), know_b = SiteOrder::isRank(rank_b);
  const bool know_c = SiteOrder::isRank(rank_c), know_d = SiteOrder::isRank(rank_d);
  urgencies_.addPolygon(a, know_a, b, know_b, know_c, know_d);
  const PolygonRatio ratio = kPolygonRatio[std::min(degree, kLargestPolygon)];
  const auto k = static_cast<Index>(ratio.k), inverse = static_cast<Index>(ratio.inverse);
  auto& scaled = lists_->scaled;
  if (know_a && know_b) {
    scaled.add({rank_b, rank_a, rank_d, inverse}, know_d);
    scaled.add({rank_a, rank_b, rank_c, inverse}, know_c);
    lists_->planes.add({rank_b, rank_a, rank_c, 0}, know_c);
  } else if (know_b && know_d) {
    const Index e = order_.rank(graph_.site(faces.prev(prev2)));
    scaled.add({e, rank_b, rank_d, k}, SiteOrder::isRank(e));
  } else if (know_a && know_c) {
    const Index e = order_.rank(graph_.site(faces.next(next2)));
    scaled.add({e, rank_a, rank_c, k}, SiteOrder::isRank(e));
  }
}

void SurroundingsFinder::addEdges(const AnyFaces& faces, Index corner) {
  const Index next = faces.next(corner), prev = faces.prev(corner);
  addEdge(graph_.site(next), graph_.site(faces.next(next)));
  addEdge(graph_.site(faces.prev(prev)), graph_.site(prev));
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

// The face beyond the edge from a (the neighbour) to c: y lies beyond a, x beyond c.
void SurroundingsFinder::lookFar(Index a, Index c, Index beyond_a, Index beyond_c, Index degree) {
  const Index rank_a = order_.rank(a), rank_c = order_.rank(c);
  const Index x = order_.rank(graph_.site(beyond_c)), y = order_.rank(graph_.site(beyond_a));
  const bool over = SiteOrder::isRank(rank_a | rank_c | x), straight = SiteOrder::isRank(rank_a | y) && degree > 3;
  lists_->over.add({rank_a, rank_c, x, degree == 3}, over && lists_->over.size() < kMostFar);
  lists_->straight.add({rank_a, rank_a, y, 0}, straight && lists_->straight.size() < kMostFar);
}

}  // namespace tutte::values
