// The generators of uniformly random meshes: what they make is what it claims to be, and all of it is equally likely.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using shapes::Shape;

std::vector<std::vector<Index>> facesOf(const Polygons& mesh) {
  std::vector<std::vector<Index>> faces;
  auto corner = mesh.corners.begin();
  for (const Index degree : mesh.face_degrees) {
    faces.emplace_back(corner, corner + degree);
    corner += degree;
  }
  return faces;
}

/// Closed, oriented, of the sphere, without double edges.
void expectSphere(const Polygons& mesh) {
  std::set<std::pair<Index, Index>> edges;
  for (const auto& face : facesOf(mesh)) {
    for (size_t i = 0; i < face.size(); ++i) {
      EXPECT_TRUE(edges.emplace(face[i], face[(i + 1) % face.size()]).second);
    }
  }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.count({b, a}));
  EXPECT_EQ(mesh.vertex_count + mesh.face_degrees.size(), edges.size() / 2 + 2);
}

std::string valencesOf(const Polygons& mesh) {
  std::vector<Index> valences(mesh.vertex_count);
  for (const Index vertex : mesh.corners) ++valences[vertex];
  std::sort(valences.begin(), valences.end());
  std::string text;
  for (const Index valence : valences) {
    text += std::to_string(valence);
    text += ' ';
  }
  return text;
}

/// How often each list of valences occurs among meshes with different seeds.
template <class Make>
std::map<std::string, int> histogram(int trials, Make make) {
  std::map<std::string, int> counts;
  for (int seed = 0; seed < trials; ++seed) ++counts[valencesOf(make(static_cast<uint64_t>(seed)).mesh)];
  return counts;
}

TEST(RandomShapes, TriangulationsAreTriangulations) {
  for (const Index vertices : {4u, 5u, 6u, 17u, 300u, 3000u}) {
    const Shape shape = shapes::uniformTriangulation(vertices, vertices);
    EXPECT_EQ(shape.mesh.vertex_count, vertices);
    EXPECT_TRUE(std::ranges::all_of(shape.mesh.face_degrees, [](Index degree) { return degree == 3; }));
    expectSphere(shape.mesh);
  }
}

TEST(RandomShapes, PolyhedraArePolyhedra) {
  for (const Index edges : {6u, 8u, 9u, 30u, 500u}) {
    const Shape shape = shapes::uniformPolyhedron(edges, edges);
    EXPECT_EQ(shape.mesh.corners.size(), 2 * edges);
    expectSphere(shape.mesh);
    // 3-connected: two faces share nothing, a vertex, or the two ends of one edge.
    const auto faces = facesOf(shape.mesh);
    for (const auto& a : faces) {
      for (const auto& b : faces) {
        if (&a == &b) continue;
        std::vector<size_t> shared;
        for (size_t i = 0; i < a.size(); ++i) {
          if (std::ranges::find(b, a[i]) != b.end()) shared.push_back(i);
        }
        ASSERT_LE(shared.size(), 2u);
        if (shared.size() < 2) continue;
        EXPECT_TRUE(shared[1] == shared[0] + 1 || (shared[0] == 0 && shared[1] + 1 == a.size()));
      }
    }
  }
}

// Of the 13 rooted triangulations with 6 vertices one is the octahedron; the 6 rooted polyhedra with 9 edges are the
// prism, 3 times, and its dual. The bounds are five standard deviations.
TEST(RandomShapes, AreUniform) {
  const auto triangulations = histogram(13'000, [](uint64_t seed) { return shapes::uniformTriangulation(6, seed); });
  ASSERT_EQ(triangulations.size(), 2u);
  EXPECT_NEAR(triangulations.at("4 4 4 4 4 4 "), 1000, 152);
  const auto polyhedra = histogram(10'000, [](uint64_t seed) { return shapes::uniformPolyhedron(9, seed); });
  ASSERT_EQ(polyhedra.size(), 2u);
  EXPECT_NEAR(polyhedra.at("3 3 3 3 3 3 "), 5000, 250);
  EXPECT_NEAR(polyhedra.at("3 3 4 4 4 "), 5000, 250);
}

TEST(RandomShapes, RefinedMeshesAreClosed) {
  const Shape base = shapes::mergeFaces(shapes::randomTriangulation(60, 1), 30, 2);
  const Shape quads = shapes::subdivideToQuads(base);
  expectSphere(quads.mesh);
  for (const Index deepest : {0u, 1u, 2u, 3u}) {
    const Shape shape = shapes::adaptiveTessellation(quads, 9, deepest, 1, 3);
    expectSphere(shape.mesh);
    const auto triangles = std::ranges::count(shape.mesh.face_degrees, 3u);
    EXPECT_EQ(triangles == 0, deepest == 0);
    EXPECT_EQ(triangles + std::ranges::count(shape.mesh.face_degrees, 4u), std::ssize(shape.mesh.face_degrees));
  }
  const Shape triangles = shapes::subdivideTriangles(shapes::randomTriangulation(20, 1), 3);
  expectSphere(triangles.mesh);
  EXPECT_EQ(triangles.mesh.vertex_count, 18u * 64 + 2);
}

}  // namespace
}  // namespace tutte
