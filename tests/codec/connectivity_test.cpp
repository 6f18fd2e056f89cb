// Round trips: whatever goes in comes out, and clean meshes are not cut.

#include <gtest/gtest.h>

#include "codec/decode.h"
#include "codec/encode.h"
#include "tests/codec/checks.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using shapes::Named;
using shapes::Shape;

TEST(RoundTrip, GivesTheSameMesh) {
  for (const Named& named : shapes::allShapes()) EXPECT_TRUE(roundTrips(named.shape.mesh)) << named.name;
}

TEST(RoundTrip, GivesTheSameMeshAfterShuffling) {
  for (const Named& named : shapes::allShapes()) {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
      EXPECT_TRUE(roundTrips(shapes::shuffle(named.shape, seed).mesh)) << named.name << ", seed " << seed;
    }
  }
}

TEST(RoundTrip, GivesTheSameMeshWithEveryProfileAndEffort) {
  for (const Named& named : shapes::allShapes()) {
    for (const Profile profile : {Profile::kPaper, Profile::kFast, Profile::kDefault, Profile::kSmall}) {
      for (const int effort : {0, 1, 2}) {
        EXPECT_TRUE(roundTrips(named.shape.mesh, {profile, effort}))
            << named.name << ", profile " << static_cast<int>(profile) << ", effort " << effort;
      }
    }
  }
}

TEST(RoundTrip, GivesTheSameBytesTwice) {
  for (const Named& named : shapes::allShapes()) {
    const Result<Encoded> first = encode(named.shape.mesh);
    const Result<Encoded> second = encode(named.shape.mesh);
    ASSERT_TRUE(first && second) << named.name;
    EXPECT_EQ(first->bytes, second->bytes) << named.name;
  }
}

TEST(Clean, ShapesAreNotCut) {
  for (const Named& named : shapes::cleanShapes()) {
    const Result<Encoded> encoded = encode(named.shape.mesh);
    ASSERT_TRUE(encoded) << named.name;
    EXPECT_TRUE(isUncut(encoded->connectivity, named.shape.mesh)) << named.name;
  }
}

TEST(Soups, TenThousandComeBackExactly) {
  for (uint64_t seed = 0; seed < 10000; ++seed) {
    shapes::Random random(seed);
    const Index vertices = 1 + random.below(12), faces = random.below(24);
    const Index min_degree = random.below(4), max_degree = min_degree + random.below(5);
    const Shape soup = shapes::soup(vertices, faces, min_degree, max_degree, seed);
    ASSERT_TRUE(roundTrips(soup.mesh)) << "seed " << seed;
  }
}

TEST(Soups, LargeOnesComeBackExactly) {
  EXPECT_TRUE(roundTrips(shapes::soup(300, 20000, 3, 5, 1).mesh));
  EXPECT_TRUE(roundTrips(shapes::soup(20000, 20000, 0, 9, 2).mesh));
}

TEST(Clean, RandomPolygonMeshesAreNotCut) {
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    const Shape triangles = shapes::randomTriangulation(static_cast<Index>(4 + seed % 90), seed);
    const Shape polygons = shapes::mergeFaces(triangles, static_cast<Index>(seed % 40), seed);
    const Shape torn = shapes::shuffle(shapes::flipFaces(polygons, static_cast<Index>(seed % 3), seed), seed);
    ASSERT_TRUE(roundTrips(polygons.mesh)) << "seed " << seed;
    ASSERT_TRUE(roundTrips(torn.mesh)) << "seed " << seed;
    ASSERT_TRUE(isUncut(encode(polygons.mesh)->connectivity, polygons.mesh)) << "seed " << seed;
  }
}

TEST(Large, ShapesOfAllKindsComeBack) {
  EXPECT_TRUE(roundTrips(shapes::triangleTorus(300, 200).mesh));
  EXPECT_TRUE(roundTrips(shapes::hexTorus(200, 100).mesh));
  EXPECT_TRUE(roundTrips(shapes::plate(40, 40).mesh));
  EXPECT_TRUE(roundTrips(shapes::sponge(10).mesh));
  EXPECT_TRUE(roundTrips(shapes::perforatedGrid(60, 60).mesh));
  EXPECT_TRUE(roundTrips(shapes::islands(20000).mesh));
  EXPECT_TRUE(roundTrips(shapes::comb(20000).mesh));
  EXPECT_TRUE(roundTrips(shapes::fan(100000, true).mesh));
  EXPECT_TRUE(roundTrips(shapes::triangleHub(50000).mesh));
  EXPECT_TRUE(roundTrips(shapes::book(50000).mesh));
  EXPECT_TRUE(roundTrips(shapes::disc(200000).mesh));
  EXPECT_TRUE(roundTrips(shapes::dihedron(50000).mesh));
  EXPECT_TRUE(roundTrips(shapes::voxelsTouchingAtEdges(20).mesh));
}

TEST(Size, RegularTorusIsAlmostFree) {
  const Result<Encoded> encoded = encode(shapes::triangleTorus(100, 100).mesh);
  ASSERT_TRUE(encoded);
  EXPECT_LT(encoded->bytes.size(), 400u);
}

TEST(Refusal, CornerBeyondTheVertices) {
  Shape shape = shapes::cube();
  shape.mesh.corners[5] = shape.mesh.vertex_count;
  const Result<Encoded> encoded = encode(shape.mesh);
  ASSERT_FALSE(encoded);
  EXPECT_EQ(encoded.error(), Error::kIndexOutOfRange);
}

TEST(Refusal, DegreesThatDoNotSumUpToTheCorners) {
  for (int change : {-1, 1}) {
    Shape shape = shapes::cube();
    shape.mesh.face_degrees[2] = static_cast<Index>(4 + change);
    const Result<Encoded> encoded = encode(shape.mesh);
    ASSERT_FALSE(encoded);
    EXPECT_EQ(encoded.error(), Error::kCountMismatch);
  }
  Shape shape = shapes::cube();
  shape.mesh.face_degrees.assign(3, 0x80000008u);
  const Result<Encoded> encoded = encode(shape.mesh);
  ASSERT_FALSE(encoded) << "a sum beyond 2^32 must not wrap";
}

TEST(Refusal, DecodingBeyondTheLimits) {
  const Result<Encoded> encoded = encode(shapes::prism(100).mesh);
  ASSERT_TRUE(encoded);
  Limits exact;
  exact.max_vertices = 200;
  exact.max_faces = 102;
  exact.max_corners = 600;
  EXPECT_TRUE(decode(encoded->bytes, exact));
  for (Index Limits::*member : {&Limits::max_vertices, &Limits::max_faces, &Limits::max_corners}) {
    Limits limits = exact;
    --(limits.*member);
    const Result<Connectivity> decoded = decode(encoded->bytes, limits);
    ASSERT_FALSE(decoded);
    EXPECT_EQ(decoded.error(), Error::kLimitExceeded);
  }
}

}  // namespace
}  // namespace tutte
