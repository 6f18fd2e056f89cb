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
  WedgeSites wedges;  ///< no entries: every wedge is a site
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
  explicit SiteLayouts(const AttributeTopology& topology) : topology_(topology), whole_(whole()) {}

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

  // Every vertex has one umbrella and one wedge: all attributes have the same sites.
  bool whole() const {
    const Connectivity& mesh = topology_.connectivity;
    return mesh.vertices.empty() && topology_.wedge_count == mesh.vertex_count &&
           (topology_.wedges.data() == mesh.umbrellas.data() || std::ranges::equal(topology_.wedges, mesh.umbrellas));
  }

  std::unique_ptr<SiteLayout> make(bool positions, std::span<const uint8_t> seams) const {
    const Connectivity& mesh = topology_.connectivity;
    auto layout = std::make_unique<SiteLayout>();
    layout->wedges = whole_      ? WedgeSites{{}, topology_.wedge_count}
                     : positions ? joinVertices(mesh, topology_.wedges, topology_.wedge_count)
                                 : joinWedges(mesh, topology_.wedges, topology_.wedge_count, seams);
    if (whole_) {
      layout->graph.emplace(mesh, layout->wedges.count);
      return layout;
    }
    std::vector<Index> sites;
    sites.reserve(mesh.umbrellas.size());
    for (const Index wedge : topology_.wedges) sites.push_back(layout->wedges.site_of[wedge]);
    layout->graph.emplace(mesh, std::move(sites), layout->wedges.count);
    return layout;
  }

  const AttributeTopology& topology_;
  const bool whole_;
  const std::span<const uint8_t> none_;
  std::vector<Entry> entries_;
};

/// True when the topology does not contradict itself; trusted ones are not looked at.
bool isConsistent(const AttributeTopology& topology);

}  // namespace tutte
