#include "codec/value_surroundings.h"

#include <algorithm>
#include <bit>

#include "codec/value_tables.h"

namespace tutte::values {
namespace {

template <class Visit>
[[gnu::always_inline]] inline void forLowestFirst(uint64_t bits, Visit visit) {
  for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

template <class Visit>
[[gnu::always_inline]] inline void forHighestFirst(uint64_t bits, Visit visit) {
  while (bits != 0) {
    const int bit = 63 ^ std::countl_zero(bits);
    bits ^= uint64_t{1} << bit;
    visit(bit);
  }
}

Index has(uint64_t bits, int bit) { return static_cast<Index>(bits >> bit & 1); }

}  // namespace

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
  [[maybe_unused]] const size_t end = gather(faces, site);
  if constexpr (!Faces::kAllTriangles) {
    const int inside = lists.scaled.size() + lists.within.size();
    if (inside == 1 || (inside == 0 && lists.across.size() < 2)) lookFar(faces, end);
  }
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

// Goes round the site; returns where its sides end. A side is the site at the corner before, which is the one after in
// the next face of the fan; only the fan's first is looked up apart, when it is open.
template <class Faces>
[[gnu::always_inline]] inline size_t SurroundingsFinder::gather(const Faces& faces, Index site) {
  Sides& sides = lists_->sides;
  Index* neighbours = lists_->neighbours.end;
  size_t begin = 0, side = 0;
  uint64_t unknown = 0, far_unknown = 0, triangles = 0, quads = 0;
  graph_.goRound(
      faces, site,
      [&](Index corner, Index prev) __attribute__((always_inline)) {
        const Index beside = graph_.site(prev), rank = order_.rank(beside), is_unknown = rank >> 31;
        ++side;
        unknown = 2 * unknown + is_unknown;
        if constexpr (!Faces::kAllTriangles) {
          const Index degree = faces.degree(corner), far = faces.prev(prev), far_rank = order_.rank(graph_.site(far));
          far_unknown = 2 * far_unknown + (far_rank >> 31);
          triangles = 2 * triangles + (degree == 3);
          quads = 2 * quads + (degree == 4);
          sides.far[side] = far;
          sides.far_rank[side] = far_rank;
        }
        sides.site[side] = beside;
        sides.rank[side] = rank;
        sides.corner[side] = prev;
        *neighbours = rank;
        neighbours += is_unknown ^ 1;
      },
      [&](Index first, Index beyond) __attribute__((always_inline)) {
        lists_->neighbours.end = neighbours;
        beginFan(faces, first, beyond, begin, side);
        Fan fan{side, static_cast<int>(side - begin), beyond == first};
        fan.known = (~unknown & fan.all()) | uint64_t{SiteOrder::isRank(sides.rank[begin])} << fan.faces;
        fan.far_known = ~far_unknown;
        fan.triangles = Faces::kAllTriangles ? fan.all() : triangles;
        fan.quads = quads;
        visitFan(faces, fan);
        begin = ++side;
        unknown = far_unknown = triangles = quads = 0;
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
    sides.rank[begin] = sides.rank[last];
    return;
  }
  auto& neighbours = lists_->neighbours;
  if (beyond != kNone) neighbours.end -= SiteOrder::isRank(sides.rank[last]);
  const Index site = graph_.site(faces.next(first)), rank = order_.rank(site);
  sides.site[begin] = site;
  sides.rank[begin] = rank;
  neighbours.add(rank, SiteOrder::isRank(rank));
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::visitFan(const Faces& faces, const Fan& fan) {
  const Sides& sides = lists_->sides;
  const uint64_t both = fan.known & fan.known >> 1;
  if (want_edges_) forHighestFirst(fan.all(), [&](int bit) { addEdges(faces, fan.side(bit)); });
  forHighestFirst(both & fan.triangles, [&](int bit) { addAcross(faces, fan.side(bit)); });
  if constexpr (Faces::kAllTriangles) return urgeSides(fan);
  forHighestFirst(both & fan.quads & fan.far_known, [&](int bit) {
    const size_t b = fan.side(bit);
    lists_->within.add({sides.rank[b - 1], sides.rank[b], sides.far_rank[b], sides.far_rank[b]}, true);
  });
  uint64_t far_first = 0;
  forHighestFirst(fan.all() & ~(fan.triangles | fan.quads),
                  [&](int bit) { far_first |= uint64_t{visitPolygon(faces, fan.side(bit))} << bit; });
  urgeSides(fan, far_first);
}

// Across the edge between two sides: the corners of the face beyond it at both of them, which are one in a triangle.
template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::addAcross(const Faces& faces, size_t side) {
  const Sides& sides = lists_->sides;
  const Index twin = graph_.twin(Faces::kAllTriangles ? faces.prev(sides.corner[side]) : sides.far[side]);
  if (twin == kNone) return;
  const Index x = order_.rank(graph_.site(faces.prev(twin)));
  Index y = x;
  if constexpr (!Faces::kAllTriangles) {
    if (faces.degree(twin) != 3) y = order_.rank(graph_.site(faces.next(faces.next(twin))));
  }
  lists_->across.add({sides.rank[side - 1], sides.rank[side], x, y}, SiteOrder::isRank(x | y));
}

// A regular polygon's diagonal over three sides is parallel to the middle one. Returns whether the corner behind the
// first side's is known.
template <class Faces>
bool SurroundingsFinder::visitPolygon(const Faces& faces, size_t side) {
  const Sides& sides = lists_->sides;
  const Index corner = sides.corner[side], next2 = faces.next(faces.next(faces.next(corner)));
  const Index a = sides.rank[side - 1], b = sides.rank[side];
  const Index c = order_.rank(graph_.site(next2)), d = sides.far_rank[side];
  const bool know_a = SiteOrder::isRank(a), know_b = SiteOrder::isRank(b);
  const bool know_c = SiteOrder::isRank(c), know_d = SiteOrder::isRank(d);
  const PolygonRatio ratio = kPolygonRatio[std::min(faces.degree(corner), kLargestPolygon)];
  const auto k = static_cast<Index>(ratio.k), inverse = static_cast<Index>(ratio.inverse);
  auto& scaled = lists_->scaled;
  if (know_a && know_b) {
    scaled.add({b, a, d, inverse}, know_d);
    scaled.add({a, b, c, inverse}, know_c);
    lists_->planes.add({b, a, c, 0}, know_c);
  } else if (know_b && know_d) {
    const Index e = order_.rank(graph_.site(faces.prev(sides.far[side])));
    scaled.add({e, b, d, k}, SiteOrder::isRank(e));
  } else if (know_a && know_c) {
    const Index e = order_.rank(graph_.site(faces.next(next2)));
    scaled.add({e, a, c, k}, SiteOrder::isRank(e));
  }
  return know_c;
}

// Of each triangle, a side that is known makes the other more urgent.
[[gnu::always_inline]] inline void SurroundingsFinder::urgeSides(const Fan& fan) {
  const uint64_t before = fan.known << 1, after = fan.wrapped(fan.known >> 1);
  forLowestFirst(fan.unknown(), [&](int bit) {
    order_.urge(lists_->sides.site[fan.side(bit)], 2 * (has(before, bit) + has(after, bit)));
  });
}

// Sets of faces, by what they add to the urgency of their first and of their second side.
[[gnu::always_inline]] inline void SurroundingsFinder::urgeSides(const Fan& fan, uint64_t far_first) {
  const Sides& sides = lists_->sides;
  const uint64_t a = fan.known >> 1, b = fan.known, far = fan.far_known;
  const uint64_t polygons = fan.all() & ~(fan.triangles | fan.quads);
  const uint64_t three = a & b & far, two = fan.quads & ((a & b) | ((a | b) & far)) & ~three;
  const uint64_t one = fan.quads & (a ^ b ^ far) & ~three;
  const uint64_t first_two = ((fan.triangles & b) | one | (polygons & b & ~far_first)) << 1;
  const uint64_t second_two = fan.wrapped((fan.triangles & a) | one | (polygons & a & ~far));
  const uint64_t first_many = two << 1, second_many = fan.wrapped(two);
  const uint64_t first_eight = (polygons & far_first) << 1, second_eight = fan.wrapped(polygons & far);
  forHighestFirst(two & ~far, [&](int bit) { order_.urge(graph_.site(sides.far[fan.side(bit)]), 16); });
  forLowestFirst(fan.unknown(), [&](int bit) {
    Index amount = 2 * (has(first_two, bit) + has(second_two, bit));
    amount += 16 * (has(first_many, bit) + has(second_many, bit));
    if (polygons != 0) amount += 8 * (has(first_eight, bit) + has(second_eight, bit));
    order_.urge(sides.site[fan.side(bit)], amount);
  });
}

template <class Faces>
void SurroundingsFinder::addEdges(const Faces& faces, size_t side) {
  const Sides& sides = lists_->sides;
  const Index a = sides.site[side - 1], rank_a = sides.rank[side - 1], b = sides.site[side], rank_b = sides.rank[side];
  addEdge(a, rank_a, b, rank_b);
  if constexpr (!Faces::kAllTriangles) {
    const Index corner = sides.corner[side];
    if (faces.degree(corner) == 3) return;
    const Index c = graph_.site(faces.next(faces.next(faces.next(corner))));
    addEdge(a, rank_a, c, order_.rank(c));
    addEdge(graph_.site(sides.far[side]), sides.far_rank[side], b, rank_b);
  }
}

// Over the edges that are opposite or beside; weaker than what is within.
template <class Faces>
void SurroundingsFinder::lookFar(const Faces& faces, size_t end) {
  const Sides& sides = lists_->sides;
  for (size_t side = 0; side < end; ++side) {
    const Index corner = sides.corner[side];
    if (corner == kNone || faces.degree(corner) <= 3) continue;
    const Index first = faces.next(faces.next(corner)), a = sides.rank[side - 1], beyond_a = graph_.twin(first);
    if (SiteOrder::isRank(a) && beyond_a != kNone) {
      lookFar(a, order_.rank(graph_.site(faces.next(first))), faces.next(faces.next(beyond_a)), faces.prev(beyond_a),
              faces.degree(beyond_a));
    }
    const Index b = sides.rank[side], beyond_b = graph_.twin(sides.far[side]);
    if (SiteOrder::isRank(b) && beyond_b != kNone) {
      lookFar(b, sides.far_rank[side], faces.prev(beyond_b), faces.next(faces.next(beyond_b)), faces.degree(beyond_b));
    }
  }
}

// The face beyond the edge from a (the neighbour) to c: y lies beyond a, x beyond c.
[[gnu::always_inline]] inline void SurroundingsFinder::lookFar(Index a, Index c, Index beyond_a, Index beyond_c,
                                                               Index degree) {
  const Index x = order_.rank(graph_.site(beyond_c)), y = order_.rank(graph_.site(beyond_a));
  const bool over = SiteOrder::isRank(c | x), straight = SiteOrder::isRank(y) & (degree > 3);
  lists_->over.add({a, c, x, degree == 3}, over & (lists_->over.size() < kMostFar));
  lists_->straight.add({a, a, y, 0}, straight & (lists_->straight.size() < kMostFar));
}

}  // namespace tutte::values
