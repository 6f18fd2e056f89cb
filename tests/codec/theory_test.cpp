// Bounds that theory gives, held against whole connectivity sections. docs/theory.md has the figures of larger meshes.

#include <gtest/gtest.h>

#include <cmath>

#include "codec/encode.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using shapes::Shape;

size_t bytesOf(const Shape& shape, Profile profile, int effort = 0) {
  const Result<Encoded> encoded = encode(shape.mesh, {.profile = profile, .effort = effort});
  EXPECT_TRUE(encoded);
  return encoded ? encoded->bytes.size() : 0;
}

double bitsPer(size_t count, const Shape& shape, Profile profile) {
  return 8.0 * static_cast<double>(bytesOf(shape, profile)) / static_cast<double>(count);
}

constexpr std::array kMixed = {Profile::kDefault, Profile::kSmall};
constexpr std::array kAll = {Profile::kPaper, Profile::kFast, Profile::kDefault, Profile::kSmall};

struct Torus {
  const char* name;
  Shape (*make)(Index, Index);
};
constexpr Torus kTori[] = {
    {"triangles", shapes::triangleTorus}, {"quads", shapes::quadTorus}, {"hexagons", shapes::hexTorus}};

TEST(Theory, RegularMeshesCostAConstant) {
  for (const Torus& torus : kTori) {
    SCOPED_TRACE(torus.name);
    const Shape small = torus.make(30, 30), large = torus.make(200, 200);
    for (const Profile profile : kMixed) {
      EXPECT_LE(bytesOf(small, profile), 24u);
      EXPECT_LE(bytesOf(large, profile), 64u);  // more than forty times as many faces
    }
    // One context without mixing learns no more than about 255 of 256.
    for (const Profile profile : kAll) EXPECT_LE(bitsPer(40'000, large, profile), 0.04);
  }
}

TEST(Theory, DualsCostTheSame) {
  const Shape polygons = shapes::subdivideToQuads(shapes::mergeFaces(shapes::randomTriangulation(80, 1), 40, 2));
  for (const Shape& mesh : {shapes::uniformPolyhedron(3000, 1), shapes::uniformTriangulation(1500, 1),
                            shapes::adaptiveTessellation(polygons, 8, 2, 1, 3), polygons}) {
    const double one = static_cast<double>(bytesOf(mesh, Profile::kDefault, 2));
    const double other = static_cast<double>(bytesOf(shapes::dual(mesh), Profile::kDefault, 2));
    EXPECT_NEAR(one, other, 0.01 * one + 8);  // where to begin is found by chance
  }
}

/// log2 of the number of rooted triangulations of the sphere without double edges: 2 (4n - 3)! / (n! (3n - 1)!) with
/// n + 2 vertices.
double triangulationBits(Index vertices) {
  const double n = vertices - 2.0;
  return (std::log(2.0) + std::lgamma(4 * n - 2) - std::lgamma(n + 1) - std::lgamma(3 * n)) / std::log(2.0);
}

TEST(Theory, TriangulationsComeNearTuttesBound) {
  constexpr Index kVertices = 20'000;
  const Shape shape = shapes::uniformTriangulation(kVertices, 1);
  const double bound = triangulationBits(kVertices) / kVertices;
  EXPECT_NEAR(bound, std::log2(256.0 / 27), 0.01);
  for (const Profile profile : kAll) {
    EXPECT_GE(bitsPer(kVertices, shape, profile), 0.999 * bound);  // nobody beats it, on average
    EXPECT_LE(bitsPer(kVertices, shape, profile), 1.16 * bound);
  }
  for (const Profile profile : kMixed) EXPECT_LE(bitsPer(kVertices, shape, profile), 1.11 * bound);
}

TEST(Theory, PolyhedraComeNearTuttesBound) {
  constexpr Index kEdges = 30'000;
  const Shape shape = shapes::uniformPolyhedron(kEdges, 1);
  for (const Profile profile : kAll) {
    EXPECT_GE(bitsPer(kEdges, shape, profile), 2 - 2.5 * std::log2(kEdges) / kEdges);
    EXPECT_LE(bitsPer(kEdges, shape, profile), 2 * 1.22);
  }
  for (const Profile profile : kMixed) EXPECT_LE(bitsPer(kEdges, shape, profile), 2 * 1.17);
}

TEST(Theory, SubdivisionVanishes) {
  const Shape base = shapes::randomTriangulation(73, 1);
  const Shape coarse = shapes::subdivideTriangles(base, 3), fine = shapes::subdivideTriangles(base, 5);
  for (const Profile profile : kMixed) {
    EXPECT_LE(bitsPer(fine.mesh.vertex_count, fine, profile), 0.03);
    EXPECT_LE(bytesOf(fine, profile), 2 * bytesOf(coarse, profile));  // 16 times as many faces
  }
}

TEST(Theory, AdaptiveTessellationsStayBelowThePapersRates) {
  const Shape base = shapes::mergeFaces(shapes::randomTriangulation(200, 1), 100, 1);
  const Shape shape = shapes::adaptiveTessellation(shapes::subdivideToQuads(base), 20, 3, 2, 2);
  EXPECT_LE(bitsPer(shape.mesh.vertex_count, shape, Profile::kPaper), 1.9);
  for (const Profile profile : kMixed) EXPECT_LE(bitsPer(shape.mesh.vertex_count, shape, profile), 1.2);
}

}  // namespace
}  // namespace tutte
