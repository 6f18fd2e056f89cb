#include "codec/value_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tutte {
namespace {

/// Disjoint sets of wedges, each named by its smallest member.
class Partition {
 public:
  explicit Partition(Index count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  Index find(Index member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  WedgeSites number() && {
    WedgeSites sites{std::vector<Index>(parent_.size()), 0};
    for (Index w = 0; w < parent_.size(); ++w) {
      const Index smallest = find(w);
      sites.site_of[w] = smallest == w ? sites.count++ : sites.site_of[smallest];
    }
    return sites;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace

void ValueGraph::addCorners(const Connectivity& mesh) {
  corners_.resize(mesh.umbrellas.size());
  Index begin = 0;
  for (const Index degree : mesh.face_degrees) {
    const Index end = begin + degree;
    for (Index c = begin; c < end; ++c) corners_[c] = {0, mesh.twins[c], begin, end};
    begin = end;
  }
}

void ValueGraph::dropSeamTwins() {
  for (Index c = 0; c < corners_.size(); ++c) {
    Corner& corner = corners_[c];
    if (corner.twin == kNone) continue;
    if (site(corner.twin) != site(next(c)) || site(next(corner.twin)) != corner.site) corner.twin = kNone;
  }
}

void ValueGraph::addCornersOfSites() {
  first_.assign(size_t{site_count_} + 1, 0);
  const auto forEach = [&](auto&& visit) {
    for (Index c = 0; c < corners_.size(); ++c) {
      if (corners_[c].end - corners_[c].begin >= 3) visit(c, corners_[c].site);
    }
  };
  forEach([&](Index, Index site) { ++first_[site]; });
  Index total = 0;
  for (Index& slot : first_) total += std::exchange(slot, total);
  around_.resize(total);
  forEach([&](Index corner, Index site) { around_[first_[site]++] = corner; });
  // Each entry has moved to its end, which is the next one's beginning.
  std::copy_backward(first_.begin(), first_.end() - 1, first_.end());
  first_[0] = 0;
}

WedgeSites joinWedges(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count,
                      std::span<const uint8_t> seams) {
  Partition partition(wedge_count);
  Index begin = 0;
  for (const Index degree : mesh.face_degrees) {
    for (Index c = begin; c < begin + degree; ++c) {
      const Index twin = mesh.twins[c];
      if (twin == kNone || (!seams.empty() && seams[c] != 0)) continue;
      partition.join(wedges[c + 1 == begin + degree ? begin : c + 1], wedges[twin]);
    }
    begin += degree;
  }
  return std::move(partition).number();
}

WedgeSites joinVertices(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count) {
  Partition partition(wedge_count);
  std::vector<Index> wedge_of(mesh.vertex_count, kNone);
  for (Index c = 0; c < wedges.size(); ++c) {
    Index& wedge = wedge_of[mesh.vertexOf(c)];
    if (wedge == kNone) wedge = wedges[c];
    if (wedge != wedges[c]) partition.join(wedge, wedges[c]);
  }
  return std::move(partition).number();
}

namespace {

constexpr Index kScannedDegree = 32;  // larger faces are not searched at every step: that would be quadratic

int levelOf(Index score) { return score < 2 ? 0 : score < 4 ? 1 : score < 8 ? 2 : score < 16 ? 3 : score < 32 ? 4 : 5; }

}  // namespace

SiteOrder::SiteOrder(const ValueGraph& graph)
    : graph_(graph), score_(graph.siteCount(), 0), known_(graph.cornerCount(), 0) {}

Index SiteOrder::next() {
  Index site = pop();
  if (site == kNone) {
    while (score_[seed_] == kKnown) ++seed_;
    site = seed_;
  }
  score_[site] = kKnown;
  for (const Index corner : graph_.cornersOf(site)) reveal(corner);
  return site;
}

Index SiteOrder::pop() {
  while (top_ >= 0) {
    std::vector<Index>& stack = stacks_[top_];
    if (stack.empty()) {
      --top_;
      continue;
    }
    const Index site = stack.back();
    stack.pop_back();
    if (score_[site] != kKnown) return site;
  }
  return kNone;
}

// One more corner of a face is known: its unknown ones become more urgent.
void SiteOrder::reveal(Index corner) {
  const Index known = ++known_[graph_.faceBegin(corner)];
  const Index degree = graph_.degree(corner);
  if (degree > 4 && known >= 3) return revealPolygon(corner, known, degree);
  if (degree == 4 && known == 3) {
    for (Index c = graph_.faceBegin(corner); c < graph_.faceEnd(corner); ++c) {
      if (!isKnown(c)) add(c, 16);
    }
    return;
  }
  for (const Index c : {graph_.next(corner), graph_.prev(corner)}) {
    if (!isKnown(c)) known == 2 ? add(c, 2) : raise(c, 1);
  }
}

void SiteOrder::revealPolygon(Index corner, Index known, Index degree) {
  const Index begin = graph_.faceBegin(corner), end = graph_.faceEnd(corner);
  if (known + 1 == degree) {
    for (Index c = begin; c < end; ++c) {
      if (!isKnown(c)) add(c, 16);
    }
  } else if (degree <= kScannedDegree) {
    for (Index c = begin; c < end; ++c) {
      const int sides = isKnown(graph_.next(c)) + isKnown(graph_.prev(c));
      if (sides != 0 && !isKnown(c)) add(c, sides == 2 ? 8 : 4);
    }
  } else {
    for (const Index c : {graph_.next(corner), graph_.prev(corner)}) {
      if (!isKnown(c)) raise(c, 4);
    }
  }
}

void SiteOrder::add(Index corner, Index amount) {
  const Index site = graph_.site(corner);
  setScore(site, score_[site] + amount);
}

void SiteOrder::raise(Index corner, Index least) {
  const Index site = graph_.site(corner);
  setScore(site, std::max(score_[site], least));
}

void SiteOrder::setScore(Index site, Index score) {
  const Index before = score_[site];
  score_[site] = score;
  const int level = levelOf(score);
  if (before != 0 && level == levelOf(before)) return;
  stacks_[level].push_back(site);
  top_ = std::max(top_, level);
}

}  // namespace tutte
