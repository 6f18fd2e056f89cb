#include "codec/value_graph.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace tutte {
namespace {

void addFaces(const Connectivity& mesh, ValueGraph& graph) {
  graph.faces.resize(mesh.umbrellas.size());
  Index begin = 0;
  for (const Index degree : mesh.face_degrees) {
    for (Index c = begin; c < begin + degree; ++c) graph.faces[c] = {begin, begin + degree};
    begin += degree;
  }
}

void addTwins(const Connectivity& mesh, ValueGraph& graph) {
  graph.twins = mesh.twins;
  for (Index c = 0; c < graph.twins.size(); ++c) {
    const Index twin = graph.twins[c];
    if (twin == kNone) continue;
    const bool same = graph.sites[twin] == graph.sites[graph.next(c)] && graph.sites[graph.next(twin)] == graph.sites[c];
    if (!same) graph.twins[c] = kNone;
  }
}

void addCornersOfSites(ValueGraph& graph) {
  graph.first.assign(size_t{graph.site_count} + 1, 0);
  const auto count = static_cast<Index>(graph.sites.size());
  const auto forEach = [&](auto&& visit) {
    for (Index c = 0; c < count; ++c) {
      if (graph.faces[c].degree() >= 3) visit(c, graph.sites[c]);
    }
  };
  forEach([&](Index, Index site) { ++graph.first[site]; });
  Index total = 0;
  for (Index& slot : graph.first) total += std::exchange(slot, total);
  graph.corners.resize(total);
  forEach([&](Index corner, Index site) { graph.corners[graph.first[site]++] = corner; });
  // Each entry has moved to its end, which is the next one's beginning.
  std::copy_backward(graph.first.begin(), graph.first.end() - 1, graph.first.end());
  graph.first[0] = 0;
}

// Sites by urgency: a stack per level, of which the fullest level comes first.
class Queue {
 public:
  void push(Index site, int level) {
    stacks_[level].push_back(site);
    top_ = std::max(top_, level);
  }

  /// kNone when empty.
  Index pop() {
    while (top_ >= 0 && stacks_[top_].empty()) --top_;
    if (top_ < 0) return kNone;
    const Index site = stacks_[top_].back();
    stacks_[top_].pop_back();
    return site;
  }

 private:
  std::array<std::vector<Index>, 6> stacks_;
  int top_ = -1;
};

constexpr Index kDone = kNone;
constexpr Index kScannedDegree = 32;  // larger faces are not searched at every step: that would be quadratic

class Orderer {
 public:
  explicit Orderer(const ValueGraph& graph)
      : graph_(graph), score_(graph.site_count, 0), known_(graph.faces.size(), 0) {
    order_.reserve(graph.site_count);
  }

  std::vector<Index> run() && {
    for (Index seed = 0; seed < graph_.site_count; ++seed) {
      for (Index site = seed; site != kNone; site = queue_.pop()) {
        if (score_[site] != kDone) visit(site);
      }
    }
    return std::move(order_);
  }

 private:
  void visit(Index site) {
    score_[site] = kDone;
    order_.push_back(site);
    for (const Index corner : graph_.cornersOf(site)) reveal(corner);
  }

  bool isKnown(Index corner) const { return score_[graph_.sites[corner]] == kDone; }

  // One more corner of a face is known: its unknown ones become more urgent.
  void reveal(Index corner) {
    const ValueGraph::Span face = graph_.faces[corner];
    const Index known = ++known_[face.begin];
    const Index degree = face.degree();
    if (degree == 3) {
      for (Index c = face.begin; c < face.end; ++c) {
        if (!isKnown(c)) known == 2 ? add(c, 2) : raise(c, 1);
      }
    } else if (known + 1 == degree) {
      for (Index c = face.begin; c < face.end; ++c) {
        if (!isKnown(c)) add(c, 16);
      }
    } else if (degree > 4 && degree <= kScannedDegree && known >= 3) {
      for (Index c = face.begin; c < face.end; ++c) {
        const int sides = isKnown(graph_.next(c)) + isKnown(graph_.prev(c));
        if (sides != 0 && !isKnown(c)) add(c, sides == 2 ? 8 : 4);
      }
    } else {
      for (const Index c : {graph_.next(corner), graph_.prev(corner)}) {
        if (!isKnown(c)) known == 2 ? add(c, 2) : raise(c, 1);
      }
    }
  }

  void add(Index corner, Index amount) { setScore(graph_.sites[corner], score_[graph_.sites[corner]] + amount); }
  void raise(Index corner, Index least) {
    const Index site = graph_.sites[corner];
    setScore(site, std::max(score_[site], least));
  }

  static int level(Index score) {
    return score < 2 ? 0 : score < 4 ? 1 : score < 8 ? 2 : score < 16 ? 3 : score < 32 ? 4 : 5;
  }

  void setScore(Index site, Index score) {
    const Index before = score_[site];
    score_[site] = score;
    if (before == 0 || level(score) != level(before)) queue_.push(site, level(score));
  }

  const ValueGraph& graph_;
  Queue queue_;
  std::vector<Index> score_;
  std::vector<Index> known_;  // per face, at its first corner
  std::vector<Index> order_;
};

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

ValueGraph buildValueGraph(const Connectivity& mesh, std::vector<Index> sites, Index site_count) {
  ValueGraph graph;
  graph.site_count = site_count;
  graph.sites = std::move(sites);
  addFaces(mesh, graph);
  addTwins(mesh, graph);
  addCornersOfSites(graph);
  return graph;
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

std::vector<Index> valueOrder(const ValueGraph& graph) { return Orderer(graph).run(); }

}  // namespace tutte
