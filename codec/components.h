#pragma once
// The order and the seeds of the walk, one per connected component; and which components repeat an earlier one.

#include <vector>

#include "codec/mesh.h"
#include "codec/topology.h"

namespace tutte {

/// How the walk enters a component.
struct ComponentPlan {
  Index seed = 0;          ///< the corner where its first face begins
  Index original = kNone;  ///< the earlier component, in order of the plans, whose symbols it repeats; kNone: none
};

/// Which repetitions are looked for.
enum class Repeats {
  kNone,
  kCopies,    ///< isomorphic components
  kMirrored,  ///< also mirror images: they become copies by turning all their faces round in the topology
};

/// Components by their first face. O(n), but for components that look alike and are not: they are tried a bounded
/// number of times.
std::vector<ComponentPlan> planComponents(Topology& topology, Repeats repeats);

/// Per face: the number of its component, in order of the plans.
std::vector<Index> componentsOfFaces(const Topology& topology, const std::vector<ComponentPlan>& plans);

/// Moves the seed of a component that is no copy, and those of its copies likewise. O(size of the component and its
/// copies), plus O(all corners) where it has any.
void moveSeed(const Topology& topology, std::vector<ComponentPlan>& plans, Index component, Index seed);

}  // namespace tutte
