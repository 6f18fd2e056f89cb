// Where values sit on a mesh.

#include "codec/value_graph.h"

#include <gtest/gtest.h>

#include <vector>

#include "codec/encode.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

/// Wedges with equal values on both sides of an edge that is no seam are one site.
TEST(ValueGraph, WedgesJoinAcrossEdgesWithoutSeam) {
  const Result<Encoded> encoded = encode(shapes::cube().mesh);
  ASSERT_TRUE(encoded);
  const Connectivity& mesh = encoded->connectivity;
  std::vector<Index> wedges(mesh.umbrellas.size());
  for (Index c = 0; c < wedges.size(); ++c) wedges[c] = c;
  EXPECT_EQ(joinWedges(mesh, wedges, 24, {}).count, 8u);
  const std::vector<uint8_t> all(wedges.size(), 1);
  EXPECT_EQ(joinWedges(mesh, wedges, 24, all).count, 24u);
}

}  // namespace
}  // namespace tutte
