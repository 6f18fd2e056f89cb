#include "codec/value_surroundings.h"

#include <algorithm>
#include <bit>

#include "codec/value_tables.h"

namespace tutte::values {
namespace {

template <class Visit>
[[gnu::always_inline]] inline void forHighestFirst(uint64_t bits, Visit visit) {
  while (bits != 0) {
    const int bit = 63 ^ std::countl_zero(bits);
    bits ^= uint64_t{1} << bit;
    visit(bit);
  }
}

}  // namespace

SurroundingsFinder::SurroundingsFinder(const ValueGraph& graph, bool want_edges, bool far)
    : graph_(graph), want_edges_(want_edges), far_(far), lists_(new Lists) {}

void SurroundingsFinder::fill() {
  Lists& lists = *lists_;
  lists.neighbours.restart();
  for (auto* list : {&lists.within, &lists.across, &lists.planes}) list->restart();
  for (auto* list : {&lists.scaled, &lists.over, &lists.straight}) list->restart();
  lists.edges.restart();
  at_ = count_ = 0;
  graph_.withFaces([&](const auto& faces) {
    for (size_t corners = 0; count_ < kBatch && corners < kBatchCorners && site_ < graph_.siteCount(); ++site_) {
      corners += find(faces, batch_[count_++]);
    }
  });
}

/// Returns how many corners there are at most.
template <class Faces>
[[gnu::always_inline]] inline size_t SurroundingsFinder::find(const Faces& faces, Surroundings& found) {
  Lists& lists = *lists_;
  const size_t sides = gather(faces);
  if constexpr (!Faces::kAllTriangles) {
    const int inside = lists.scaled.size() + lists.within.size(), all = inside > 0 ? inside : lists.across.size();
    if (all <= far_) {
      lookOver(faces, sides);
      if (all == 0 || lists.over.size() == 0) lookStraight(faces, sides);
    }
    found.scaled = lists.scaled.take();
    found.within = lists.within.take();
    found.planes = lists.planes.take();
    found.over = lists.over.take();
    found.straight = lists.straight.take();
  }
  found.site = site_;
  found.neighbours = lists.neighbours.take();
  found.across = lists.across.take();
  if (want_edges_) found.edges = lists.edges.take();
  return sides;
}

// Goes round the site; returns where its sides end. A side is the site at the corner before, which is the one after in
// the next face of the fan; only the fan's first is looked up apart, when it is open.
template <class Faces>
[[gnu::always_inline]] inline size_t SurroundingsFinder::gather(const Faces& faces) {
  Sides& sides = lists_->sides;
  Index* neighbours = lists_->neighbours.end;
  const Index here = site_;
  size_t begin = 0, side = 0;
  uint64_t known = 0, large = 0;
  graph_.goRound(
      faces, here,
      [&](Index corner, Index prev) __attribute__((always_inline)) {
        const Index site = graph_.site(prev);
        const bool is_known = site < here;
        ++side;
        known = 2 * known + is_known;
        if constexpr (!Faces::kAllTriangles) large = 2 * large + (faces.degree(corner) > 4);
        sides.site[side] = site;
        sides.corner[side] = prev;
        *neighbours = site;
        neighbours += is_known;
      },
      [&](Index first, Index beyond) __attribute__((always_inline)) {
        lists_->neighbours.end = neighbours;
        beginFan(faces, first, beyond, begin, side);
        const size_t count = side - begin;
        visitFan(faces, {side, count, known | uint64_t{sides.site[begin] < here} << count, large});
        begin = ++side;
        known = large = 0;
        neighbours = lists_->neighbours.end;
      });
  return side;
}

// The fan's first side, and how its ends count as neighbours.
template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::beginFan(const Faces& faces, Index first, Index beyond,
                                                                size_t begin, size_t last) {
  Sides& sides = lists_->sides;
  sides.corner[begin] = kNone;
  if (beyond == first) {
    sides.site[begin] = sides.site[last];
    return;
  }
  auto& neighbours = lists_->neighbours;
  if (beyond != kNone) neighbours.end -= known(sides.site[last]);
  sides.site[begin] = graph_.site(faces.next(first));
  neighbours.add(sides.site[begin], known(sides.site[begin]));
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::visitFan(const Faces& faces, const Fan& fan) {
  if (want_edges_) forHighestFirst(fan.all(), [&](int bit) { addEdges(faces, fan.side(bit)); });
  const uint64_t both = fan.known & fan.known >> 1;
  if constexpr (Faces::kAllTriangles) {
    forHighestFirst(both, [&](int bit) { addAcross(faces, fan.side(bit)); });
  } else {
    forHighestFirst(both & ~fan.large, [&](int bit) {
      const size_t side = fan.side(bit);
      faces.degree(lists_->sides.corner[side]) == 3 ? addAcross(faces, side) : addWithin(faces, side);
    });
    forHighestFirst((fan.known | fan.known >> 1) & fan.large, [&](int bit) { visitLarge(faces, fan.side(bit)); });
  }
}

// Across the edge between two sides: the corners of the face beyond it at both of them, which are one in a triangle.
template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::addAcross(const Faces& faces, size_t side) {
  const Sides& sides = lists_->sides;
  const Index twin = graph_.twin(faces.prev(sides.corner[side]));
  if (twin == kNone) return;
  const Index x = graph_.site(faces.prev(twin));
  Index y = x;
  if constexpr (!Faces::kAllTriangles) {
    if (faces.degree(twin) != 3) y = graph_.site(faces.next(faces.next(twin)));
  }
  lists_->across.add({sides.site[side - 1], sides.site[side], x, y}, known(x) & known(y));
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::addWithin(const Faces& faces, size_t side) {
  const Sides& sides = lists_->sides;
  const Index far = graph_.site(faces.prev(sides.corner[side]));
  lists_->within.add({sides.site[side - 1], sides.site[side], far, far}, known(far));
}

// A regular polygon's diagonal over three sides is parallel to the middle one.
template <class Faces>
void SurroundingsFinder::visitLarge(const Faces& faces, size_t side) {
  const Index prev = lists_->sides.corner[side], prev2 = faces.prev(prev);
  const Index next2 = faces.next(faces.next(faces.next(prev)));
  const Index a = lists_->sides.site[side - 1], b = lists_->sides.site[side];
  const Index c = graph_.site(next2), d = graph_.site(prev2);
  const PolygonRatio ratio = kPolygonRatio[std::min(faces.degree(prev), kLargestPolygon)];
  const auto k = static_cast<Index>(ratio.k), inverse = static_cast<Index>(ratio.inverse);
  auto& scaled = lists_->scaled;
  if (known(a) && known(b)) {
    scaled.add({b, a, d, inverse}, known(d));
    scaled.add({a, b, c, inverse}, known(c));
    lists_->planes.add({b, a, c, 0}, known(c));
  } else if (known(b) && known(d)) {
    const Index e = graph_.site(faces.prev(prev2));
    scaled.add({e, b, d, k}, known(e));
  } else if (known(a) && known(c)) {
    const Index e = graph_.site(faces.next(next2));
    scaled.add({e, a, c, k}, known(e));
  }
}

template <class Faces>
void SurroundingsFinder::addEdges(const Faces& faces, size_t side) {
  const Index prev = lists_->sides.corner[side], a = lists_->sides.site[side - 1], b = lists_->sides.site[side];
  addEdge(a, b);
  if (faces.degree(prev) == 3) return;
  addEdge(a, graph_.site(faces.next(faces.next(faces.next(prev)))));
  addEdge(graph_.site(faces.prev(prev)), b);
}

// Over the edges that are opposite or beside, from a neighbour a to c; x lies beyond c. Weaker than what is within.
template <class Faces>
void SurroundingsFinder::lookOver(const Faces& faces, size_t end) {
  const ValueGraph& graph = graph_;
  const Index here = site_;
  const Sides& sides = lists_->sides;
  Term* const most = lists_->over.begin + kMostFar;
  Term* over = lists_->over.end;
  const auto add = [&](Index a, Index c, Index beyond) __attribute__((always_inline)) {
    const Index x = graph.site(beyond);
    over->a = a, over->b = c, over->x = x;
    over->y = faces.degree(beyond) == 3;
    over += (x < here) & (over < most);
  };
  for (size_t side = 1; side < end; ++side) {
    const Index prev = sides.corner[side];
    if (prev == kNone || faces.degree(prev) <= 3) continue;
    const Index a = sides.site[side - 1], b = sides.site[side];
    if (a < here) {
      const Index edge = faces.next(faces.next(prev)), c = graph.site(faces.next(edge)), beyond = graph.twin(edge);
      if (c < here && beyond != kNone) add(a, c, faces.prev(beyond));
    }
    if (b < here) {
      const Index edge = faces.prev(prev), c = graph.site(edge), beyond = graph.twin(edge);
      if (c < here && beyond != kNone) add(b, c, faces.next(faces.next(beyond)));
    }
  }
  lists_->over.end = over;
}

// On from what lies beyond a neighbour, over that neighbour.
template <class Faces>
void SurroundingsFinder::lookStraight(const Faces& faces, size_t end) {
  const Sides& sides = lists_->sides;
  for (size_t side = 0; side < end; ++side) {
    const Index prev = sides.corner[side];
    if (prev == kNone || faces.degree(prev) <= 3) continue;
    const Index beyond_a = graph_.twin(faces.next(faces.next(prev))), beyond_b = graph_.twin(faces.prev(prev));
    const Index a = sides.site[side - 1], b = sides.site[side];
    if (known(a) && beyond_a != kNone) addStraight(faces, a, faces.next(faces.next(beyond_a)));
    if (known(b) && beyond_b != kNone) addStraight(faces, b, faces.prev(beyond_b));
  }
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::addStraight(const Faces& faces, Index a, Index beyond) {
  const Index y = graph_.site(beyond);
  auto& straight = lists_->straight;
  straight.add({a, a, y, 0}, known(y) & (faces.degree(beyond) > 3) & (straight.size() < kMostFar));
}

}  // namespace tutte::values
