// Sheets that meet at edges and vertices: how they are taken apart, and what it costs to tell that they belong
// together.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "codec/encode.h"
#include "codec/spending.h"
#include "codec/topology.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using shapes::Shape;

std::vector<uint8_t> encoded(const Shape& shape) {
  const Result<Encoded> result = encode(shape.mesh, {.profile = Profile::kDefault, .effort = 0});
  EXPECT_TRUE(result);
  return result ? result->bytes : std::vector<uint8_t>();
}

/// Bits of the join list against a list that tells the vertex of each umbrella that is not a vertex's first.
double partOfPlainList(const Shape& shape) {
  const Result<Topology> topology = buildTopology(shape.mesh);
  const Result<Spending> spending = spendingOf(encoded(shape));
  if (!topology || !spending) return 2;
  const double joined = static_cast<double>(topology->valence.size()) - shape.mesh.vertex_count;
  return (*spending)[Topic::kJoins].bits / (joined * std::log2(shape.mesh.vertex_count));
}

TEST(Joins, BothSidesOfASheetAreSheets) {
  for (const Shape& shape : {shapes::triangleTorus(20, 15), shapes::quadTorus(12, 9), shapes::sponge(1)}) {
    const Result<Topology> topology = buildTopology(shapes::twoSided(shape).mesh);
    ASSERT_TRUE(topology);
    // Twice the umbrellas of one side: no face is glued to its own back.
    EXPECT_EQ(topology->valence.size(), 2 * size_t{shape.mesh.vertex_count});
    EXPECT_EQ(topology->faces.faceCount(), 2 * shape.mesh.face_degrees.size());
  }
}

TEST(Joins, TheBackOfASheetIsNearlyFree) {
  const Shape sheet = shapes::randomTriangulation(1000, 3);
  EXPECT_LT(encoded(shapes::twoSided(sheet)).size(), encoded(sheet).size() * 5 / 4);
}

TEST(Joins, TakeLessThanHalfOfAPlainList) {
  EXPECT_LT(partOfPlainList(shapes::book(101)), 0.5);
  EXPECT_LT(partOfPlainList(shapes::triangleHub(300)), 0.5);
  EXPECT_LT(partOfPlainList(shapes::voxelsTouchingAtEdges(8)), 0.5);
  EXPECT_LT(partOfPlainList(shapes::twoSided(shapes::perforatedGrid(9, 9))), 0.5);
  EXPECT_LT(partOfPlainList(shapes::twoSided(shapes::randomTriangulation(500, 1))), 0.2);
}

TEST(Joins, FacesWithARepeatedVertexAreCheap) {
  // One face in ten folded to a line along one of its edges, as exporters leave them.
  Shape shape = shapes::triangleTorus(30, 20);
  const size_t clean = encoded(shape).size();
  for (Index face = 0; face < 1200; face += 10) {
    const Index a = shape.mesh.corners[3 * face], b = shape.mesh.corners[3 * face + 1];
    shape.addFace({a, b, a});
  }
  EXPECT_LT(encoded(shape).size(), clean + 120 * 14 / 8);  // a plain list: 28 bits each
}

}  // namespace
}  // namespace tutte
