// Triangles of generated polygons: the right number, no overlap, nothing left uncovered.

#include "gltf_ext/triangulate.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <random>

#include "gltf_ext/ear_clipping.h"

namespace tutte {
namespace {

using Ring = std::vector<Point2>;

double ringArea(std::span<const Point2> ring) {
  double area = 0;
  for (size_t i = 1; i + 1 < ring.size(); ++i) area += cross(ring[0], ring[i], ring[i + 1]);
  return area;
}

/// A mesh of one polygon: the first ring is its exterior, the others are holes.
PolygonMesh meshOf(const std::vector<Ring>& rings) {
  PolygonMesh mesh;
  Attribute position{.name = "POSITION", .data = {}};
  for (size_t ring = 0; ring < rings.size(); ++ring) {
    mesh.polygons.face_degrees.push_back(static_cast<Index>(rings[ring].size()));
    mesh.ring_owners.push_back(ring == 0 ? kNone : 0);
    for (const Point2& point : rings[ring]) {
      mesh.polygons.corners.push_back(mesh.wedge_count++);
      const std::array<float, 3> at{static_cast<float>(point.x), 0, static_cast<float>(-point.y)};
      const auto* bytes = reinterpret_cast<const uint8_t*>(at.data());
      position.data.insert(position.data.end(), bytes, bytes + sizeof at);
    }
  }
  mesh.polygons.vertex_count = mesh.wedge_count;
  mesh.attributes.push_back(std::move(position));
  return mesh;
}

std::vector<Point2> pointsOf(const std::vector<Ring>& rings) {
  std::vector<Point2> points;
  for (const Ring& ring : rings) {
    for (const Point2& point : ring) points.push_back({static_cast<float>(point.x), static_cast<float>(point.y)});
  }
  return points;
}

/// Triangles that are all the right way up, and whose areas sum to the polygon's, cover it without overlap.
void expectCovered(const std::vector<Ring>& rings) {
  PolygonMesh mesh = meshOf(rings);
  triangulate(mesh);
  const std::vector<Point2> points = pointsOf(rings);
  double expected = 0;
  for (size_t ring = 0, start = 0; ring < rings.size(); start += rings[ring++].size()) {
    expected += ringArea(std::span(points).subspan(start, rings[ring].size()));
  }
  const auto& corners = mesh.triangulation.corners;
  ASSERT_EQ(mesh.triangulation.counts[0], points.size() + 2 * (rings.size() - 1) - 2);
  ASSERT_EQ(corners.size(), 3 * size_t{mesh.triangulation.counts[0]});
  double sum = 0;
  for (size_t i = 0; i < corners.size(); i += 3) {
    const double area = cross(points[corners[i]], points[corners[i + 1]], points[corners[i + 2]]);
    EXPECT_GE(area, -1e-6 * expected);
    sum += std::abs(area);
  }
  EXPECT_NEAR(sum, expected, 1e-6 * expected);
  std::vector<bool> used(points.size());
  for (Index corner : corners) used[corner] = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

Ring circle(int n, double radius = 1, Point2 center = {}, bool clockwise = false) {
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n * (clockwise ? -1 : 1);
    ring.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
  }
  return ring;
}

Ring star(int points) {
  Ring ring = circle(2 * points);
  for (size_t i = 1; i < ring.size(); i += 2) ring[i] = {ring[i].x * 0.3, ring[i].y * 0.3};
  return ring;
}

Ring comb(int teeth) {
  Ring ring{{0, 0}, {2.0 * teeth, 0}};
  for (int i = teeth; i-- > 0;) {
    ring.push_back({2.0 * i + 1.5, 10});
    ring.push_back({2.0 * i + 0.5, 1});
  }
  ring.push_back({0, 10});
  return ring;
}

Ring spiral(int n) {
  Ring ring;
  for (int i = 0; i < n; ++i) ring.push_back({(1 + 0.1 * i) * std::cos(0.2 * i), (1 + 0.1 * i) * std::sin(0.2 * i)});
  for (int i = n; i-- > 0;) ring.push_back({(2 + 0.1 * i) * std::cos(0.2 * i), (2 + 0.1 * i) * std::sin(0.2 * i)});
  std::reverse(ring.begin(), ring.end());
  return ring;
}

Ring randomStarShaped(std::mt19937& random, int n) {
  Ring ring = circle(n);
  std::uniform_real_distribution<double> radius(0.1, 1);
  for (Point2& point : ring) {
    const double r = radius(random);
    point = {point.x * r, point.y * r};
  }
  return ring;
}

bool isFanOf(const PolygonMesh& mesh, Index apex) {
  for (size_t i = 0; i < mesh.triangulation.corners.size(); i += 3) {
    if (mesh.triangulation.corners[i] != apex) return false;
  }
  return true;
}

TEST(Triangulate, ConvexPolygonsGetTheFanFromTheirFirstCorner) {
  for (int n : {3, 4, 5, 8, 9, 100, 1000}) {
    PolygonMesh mesh = meshOf({circle(n)});
    triangulate(mesh);
    EXPECT_TRUE(isFanOf(mesh, 0)) << n;
    expectCovered({circle(n)});
  }
}

TEST(Triangulate, ConcaveQuadIsSplitAcrossItsReflexCorner) {
  for (size_t turn = 0; turn < 4; ++turn) {
    Ring dart{{0, 0}, {2, -1}, {0.5, 0}, {2, 1}};  // reflex at index 2
    std::swap(dart[1], dart[3]);
    std::reverse(dart.begin(), dart.end());
    std::rotate(dart.begin(), dart.begin() + static_cast<ptrdiff_t>(turn), dart.end());
    if (ringArea(dart) < 0) std::reverse(dart.begin(), dart.end());
    expectCovered({dart});
  }
}

TEST(Triangulate, StarShapedFromACornerBecomesAFan) {
  Ring ring = circle(12);
  ring[6] = {-0.9, 0};
  ring[0] = {0.2, 0};  // every other corner is hidden from some; the reflex one sees all
  PolygonMesh mesh = meshOf({{ring[11], ring[0], ring[1], ring[3], ring[6], ring[9]}});
  triangulate(mesh);
  EXPECT_TRUE(isFanOf(mesh, mesh.triangulation.corners[0]));
  expectCovered({{ring[11], ring[0], ring[1], ring[3], ring[6], ring[9]}});
}

TEST(Triangulate, StarsCombsAndSpirals) {
  for (int n : {3, 5, 17, 200}) {
    expectCovered({star(n)});
    expectCovered({comb(n)});
    expectCovered({spiral(n + 5)});
  }
}

TEST(Triangulate, RandomPolygons) {
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) expectCovered({randomStarShaped(random, 4 + i % 60)});
}

TEST(Triangulate, OneHole) { expectCovered({circle(8, 3), circle(6, 1, {}, true)}); }

TEST(Triangulate, ManyHoles) {
  for (int side : {2, 5, 12}) {
    std::vector<Ring> rings{{{0, 0}, {4.0 * side, 0}, {4.0 * side, 4.0 * side}, {0, 4.0 * side}}};
    for (int i = 0; i < side * side; ++i) {
      rings.push_back(circle(3 + i % 7, 1.2, {4.0 * (i % side) + 2, 4.0 * (i / side) + 2}, true));
    }
    expectCovered(rings);
  }
}

TEST(Triangulate, HolesInAConcaveRingAtRandomPlaces) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(0.1, 0.9);
  for (int i = 0; i < 500; ++i) {
    std::vector<Ring> rings{comb(6)};
    for (int hole = 0; hole < 6; ++hole) rings.push_back(circle(5, 0.1, {2.0 * hole + 1, at(random)}, true));
    for (Point2& point : rings[0]) point.y -= point.y == 10 ? at(random) : 0;
    expectCovered(rings);
  }
}

TEST(Triangulate, HolesThatTouchTheRingAndEachOther) {
  const Ring square{{0, 0}, {8, 0}, {8, 8}, {0, 8}};
  expectCovered({square, {{0, 0}, {1, 3}, {3, 1}}});                                    // at a corner
  expectCovered({square, {{2, 2}, {2, 4}, {4, 4}, {4, 2}}, {{4, 4}, {4, 6}, {6, 4}}});  // at each other's corner
  expectCovered({square, {{8, 4}, {6, 3}, {6, 5}}});                                    // on an edge
}

TEST(Triangulate, CollinearAndDoubledPoints) {
  expectCovered({{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}});
  expectCovered({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}}});
  expectCovered({{{1, 0}, {2, 0}, {3, 0}, {3, 3}, {0, 0}}});
  expectCovered({{{0, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 2}}});
  expectCovered({{{0, 0}, {4, 0}, {4, 4}, {2, 2}, {2, 2}, {0, 4}}});
}

TEST(Triangulate, DirtyRingsGetTheirNumberOfTriangles) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> at(0, 6);
  for (int i = 0; i < 3000; ++i) {
    std::vector<Ring> rings(1 + i % 3);
    for (Ring& ring : rings) {
      for (int corner = 0; corner < 3 + i % 20; ++corner) ring.push_back({double(at(random)), double(at(random))});
    }
    PolygonMesh mesh = meshOf(rings);
    triangulate(mesh);
    const size_t expected = pointsOf(rings).size() + 2 * (rings.size() - 1) - 2;
    ASSERT_EQ(mesh.triangulation.counts[0], expected);
  }
}

TEST(Triangulate, FacesBelowThreeCornersHaveNone) {
  PolygonMesh mesh = meshOf({{{0, 0}}});
  mesh.ring_owners.clear();
  triangulate(mesh);
  EXPECT_EQ(mesh.triangulation.counts, std::vector<Index>{0});
}

TEST(Triangulate, PositionsThatAreNotFiniteGiveFans) {
  PolygonMesh mesh = meshOf({star(5)});
  std::memset(mesh.attributes[0].data.data(), 0xFF, 12);
  triangulate(mesh);
  EXPECT_TRUE(isFanOf(mesh, 0));
  EXPECT_EQ(mesh.triangulation.counts[0], 8u);
}

TEST(Triangulate, HugePolygonsEnd) {
  const auto start = std::chrono::steady_clock::now();
  std::mt19937 random(9);
  for (const Ring& ring : {circle(200'000), comb(100'000), randomStarShaped(random, 200'000), spiral(100'000)}) {
    PolygonMesh mesh = meshOf({ring});
    triangulate(mesh);
    EXPECT_EQ(mesh.triangulation.counts[0], ring.size() - 2);
  }
  PolygonMesh line = meshOf({Ring(300'000, Point2{1, 1})});
  triangulate(line);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

}  // namespace
}  // namespace tutte
