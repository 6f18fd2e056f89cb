#include "codec/value_graph.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "codec/sorting.h"
#include "codec/umbrella_ways.h"

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

ValueGraph::ValueGraph(const Connectivity& mesh, std::span<const Index> sites, const KnownMesh& known)
    : own_ways_(known.ways ? nullptr : std::make_unique<const MeshWays>(mesh)),
      ways_(known.ways ? known.ways : own_ways_.get()),
      sites_(sites),
      twins_(mesh.twins),
      copies_(mesh.copies),
      shapes_(ways_->faces.shapes()) {}

ValueGraph::ValueGraph(const Connectivity& mesh, Index site_count, const KnownMesh& known)
    : ValueGraph(mesh, mesh.umbrellas, known) {
  const Index counted = cutLargeFaces(mesh.face_degrees);
  const std::vector<Index>& firsts = ways_->firsts;
  if (own_twins_.empty() && counted == cornerCount() && site_count == firsts.size()) {
    starts_ = firsts;
    return;
  }
  own_starts_.assign(site_count, kNone);
  starts_ = own_starts_;
  if (!own_twins_.empty()) {
    listFans(mesh, counted);
    return;
  }
  for (size_t umbrella = 0; umbrella < firsts.size(); ++umbrella) {
    if (firsts[umbrella] < counted) own_starts_[umbrella] = firsts[umbrella];
  }
}

ValueGraph::ValueGraph(const Connectivity& mesh, std::span<const Index> sites, Index site_count, const KnownMesh& known)
    : ValueGraph(mesh, sites, known) {
  own_starts_.assign(site_count, kNone);
  starts_ = own_starts_;
  const Index counted = cutLargeFaces(mesh.face_degrees);
  // Going round many umbrellas takes longer than looking at all corners.
  if (known.ways && own_twins_.empty() && known.parted.size() <= mesh.umbrella_count / 4) {
    listFansOf(mesh, counted, cutSeamsOf(mesh, known.parted));
    return;
  }
  withFaces([&](const auto& faces) { cutSeams(faces); });
  listFans(mesh, counted);
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

// Returns how many corners count: faces of degree below 3, whose corners do not, come last.
Index ValueGraph::cutLargeFaces(std::span<const Index> face_degrees) {
  Index first = 0;
  for (size_t f = 0; ways_->faces.hasLarge() && f < face_degrees.size(); ++f) {
    if (face_degrees[f] > kMostWays) cut(first), cut(first + face_degrees[f] - 1);
    first += face_degrees[f];
  }
  Index counted = cornerCount();
  for (size_t f = face_degrees.size(); f > 0 && face_degrees[f - 1] < 3; --f) counted -= face_degrees[f - 1];
  return counted;
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

// The same, where only these umbrellas have different sites. Returns 1 for the umbrellas at both ends of what was cut.
std::vector<uint8_t> ValueGraph::cutSeamsOf(const Connectivity& mesh, std::span<const Index> umbrellas) {
  const UmbrellaWays ways(mesh, *ways_);
  std::vector<uint8_t> opened(mesh.umbrella_count);
  for (const Index umbrella : umbrellas) {
    ways.goRound(umbrella, [&](Index c) {
      const Index twin = ways.twin(c);
      if (twin == kNone) return;
      if (sites_[twin] == sites_[ways.next(c)] && sites_[ways.next(twin)] == sites_[c]) return;
      cut(c);
      opened[umbrella] = opened[ways.umbrella(twin)] = 1;
    });
  }
  return opened;
}

inline void ValueGraph::addFan(Index first) {
  Index& fans = own_starts_[sites_[first]];
  if (fans == kNone) {
    fans = first;
    return;
  }
  fans_.push_back({first, fans});
  fans = kSeveral + static_cast<Index>(fans_.size() - 1);
}

// All fans of sites that have several.
void ValueGraph::addFans(const Connectivity& mesh, std::vector<Index>& firsts) {
  for (size_t i = 0, count = firsts.size(); i < count; ++i) {
    Index& fan = own_starts_[sites_[firsts[i]]];
    if (fan != kNone) firsts.push_back(std::exchange(fan, kNone));
  }
  // As in listFans(): closed ones from the last umbrella on, then open ones from the last corner on.
  std::vector<uint64_t> order;
  for (const Index first : firsts) {
    const bool open = twins_[first] == kNone;
    order.push_back(uint64_t{open} << 63 | pairOf(kNone / 2 - (open ? first : mesh.umbrellas[first]), first));
  }
  sortNumbers(order);
  for (const uint64_t fan : order) addFan(secondOf(fan));
}

// The same as listFans(), where only these umbrellas have edges that were cut.
void ValueGraph::listFansOf(const Connectivity& mesh, Index counted, std::span<const uint8_t> opened) {
  const UmbrellaWays ways(mesh, *ways_);
  std::vector<Index> others;  // of sites that have a fan
  const auto add = [&](Index first) {
    Index& fan = own_starts_[sites_[first]];
    fan == kNone ? void(fan = first) : others.push_back(first);
  };
  const auto addOpened = [&](Index umbrella) {
    bool open = false;
    ways.goRound(umbrella, [&](Index corner) {
      if (twins_[corner] != kNone) return;
      open = true;
      add(corner);
    });
    if (!open) add(ways.first(umbrella));
  };
  for (Index umbrella = 0; umbrella < mesh.umbrella_count; ++umbrella) {
    if (opened[umbrella] != 0) {
      addOpened(umbrella);
    } else if (ways.first(umbrella) < counted) {
      add(ways.first(umbrella));
    }
  }
  if (!others.empty()) addFans(mesh, others);
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
                      std::span<const uint8_t> seams, const KnownMesh& known) {
  std::optional<Partition> partition;
  const auto join = [&](Index corner, Index a, Index b) {
    if (a == b || (!seams.empty() && seams[corner] != 0)) return;
    if (!partition) partition.emplace(wedge_count);
    partition->join(a, b);
  };
  if (known.ways) {
    const UmbrellaWays ways(mesh, *known.ways);
    for (const Index umbrella : known.parted) {
      ways.goRound(umbrella, [&](Index c) {
        const Index across = ways.across(c);
        if (across != kNone) join(c, wedges[c], wedges[across]);
      });
    }
  } else {
    Index begin = 0;
    for (const Index degree : mesh.face_degrees) {
      const Index end = begin + degree;
      for (Index c = begin; c < end; ++c) {
        if (mesh.twins[c] != kNone) join(c, wedges[c + 1 == end ? begin : c + 1], wedges[mesh.twins[c]]);
      }
      begin = end;
    }
  }
  return partition ? std::move(*partition).number() : WedgeSites{{}, wedge_count};
}

WedgeSites joinVertices(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count,
                        const KnownMesh& known) {
  WedgeSites sites{std::vector<Index>(wedge_count, kNone), 0};
  std::vector<Index>& of_wedge = sites.site_of;  // at first the vertex; kNone where no corner uses the wedge
  if (known.ways) {
    const UmbrellaWays ways(mesh, *known.ways);
    for (const Index first : known.ways->firsts) of_wedge[wedges[first]] = mesh.vertexOf(first);
    for (const Index umbrella : known.parted) {
      ways.goRound(umbrella, [&](Index c) { of_wedge[wedges[c]] = mesh.vertexOf(c); });
    }
  } else {
    for (Index c = 0; c < wedges.size(); ++c) of_wedge[wedges[c]] = mesh.vertexOf(c);
  }
  std::vector<Index> site_of_vertex(mesh.vertex_count, kNone);
  for (Index& vertex : of_wedge) {
    Index isolated = kNone;
    Index& site = vertex == kNone ? isolated : site_of_vertex[vertex];
    if (site == kNone) site = sites.count++;
    vertex = site;
  }
  return sites;
}

}  // namespace tutte
