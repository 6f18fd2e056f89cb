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

ValueGraph::ValueGraph(const Connectivity& mesh, std::span<const Index> sites, Index site_count)
    : corner_count_(static_cast<Index>(sites.size())), corners_(new Corner[sites.size()]), first_(site_count, kNone) {
  addCorners(mesh, sites);
  if (sites.data() != mesh.umbrellas.data()) dropSeamTwins();
  linkCorners();
}

void ValueGraph::addCorners(const Connectivity& mesh, std::span<const Index> sites) {
  const auto shapeOf = [](Index back, Index forth, Index degree) {
    return back << 20 | (forth & 0xFFF) << 8 | std::min(degree, kMostDegree);
  };
  Corner* corner = corners_.get();
  const Index *site = sites.data(), *twin = mesh.twins.data();
  for (const Index degree : mesh.face_degrees) {
    if (degree == 0) continue;
    const Index wrap = degree - 1 <= kMostStep ? degree - 1 : 0, step = degree > 1;
    *corner++ = {*site++, *twin++, shapeOf(wrap, step, degree), kNone};
    for (Index i = 2; i < degree; ++i) *corner++ = {*site++, *twin++, shapeOf(~0u, 1, degree), kNone};
    if (degree > 1) *corner++ = {*site++, *twin++, shapeOf(~0u, 0u - wrap, degree), kNone};
  }
}

void ValueGraph::dropSeamTwins() {
  for (Index c = 0; c < cornerCount(); ++c) {
    Index& twin = corners_[c].twin;
    if (twin != kNone && (site(twin) != site(next(c)) || site(next(twin)) != site(c))) twin = kNone;
  }
}

void ValueGraph::linkCorners() {
  Corner* const corners = corners_.get();
  Index* const first = first_.data();
  for (Index c = cornerCount(); c-- > 0;) {
    if ((corners[c].shape & kMostDegree) >= 3) corners[c].following = std::exchange(first[corners[c].site], c);
  }
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

}  // namespace tutte
