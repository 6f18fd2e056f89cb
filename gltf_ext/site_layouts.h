#pragma once
// Where the values of attributes sit on a mesh.

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "codec/value_graph.h"
#include "gltf_ext/attributes.h"

namespace tutte {

/// The sites of one attribute.
struct SiteLayout {
  WedgeSites wedges;
  std::vector<Index> sites;  ///< per corner; empty: the graph knows them from elsewhere
  std::optional<ValueGraph> graph;
};

/// How many wedges have sites.
inline size_t wedgeCount(const WedgeSites& wedges) {
  return wedges.site_of.empty() ? wedges.count : wedges.site_of.size();
}

inline Index siteOf(const WedgeSites& wedges, size_t wedge) {
  return wedges.site_of.empty() ? static_cast<Index>(wedge) : wedges.site_of[wedge];
}

/// The layouts of one mesh, made when they are first asked for; attributes with equal seams share one. Refers to the
/// topology, which must be consistent.
class SiteLayouts {
 public:
  explicit SiteLayouts(const AttributeTopology& topology)
      : topology_(topology), known_{topology.ways, topology.parted_umbrellas}, whole_(whole()) {
    if (topology.trusted && !known_.ways) known_.ways = &own_ways_.emplace(topology.connectivity);
  }
  SiteLayouts(const SiteLayouts&) = delete;

  SiteLayout& get(size_t attribute) {
    const bool positions = attribute == 0;
    const std::span<const uint8_t> seams = attribute < topology_.seams.size() ? topology_.seams[attribute] : none_;
    for (const Entry& entry : entries_) {
      const bool same = whole_ || (entry.positions == positions && std::ranges::equal(entry.seams, seams));
      if (same) return *entry.layout;
    }
    entries_.push_back({positions, seams, make(positions, seams)});
    return *entries_.back().layout;
  }

 private:
  struct Entry {
    bool positions;
    std::span<const uint8_t> seams;
    std::unique_ptr<SiteLayout> layout;
  };

  // Every vertex has one wedge: all attributes have the same sites.
  bool whole() const { return topology_.wedge_count == topology_.connectivity.vertex_count; }

  bool areUmbrellas(std::span<const Index> sites) const {
    const std::vector<Index>& umbrellas = topology_.connectivity.umbrellas;
    return sites.data() == umbrellas.data() || std::ranges::equal(sites, umbrellas);
  }

  WedgeSites joined(bool positions, std::span<const uint8_t> seams) const {
    const Connectivity& mesh = topology_.connectivity;
    const std::span<const Index> wedges = topology_.wedges;
    const Index count = topology_.wedge_count;
    if (whole_) return {{}, count};
    return positions ? joinVertices(mesh, wedges, count, known_) : joinWedges(mesh, wedges, count, seams, known_);
  }

  std::unique_ptr<SiteLayout> make(bool positions, std::span<const uint8_t> seams) const {
    const Connectivity& mesh = topology_.connectivity;
    const std::span<const Index> wedges = topology_.wedges;
    auto layout = std::make_unique<SiteLayout>();
    layout->wedges = joined(positions, seams);
    std::span<const Index> sites = wedges;
    if (positions && topology_.trusted && mesh.vertices.empty()) {
      sites = mesh.umbrellas;
    } else if (!layout->wedges.site_of.empty()) {
      layout->sites.reserve(wedges.size());
      for (const Index wedge : wedges) layout->sites.push_back(layout->wedges.site_of[wedge]);
      sites = layout->sites;
    }
    if (areUmbrellas(sites)) {
      layout->graph.emplace(mesh, layout->wedges.count, known_);
      layout->sites = std::vector<Index>();
    } else {
      layout->graph.emplace(mesh, sites, layout->wedges.count, known_);
    }
    return layout;
  }

  const AttributeTopology& topology_;
  std::optional<MeshWays> own_ways_;  ///< empty: the topology's, or nobody's
  KnownMesh known_;                   ///< without ways where nothing is known
  const bool whole_;
  const std::span<const uint8_t> none_;
  std::vector<Entry> entries_;
};

/// True when the topology does not contradict itself; trusted ones are not looked at.
bool isConsistent(const AttributeTopology& topology);

}  // namespace tutte
