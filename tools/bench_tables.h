#pragma once
// The figures of `tutte bench` as text.

#include <vector>

#include "tools/bench_figures.h"

namespace tutte {

/// The heading of the size table, and one line of it.
void printSizeHead();
void printSizes(const BenchFigures& figures);

/// All other tables: sums, bytes by attribute, profiles, speeds.
void printSummary(const std::vector<BenchFigures>& rows);

}  // namespace tutte
