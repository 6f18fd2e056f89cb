#include "codec/value_graph.h"

#include <algorithm>
#include <numeric>
#include <optional>

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

ValueGraph::ValueGraph(const Connectivity& mesh, std::span<const Index> sites, Index site_count, bool parted)
    : sites_(sites), twins_(mesh.twins), copies_(mesh.copies), starts_(site_count, kNone) {
  Index counted = cornerCount();
  if (!onlyTriangles(mesh.face_degrees)) {
    shapes_ = faceShapes(mesh.face_degrees, sites_.size());
    cutLargeFaces(mesh.face_degrees);
    // Faces of degree below 3 come last.
    for (size_t f = mesh.face_degrees.size(); f > 0 && mesh.face_degrees[f - 1] < 3; --f)
      counted -= mesh.face_degrees[f - 1];
  }
  if (parted) withFaces([&](const auto& faces) { cutSeams(faces); });
  const bool umbrellas = sites_.data() == mesh.umbrellas.data() && own_twins_.empty();
  umbrellas ? findFirstCorners(twins_.first(counted), sites_.first(counted), starts_) : listFans(mesh, counted);
}

// Makes a boundary of an edge.
void ValueGraph::cut(Index corner) {
  if (own_twins_.empty()) {
    own_twins_.assign(twins_.begin(), twins_.end());
    twins_ = own_twins_;
  }
  if (twins_[corner] != kNone) own_twins_[twins_[corner]] = kNone;
  own_twins_[corner] = kNone;
}

void ValueGraph::cutLargeFaces(std::span<const Index> face_degrees) {
  Index first = 0;
  for (const Index degree : face_degrees) {
    if (degree > kMostWays) cut(first), cut(first + degree - 1);
    first += degree;
  }
}

// At edges whose sides have different sites.
template <class Faces>
void ValueGraph::cutSeams(const Faces& faces) {
  const Index* const sites = sites_.data();
  const Index* twins = twins_.data();
  for (Index c = 0, count = cornerCount(); c < count; ++c) {
    const Index twin = twins[c];
    if (twin == kNone || twin < c) continue;
    if (sites[twin] == sites[faces.next(c)] && sites[faces.next(twin)] == sites[c]) continue;
    cut(c);
    twins = twins_.data();
  }
}

inline void ValueGraph::addFan(Index first) {
  Index& fans = starts_[sites_[first]];
  if (fans == kNone) {
    fans = first;
    return;
  }
  fans_.push_back({first, fans});
  fans = kSeveral + static_cast<Index>(fans_.size() - 1);
}

// The last one first, so that each is put before those of its site that are known.
void ValueGraph::listFans(const Connectivity& mesh, Index counted) {
  const Index* const umbrellas = mesh.umbrellas.data();
  std::vector<Index> closed(mesh.umbrella_count, kNone);
  bool open = false;
  for (Index c = counted; c-- > 0;) closed[umbrellas[c]] = c;
  for (Index c = 0; c < counted; ++c) {
    if (twins_[c] != kNone) continue;
    closed[umbrellas[c]] = kNone;
    open = true;
  }
  for (size_t umbrella = closed.size(); umbrella-- > 0;) {
    if (closed[umbrella] != kNone) addFan(closed[umbrella]);
  }
  for (Index c = counted; open && c-- > 0;) {
    if (twins_[c] == kNone) addFan(c);
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
  std::optional<Partition> partition;
  const Index* const twins = mesh.twins.data();
  Index begin = 0;
  for (const Index degree : mesh.face_degrees) {
    const Index end = begin + degree;
    for (Index c = begin; c < end; ++c) {
      if (twins[c] == kNone) continue;
      const Index behind = wedges[c + 1 == end ? begin : c + 1], beyond = wedges[twins[c]];
      if (behind == beyond || (!seams.empty() && seams[c] != 0)) continue;
      if (!partition) partition.emplace(wedge_count);
      partition->join(behind, beyond);
    }
    begin = end;
  }
  return partition ? std::move(*partition).number() : WedgeSites{{}, wedge_count};
}

WedgeSites joinVertices(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count) {
  WedgeSites sites{std::vector<Index>(wedge_count, kNone), 0};
  for (Index c = 0; c < wedges.size(); ++c) sites.site_of[wedges[c]] = mesh.vertexOf(c);
  std::vector<Index> site_of_vertex(mesh.vertex_count, kNone);
  for (Index& vertex : sites.site_of) {
    Index isolated = kNone;
    Index& site = vertex == kNone ? isolated : site_of_vertex[vertex];
    if (site == kNone) site = sites.count++;
    vertex = site;
  }
  return sites;
}

}  // namespace tutte
