#pragma once
// Which of several equal components comes first.

#include <span>
#include <vector>

#include "codec/components.h"
#include "codec/mesh.h"
#include "codec/topology.h"

namespace tutte {

/// The parts of a walked topology in coded order.
struct WalkOrder {
  std::vector<Index> start_corners;  ///< per coded face: the topology's corner where it begins
  std::vector<Index> umbrellas;      ///< per coded umbrella: the topology's
};

/// A component and its copies have the same symbols, so they may change places. Sorts them by the first vertices that
/// they share with what comes before, so that the join list runs on from one to the next. `coded` is what the walk
/// made. O(n log n).
void orderCopies(const Topology& topology, std::span<const ComponentPlan> plans, const Connectivity& coded,
                 WalkOrder& order);

}  // namespace tutte
