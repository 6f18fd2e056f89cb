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

SurroundingsFinder::SurroundingsFinder(const ValueGraph& graph, const Wanted& wanted)
    : graph_(graph), wanted_(wanted), lists_(new Lists) {}

void SurroundingsFinder::fill() {
  Lists& lists = *lists_;
  ends_ = {lists.neighbours.data(), lists.scaled.data(), lists.within.data(),   lists.across.data(),
           lists.planes.data(),     lists.over.data(),   lists.straight.data(), lists.edges.data()};
  at_ = count_ = 0;
  begins_[0] = ends_;
  graph_.withFaces([&](const auto& faces) {
    for (size_t corners = 0; count_ < kBatch && corners < kBatchCorners && site_ < graph_.siteCount(); ++site_) {
      corners += find(faces);
      begins_[++count_] = ends_;
    }
  });
}

/// Returns how many corners there are at most.
template <class Faces>
[[gnu::always_inline]] inline size_t SurroundingsFinder::find(const Faces& faces) {
  size_t fans = 0;
  const size_t sides = gather(faces, fans);
  if (Faces::kAllTriangles || !wanted_.predictions) return sides;
  if constexpr (!Faces::kAllTriangles) {
    const Surroundings::Begins& begins = begins_[count_];
    const auto inside = (ends_.scaled - begins.scaled) + (ends_.within - begins.within);
    const auto all = inside > 0 ? inside : ends_.across - begins.across;
    if (all <= wanted_.far) {
      const std::span<const Fan> found(lists_->fans.data(), fans);
      lookOver(faces, found);
      if (all == 0 || ends_.over == begins.over) lookStraight(faces, found);
    }
  }
  return sides;
}

// Goes round the site; returns where its sides end. A side is the site at the corner before, which is the one after in
// the next face of the fan; only the fan's first is looked up apart, when it is open.
template <class Faces>
[[gnu::always_inline]] inline size_t SurroundingsFinder::gather(const Faces& faces, size_t& fans) {
  Sides& sides = lists_->sides;
  Index* neighbours = ends_.neighbours;
  const Index here = site_;
  size_t begin = 0, side = 0;
  uint64_t known = 0;
  Index others = 0;  // 0: there are but quads
  graph_.goRound(
      faces, here,
      [&](Index corner, Index prev) __attribute__((always_inline)) {
        const Index site = graph_.site(prev);
        const bool is_known = site < here;
        ++side;
        known = 2 * known + is_known;
        if constexpr (!Faces::kAllTriangles) others |= faces.degree(corner) ^ 4;
        sides.site[side] = site;
        sides.corner[side] = prev;
        *neighbours = site;
        neighbours += is_known;
      },
      [&](Index first, Index beyond) __attribute__((always_inline)) {
        ends_.neighbours = neighbours;
        beginFan(faces, first, beyond, begin, side);
        const size_t count = side - begin;
        const Fan fan{side, count, known | uint64_t{sides.site[begin] < here} << count};
        if (wanted_.predictions) visitFan(faces, fan, others == 0);
        if constexpr (!Faces::kAllTriangles) lists_->fans[fans++] = fan;
        begin = ++side;
        known = others = 0;
        neighbours = ends_.neighbours;
      });
  return side;
}

// The fan's first side, and how its ends count as neighbours.
template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::beginFan(const Faces& faces, Index first, Index beyond,
                                                                size_t begin, size_t last) {
  Sides& sides = lists_->sides;
  if (beyond == first) {
    sides.site[begin] = sides.site[last];
    return;
  }
  if (beyond != kNone) ends_.neighbours -= known(sides.site[last]);
  sides.site[begin] = graph_.site(faces.next(first));
  add(ends_.neighbours, sides.site[begin], known(sides.site[begin]));
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::visitFan(const Faces& faces, const Fan& fan, bool quads) {
  if (wanted_.edges) {
    Edge* const most = begins_[count_].edges + kMostEdges;
    forHighestFirst(fan.either(), [&](int bit) {
      if (ends_.edges < most) addEdges(faces, fan.side(bit));
    });
    ends_.edges = std::min(ends_.edges, most);
  }
  if constexpr (Faces::kAllTriangles) {
    forHighestFirst(fan.both(), [&](int bit) { addAcross(faces, fan.side(bit)); });
  } else if (quads) {
    forHighestFirst(fan.both(), [&](int bit) { addWithin(faces, fan.side(bit)); });
  } else {
    forHighestFirst(fan.either(), [&](int bit) {
      const size_t side = fan.side(bit);
      const Index degree = faces.degree(lists_->sides.corner[side]);
      if (degree > 4) return visitLarge(faces, side);
      if ((fan.both() >> bit & 1) != 0) degree == 4 ? addWithin(faces, side) : addAcross(faces, side);
    });
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
  add(ends_.across, {sides.site[side - 1], sides.site[side], x, y}, known(x) & known(y));
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::addWithin(const Faces& faces, size_t side) {
  const Sides& sides = lists_->sides;
  const Index far = graph_.site(faces.prev(sides.corner[side]));
  Term* const within = ends_.within;
  within->a = sides.site[side - 1], within->b = sides.site[side], within->x = far;
  ends_.within += known(far);
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
  if (known(a) && known(b)) {
    add(ends_.scaled, {b, a, d, inverse}, known(d));
    add(ends_.scaled, {a, b, c, inverse}, known(c));
    add(ends_.planes, {b, a, c, 0}, known(c));
  } else if (known(b) && known(d)) {
    const Index e = graph_.site(faces.prev(prev2));
    add(ends_.scaled, {e, b, d, k}, known(e));
  } else if (known(a) && known(c)) {
    const Index e = graph_.site(faces.next(next2));
    add(ends_.scaled, {e, a, c, k}, known(e));
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
[[gnu::always_inline]] inline void SurroundingsFinder::lookOver(const Faces& faces, std::span<const Fan> fans) {
  const ValueGraph& graph = graph_;
  const Index here = site_;
  const Sides& sides = lists_->sides;
  Term* over = ends_.over;
  const auto add = [&](Index a, Index c, Index beyond) __attribute__((always_inline)) {
    const Index x = graph.site(beyond);
    over->a = a, over->b = c, over->x = x;
    over += (x < here) & (faces.degree(beyond) > 3);
  };
  for (const Fan& fan : fans) {
    forHighestFirst(
        wanted_.beside ? fan.one() : fan.either(), [&](int bit) __attribute__((always_inline)) {
          const size_t side = fan.side(bit);
          const Index prev = sides.corner[side], degree = faces.degree(prev);
          if (degree <= 3) return;
          const Index a = sides.site[side - 1], b = sides.site[side];
          const Index far = faces.prev(prev), d = graph.site(far);
          if (a < here) {
            const Index edge = degree == 4 ? faces.prev(far) : faces.next(faces.next(prev));
            const Index c = degree == 4 ? d : graph.site(faces.next(edge));
            if (c < here) {
              const Index beyond = graph.twin(edge);
              if (beyond != kNone) add(a, c, faces.prev(beyond));
            }
          }
          if (b < here && d < here) {
            const Index beyond = graph.twin(far);
            if (beyond != kNone) add(b, d, faces.next(faces.next(beyond)));
          }
        });
  }
  ends_.over = std::min(over, ends_.over + kMostFar);
}

// On from what lies beyond a neighbour, over that neighbour.
template <class Faces>
void SurroundingsFinder::lookStraight(const Faces& faces, std::span<const Fan> fans) {
  const Sides& sides = lists_->sides;
  Term* const most = ends_.straight + kMostFar;
  for (const Fan& fan : fans) {
    forHighestFirst(fan.either(), [&](int bit) {
      const size_t side = fan.side(bit);
      const Index prev = sides.corner[side];
      if (faces.degree(prev) <= 3) return;
      const Index beyond_a = graph_.twin(faces.next(faces.next(prev))), beyond_b = graph_.twin(faces.prev(prev));
      const Index a = sides.site[side - 1], b = sides.site[side];
      if (known(a) && beyond_a != kNone) addStraight(faces, a, faces.next(faces.next(beyond_a)));
      if (known(b) && beyond_b != kNone) addStraight(faces, b, faces.prev(beyond_b));
    });
  }
  ends_.straight = std::min(ends_.straight, most);
}

template <class Faces>
[[gnu::always_inline]] inline void SurroundingsFinder::addStraight(const Faces& faces, Index a, Index beyond) {
  const Index y = graph_.site(beyond);
  add(ends_.straight, {a, a, y, 0}, known(y) & (faces.degree(beyond) > 3));
}

}  // namespace tutte::values
