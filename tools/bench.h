#pragma once
// Sizes and times of one file, beside Draco's.

#include <set>
#include <string>
#include <vector>

#include "gltf_ext/pack.h"
#include "gltf_ext/scene.h"
#include "tools/bench_figures.h"

namespace tutte {

/// What is measured, and for how long.
struct BenchPlan {
  PackOptions options;
  std::set<std::string> attributes;  ///< are kept, and POSITION; empty: all
  std::vector<Profile> profiles;     ///< of which the connectivity is measured alone, too
  double seconds = 0.3;              ///< for each coder and mesh
};

/// Measures every mesh of the scene that has polygons. All coders run in turn, round after round, until their time is
/// spent or ten rounds are done, and the best time of each step counts: so all are the best of the same number of
/// runs, and what else the machine does meets all alike. Times are processor time.
Outcome<BenchFigures> measure(const std::string& file, Scene scene, const BenchPlan& plan);

}  // namespace tutte
