#include "codec/edges.h"

#include <algorithm>
#include <utility>

namespace tutte {
namespace {

// An edge in the bucket of its smaller vertex.
struct HalfEdge {
  Index far;  // the larger vertex, twice, plus 1 when the edge runs from the larger to the smaller
  Index corner;
};

// Edges between the same two vertices: `up` run one way, `down` the other, both in corner order.
struct Run {
  std::span<const HalfEdge> up, down;
};

void pairUp(Index a, Index b, EdgePairs& pairs) {
  pairs.twin[a] = b;
  pairs.twin[b] = a;
}

// Do the faces of two opposite edges look like both sides of one face?
bool areBackToBack(const FaceCorners& faces, Index a, Index b) {
  const auto beyond = [&](Index corner) { return faces.vertex[faces.next(faces.next(corner))]; };
  const auto before = [&](Index corner) { return faces.vertex[faces.prev(corner)]; };
  return beyond(a) == before(b) && before(a) == beyond(b);
}

// Several sheets meet at an edge. Faces of one sheet are mostly stored close together, and a face is hardly ever glued
// to its own back: such pairs come last.
void pairSheets(const FaceCorners& faces, const Run& run, EdgePairs& pairs) {
  struct Choice {
    bool back_to_back;
    Index distance, up, down;
    auto operator<=>(const Choice&) const = default;
  };
  std::vector<Choice> choices;
  for (const HalfEdge& up : run.up) {
    for (const HalfEdge& down : run.down) {
      const Index a = up.corner, b = down.corner;
      choices.push_back({areBackToBack(faces, a, b), std::max(a, b) - std::min(a, b), a, b});
    }
  }
  std::sort(choices.begin(), choices.end());
  for (const Choice& choice : choices) {
    if (pairs.twin[choice.up] == kNone && pairs.twin[choice.down] == kNone) pairUp(choice.up, choice.down, pairs);
  }
}

constexpr size_t kMostChoices = 256;

void pairRun(const FaceCorners& faces, const Run& run, bool allow_conflicts, EdgePairs& pairs) {
  const size_t both = std::min(run.up.size(), run.down.size()), choices = run.up.size() * run.down.size();
  if (choices > 1 && choices <= kMostChoices) {
    pairSheets(faces, run, pairs);
  } else {
    for (size_t i = 0; i < both; ++i) pairUp(run.up[i].corner, run.down[i].corner, pairs);
  }
  const std::span<const HalfEdge> alone = run.up.empty() ? run.down : run.up;
  if (!allow_conflicts || both != 0 || alone.size() != 2) return;
  pairUp(alone[0].corner, alone[1].corner, pairs);
  pairs.conflicts = true;
}

void pairBucket(const FaceCorners& faces, HalfEdge* begin, HalfEdge* end, bool allow_conflicts, EdgePairs& pairs) {
  const auto before = [](const HalfEdge& a, const HalfEdge& b) {
    return a.far != b.far ? a.far < b.far : a.corner < b.corner;
  };
  if (end - begin <= 24) {
    for (HalfEdge* i = begin; i < end; ++i) {
      HalfEdge moving = *i, *at = i;
      for (; at > begin && before(moving, at[-1]); --at) *at = at[-1];
      *at = moving;
    }
  } else {
    std::sort(begin, end, before);
  }
  while (begin != end) {
    HalfEdge *middle = begin, *last = begin;
    while (last != end && last->far >> 1 == begin->far >> 1) middle += (last++->far & 1) == 0;
    if (last - begin > 1) pairRun(faces, {{begin, middle}, {middle, last}}, allow_conflicts, pairs);
    begin = last;
  }
}

// Calls visit(corner, from, to) for every edge of the faces that are not isolated.
template <class Visit>
void forEachEdge(const FaceCorners& faces, std::span<const uint8_t> isolated, Visit&& visit) {
  for (Index f = 0; f < faces.faceCount(); ++f) {
    if (!isolated.empty() && isolated[f]) continue;
    const Index end = faces.first[f + 1];
    Index previous = end - 1;
    for (Index c = faces.first[f]; c < end; previous = c++) visit(previous, faces.vertex[previous], faces.vertex[c]);
  }
}

// Where each vertex's bucket begins, of the edges whose smaller vertex it is.
std::vector<Index> bucketStarts(const FaceCorners& faces, std::span<const uint8_t> isolated, Index vertex_count) {
  std::vector<Index> starts(vertex_count + 1, 0);
  forEachEdge(faces, isolated, [&](Index, Index from, Index to) { ++starts[std::min(from, to)]; });
  Index sum = 0;
  for (Index& start : starts) sum += std::exchange(start, sum);
  return starts;
}

// Pairs edges as they come: a bucket holds the first side of each. False: some edge has not one side up and one down,
// which is not for here to judge. Otherwise this is what sorting would give.
bool pairAsTheyCome(const FaceCorners& faces, std::span<const uint8_t> isolated, std::vector<Index> ends,
                    const std::vector<Index>& starts, std::vector<HalfEdge>& edges, EdgePairs& pairs) {
  bool clear = true;
  forEachEdge(faces, isolated, [&](Index corner, Index from, Index to) {
    const bool down = from > to;
    const Index near = down ? to : from, far = (down ? from : to) << 1 | static_cast<Index>(down);
    HalfEdge* const begin = &edges[starts[near]];
    HalfEdge* const end = &edges[ends[near]];
    HalfEdge* other = begin;
    while (other != end && other->far >> 1 != far >> 1) ++other;
    if (other == end) {
      *end = {far, corner};
      ++ends[near];
      return;
    }
    if (other->far == far || other->corner == kNone) {
      clear = false;
    } else {
      pairUp(corner, std::exchange(other->corner, kNone), pairs);
    }
  });
  return clear;
}

}  // namespace

void FaceCorners::listFaces() {
  triangles = false;
  face.resize(vertex.size());
  for (Index f = 0; f < faceCount(); ++f) std::fill(face.begin() + first[f], face.begin() + first[f + 1], f);
}

EdgePairs pairEdges(const FaceCorners& faces, Index vertex_count, std::span<const uint8_t> isolated,
                    bool allow_conflicts) {
  EdgePairs pairs;
  pairs.twin.assign(faces.vertex.size(), kNone);
  const std::vector<Index> starts = bucketStarts(faces, isolated, vertex_count);
  std::vector<HalfEdge> edges(starts[vertex_count] + 1);
  if (pairAsTheyCome(faces, isolated, starts, starts, edges, pairs)) return pairs;
  std::fill(pairs.twin.begin(), pairs.twin.end(), kNone);
  std::vector<Index> ends = starts;
  forEachEdge(faces, isolated, [&](Index corner, Index from, Index to) {
    const bool down = from > to;
    edges[ends[down ? to : from]++] = {(down ? from : to) << 1 | static_cast<Index>(down), corner};
  });
  for (Index v = 0; v < vertex_count; ++v) {
    pairBucket(faces, edges.data() + starts[v], edges.data() + ends[v], allow_conflicts, pairs);
  }
  return pairs;
}

}  // namespace tutte
