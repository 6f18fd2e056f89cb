#include "codec/value_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "codec/triangulation.h"

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

ValueGraph::ValueGraph(const Connectivity& mesh, Index site_count)
    : site_count_(site_count), sites_(mesh.umbrellas), twins_(mesh.twins), copies_(mesh.copies) {
  listShapes(mesh.face_degrees) ? findFirsts() : listFans();
}

ValueGraph::ValueGraph(const Connectivity& mesh, std::vector<Index> sites, Index site_count)
    : site_count_(site_count),
      own_sites_(std::move(sites)),
      sites_(own_sites_),
      twins_(mesh.twins),
      copies_(mesh.copies) {
  const bool all_round = listShapes(mesh.face_degrees), umbrellas = std::ranges::equal(sites_, mesh.umbrellas);
  if (umbrellas) {
    sites_ = mesh.umbrellas;
    own_sites_ = {};
  } else {
    dropSeamTwins();
  }
  umbrellas&& all_round ? findFirsts() : listFans();
}

// False when there are faces round which there is no way.
bool ValueGraph::listShapes(std::span<const Index> face_degrees) {
  constexpr Index kMostStep = 2047;
  if (onlyTriangles(face_degrees)) return true;
  const auto shapeOf = [](Index back, Index forth, Index degree) {
    return back << 20 | (forth & 0xFFF) << 8 | std::min(degree, AnyFaces::kMostDegree);
  };
  shapes_.resize(sites_.size());
  uint32_t* shape = shapes_.data();
  bool all_round = true;
  for (const Index degree : face_degrees) {
    if (degree == 0) continue;
    all_round &= degree - 1 <= kMostStep;
    const Index wrap = degree - 1 <= kMostStep ? degree - 1 : 0, step = degree > 1;
    *shape++ = shapeOf(wrap, step, degree);
    for (Index i = 2; i < degree; ++i) *shape++ = shapeOf(~0u, 1, degree);
    if (degree > 1) *shape++ = shapeOf(~0u, 0u - wrap, degree);
  }
  return all_round;
}

void ValueGraph::dropSeamTwins() {
  for (Index c = 0; c < cornerCount(); ++c) {
    const Index twin = twins_[c];
    if (twin == kNone || (site(twin) == site(next(c)) && site(next(twin)) == site(c))) continue;
    if (own_twins_.empty()) {
      own_twins_.assign(twins_.begin(), twins_.end());
      twins_ = own_twins_;
    }
    own_twins_[c] = kNone;
  }
}

// An umbrella is one fan.
void ValueGraph::findFirsts() {
  starts_.assign(site_count_, kNone);
  Index open = 0;  // without decisions, so that compilers make vectors of it
  for (const Index twin : twins_) open |= twin == kNone;
  const auto find = [&](auto counts) {
    for (Index c = cornerCount(); c-- > 0;) {
      if (counts(c)) starts_[sites_[c]] = c;
    }
    for (Index c = 0; open != 0 && c < cornerCount(); ++c) {
      if (twins_[c] == kNone && counts(c)) starts_[sites_[c]] = c;
    }
  };
  if (shapes_.empty()) return find([](Index) { return true; });
  find([faces = any()](Index corner) { return faces.degree(corner) >= 3; });
}

// Fan by fan. Of inconsistent twins, too, nothing is listed twice.
void ValueGraph::listFans() {
  const auto counts = [&](Index corner) { return shapes_.empty() || degree(corner) >= 3; };
  starts_.assign(size_t{site_count_} + 1, 0);
  for (Index c = 0; c < cornerCount(); ++c) starts_[sites_[c]] += counts(c);
  Index sum = 0;
  for (Index& start : starts_) sum += std::exchange(start, sum);
  fans_.resize(std::max(sum, 1u));
  std::vector<Index> ends(starts_.begin(), starts_.end());
  std::vector<bool> listed(cornerCount());
  const auto list = [&](Index first) {
    const Index site = sites_[first];
    for (Index corner = first; corner != kNone && !listed[corner] && sites_[corner] == site && counts(corner);
         corner = twins_[prev(corner)]) {
      listed[corner] = true;
      fans_[ends[site]++] = corner;
    }
    fans_[ends[site] - 1] |= kLast;
  };
  for (Index c = 0; c < cornerCount(); ++c) {
    if (twins_[c] == kNone && counts(c) && !listed[c]) list(c);
  }
  for (Index c = 0; c < cornerCount(); ++c) {
    if (counts(c) && !listed[c]) list(c);
  }
}

ValueGraph::CornerList ValueGraph::corners(Index site) const {
  CornerList list;
  withFaces([&](const auto& faces) {
    goRound(
        faces, site, [&](Index corner, Index) { list.corners[list.count++] = corner; }, [](Index, Index) {});
  });
  return list;
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
