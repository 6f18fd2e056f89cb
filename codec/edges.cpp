#include "codec/edges.h"

#include <algorithm>

namespace tutte {
namespace {

// An edge in the bucket of its smaller vertex.
struct HalfEdge {
  Index far;  // the larger vertex, twice, plus 1 when the edge runs from the larger to the smaller
  Index corner;
};

// Edges between the same two vertices, opposite directions apart: [begin, middle) run up, [middle, end) run down.
void pairRun(const HalfEdge* begin, const HalfEdge* end, bool allow_conflicts, EdgePairs& pairs) {
  const HalfEdge* middle = begin;
  while (middle != end && (middle->far & 1) == 0) ++middle;
  const HalfEdge *up = begin, *down = middle;
  for (; up != middle && down != end; ++up, ++down) {
    pairs.twin[up->corner] = down->corner;
    pairs.twin[down->corner] = up->corner;
  }
  if (allow_conflicts && end - begin == 2 && (middle == begin || middle == end)) {
    pairs.twin[begin[0].corner] = begin[1].corner;
    pairs.twin[begin[1].corner] = begin[0].corner;
    pairs.conflicts = true;
  }
}

void pairBucket(HalfEdge* begin, HalfEdge* end, bool allow_conflicts, EdgePairs& pairs) {
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
    HalfEdge* run = begin;
    while (run != end && run->far >> 1 == begin->far >> 1) ++run;
    if (run - begin > 1) pairRun(begin, run, allow_conflicts, pairs);
    begin = run;
  }
}

}  // namespace

EdgePairs pairEdges(const FaceCorners& faces, Index vertex_count, std::span<const uint8_t> isolated,
                    bool allow_conflicts) {
  const Index corners = static_cast<Index>(faces.vertex.size());
  std::vector<Index> bucket_end(vertex_count + 1, 0);
  const auto forEachEdge = [&](auto&& visit) {
    for (Index f = 0; f < faces.faceCount(); ++f) {
      if (!isolated.empty() && isolated[f]) continue;
      const Index end = faces.first[f + 1];
      Index previous = end - 1;
      for (Index c = faces.first[f]; c < end; previous = c++) visit(previous, faces.vertex[previous], faces.vertex[c]);
    }
  };
  forEachEdge([&](Index, Index from, Index to) { ++bucket_end[std::min(from, to) + 1]; });
  for (Index v = 0; v < vertex_count; ++v) bucket_end[v + 1] += bucket_end[v];
  std::vector<HalfEdge> edges(bucket_end[vertex_count]);
  // After this, bucket_end[v] is the end of bucket v.
  forEachEdge([&](Index corner, Index from, Index to) {
    const bool down = from > to;
    edges[bucket_end[down ? to : from]++] = {(down ? from : to) << 1 | static_cast<Index>(down), corner};
  });
  EdgePairs pairs;
  pairs.twin.assign(corners, kNone);
  Index begin = 0;
  for (Index v = 0; v < vertex_count; ++v) {
    pairBucket(edges.data() + begin, edges.data() + bucket_end[v], allow_conflicts, pairs);
    begin = bucket_end[v];
  }
  return pairs;
}

}  // namespace tutte
