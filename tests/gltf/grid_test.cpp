// Positions on shared grids: meshes that touch stay together, bounds are kept, small meshes keep their detail.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "gltf_ext/attribute_words.h"
#include "gltf_ext/grid_plan.h"
#include "gltf_ext/scene.h"
#include "gltf_ext/triangulate.h"
#include "tests/gltf/coded_mesh.h"

namespace tutte {
namespace {

constexpr double kFloatRounding = 0x1p-24;

PositionBox box(float least, float largest, size_t mesh) {
  return {{least, least, least}, {largest, 0, 0}, true, mesh};
}

std::vector<std::optional<PositionGrid>> plan(const std::vector<PositionBox>& boxes, const PackOptions& options = {},
                                              GridScope scope = GridScope::kFile) {
  const auto grids = planGrids(boxes, options, scope);
  EXPECT_TRUE(grids.ok());
  return grids ? *grids : std::vector<std::optional<PositionGrid>>(boxes.size());
}

/// A mesh whose vertices have numbers, so that they are found again whatever order they come back in.
PolygonMesh numbered(const shapes::Shape& shape, const std::vector<std::array<float, 3>>& positions, Index first) {
  PolygonMesh mesh;
  mesh.polygons = shape.mesh;
  mesh.wedge_count = shape.mesh.vertex_count;
  mesh.attributes.push_back(
      makeFloats("POSITION", 3, mesh.wedge_count, [&](Index w, int c) { return positions[w][c]; }));
  mesh.attributes.push_back(makeAttribute<uint32_t>("_ID", ComponentType::kUint32, 1, mesh.wedge_count,
                                                    [&](Index w, int) { return first + w; }));
  triangulate(mesh);
  return mesh;
}

std::vector<std::array<float, 3>> randomPositions(Index count, double size, double center, uint64_t seed) {
  shapes::Random random(seed);
  std::vector<std::array<float, 3>> positions(count);
  for (auto& position : positions) {
    for (float& x : position) x = static_cast<float>(center + size * (1e-6 * random.below(1000000) - 0.5));
  }
  return positions;
}

/// The decoded positions of every mesh by the numbers of their vertices.
std::map<uint32_t, std::array<float, 3>> decodedPositions(const Scene& scene, const CompressOptions& options) {
  std::map<uint32_t, std::array<float, 3>> positions;
  const auto compressed = sceneToAsset(scene, options);
  EXPECT_TRUE(compressed.ok()) << compressed.error().what;
  if (!compressed) return positions;
  const auto decoded = assetToScene(compressed->asset);
  EXPECT_TRUE(decoded.ok());
  for (const SceneMesh& mesh : decoded->meshes) {
    const Attribute &points = mesh.mesh.attributes[0], &ids = mesh.mesh.attributes[1];
    for (Index w = 0; w < mesh.mesh.wedge_count; ++w) {
      positions[loadBytes(&ids.data[4 * w], 4)] = {floatAt(points, w, 0), floatAt(points, w, 1), floatAt(points, w, 2)};
    }
  }
  return positions;
}

double farthest(const std::vector<std::array<float, 3>>& before, const std::map<uint32_t, std::array<float, 3>>& after,
                Index first) {
  double error = 0;
  for (Index v = 0; v < before.size(); ++v) {
    for (int c = 0; c < 3; ++c) error = std::max(error, std::fabs(double{before[v][c]} - after.at(first + v)[c]));
  }
  return error;
}

TEST(Grids, OneMeshHasItsOwn) {
  EXPECT_EQ(plan({box(0, 5, 0)})[0], std::nullopt);
  EXPECT_EQ(plan({box(0, 5, 0), {}})[0], std::nullopt);
  PackOptions lossless;
  lossless.position_bits = 0;
  EXPECT_EQ(plan({box(0, 5, 0), box(0, 5, 1)}, lossless)[0], std::nullopt);
  EXPECT_TRUE(plan({}).empty());
}

TEST(Grids, StepsFollowTheLargestMeshAndAreQuarteredForSmallOnes) {
  const auto grids = plan({box(0, 1, 0), box(0, 100, 1), box(1, 27, 2), box(0, 24, 3), box(0, 6, 4), box(-3, 90, 5)});
  const float step = static_cast<float>(100.0 / 16383);
  const float steps[] = {step / 64, step, step, step / 4, step / 16, step};
  for (size_t i = 0; i < grids.size(); ++i) {
    ASSERT_TRUE(grids[i]) << i;
    EXPECT_EQ(grids[i]->origin, grids[0]->origin);
    EXPECT_FLOAT_EQ(grids[i]->step, steps[i]) << i;
  }
}

TEST(Grids, PrimitivesOfOneMeshAlwaysShare) {
  for (const GridScope scope : {GridScope::kFile, GridScope::kMesh}) {
    const auto grids = plan({box(0, 1, 7), box(50, 90, 7), box(0, 1000, 8)}, {}, scope);
    EXPECT_EQ(grids[0]->step, grids[1]->step);
    EXPECT_EQ(grids[0]->origin, grids[1]->origin);
    EXPECT_LT(grids[0]->step, grids[2]->step);
  }
}

TEST(Grids, BoundsThatFloatsCannotKeepAreRefused) {
  PackOptions options;
  options.errors.position.size = 1e-7;
  const std::vector<PositionBox> boxes{box(0, 1000, 0)};
  const auto grids = planGrids(boxes, options, GridScope::kFile);
  ASSERT_FALSE(grids.ok());
  EXPECT_EQ(grids.error().kind, FailureKind::kUsage);
}

/// Every second vertex of B is one of A's.
TEST(Grids, MeshesThatTouchStayTogether) {
  const shapes::Shape shape_a = shapes::quadTorus(12, 9), shape_b = shapes::randomTriangulation(60, 4);
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const double size = std::pow(10.0, static_cast<double>(seed) - 4);
    const auto a = randomPositions(shape_a.mesh.vertex_count, size, 3 * size, seed);
    auto b = randomPositions(shape_b.mesh.vertex_count, size, 2.7 * size, seed + 100);
    for (Index v = 0; v < b.size(); v += 2) b[v] = a[v % a.size()];
    Scene scene;
    scene.meshes = {{"a", numbered(shape_a, a, 0), {}}, {"b", numbered(shape_b, b, 1000), {}}};
    for (const double bound : {0.0, 0.003 * size}) {
      CompressOptions options;
      options.pack.errors.position.size = bound;
      const auto decoded = decodedPositions(scene, options);
      for (Index v = 0; v < b.size(); v += 2)
        EXPECT_EQ(decoded.at(1000 + v), decoded.at(v % static_cast<Index>(a.size()))) << v;
    }
  }
}

TEST(Grids, ErrorBoundsAreKept) {
  const shapes::Shape shape = shapes::randomTriangulation(200, 9);
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const double size = std::pow(10.0, static_cast<double>(seed % 6) - 3);
    const auto a = randomPositions(shape.mesh.vertex_count, size, 5 * size, seed);
    const auto b = randomPositions(shape.mesh.vertex_count, size / 50, -size, seed + 50);
    Scene scene;
    scene.meshes = {{"a", numbered(shape, a, 0), {}}, {"b", numbered(shape, b, 1000), {}}};
    if (seed % 2) scene.meshes.pop_back();
    for (const double part : {0.1, 0.01, 1e-3, 1e-5}) {
      for (const bool relative : {false, true}) {
        CompressOptions options;
        options.pack.errors.position = {relative ? part : part * size, relative};
        const auto decoded = decodedPositions(scene, options);
        EXPECT_LE(farthest(a, decoded, 0), part * size);
        EXPECT_GE(farthest(a, decoded, 0), part * size / 2) << "finer than was asked for";
        EXPECT_TRUE(seed % 2 || farthest(b, decoded, 1000) <= part * size);
      }
    }
  }
}

TEST(Grids, SmallMeshesKeepTheirDetail) {
  const shapes::Shape shape = shapes::quadTorus(12, 9);
  const auto a = randomPositions(shape.mesh.vertex_count, 1000, 0, 1);
  const auto b = randomPositions(shape.mesh.vertex_count, 0.5, 3, 2);
  Scene scene;
  scene.meshes = {{"a", numbered(shape, a, 0), {}}, {"b", numbered(shape, b, 1000), {}}};
  const double half_step = 0.5 / 16383 / 2;
  EXPECT_LE(farthest(b, decodedPositions(scene, {}), 1000), 4 * half_step + 4 * kFloatRounding);
  CompressOptions own;
  own.grid = GridScope::kMesh;
  EXPECT_LE(farthest(b, decodedPositions(scene, own), 1000), half_step + 4 * kFloatRounding);
}

TEST(Grids, DecodedPositionsAreAFixedPoint) {
  const shapes::Shape shape = shapes::quadTorus(12, 9);
  const auto a = randomPositions(shape.mesh.vertex_count, 10, 3, 1),
             b = randomPositions(shape.mesh.vertex_count, 9, 0, 2);
  Scene scene;
  scene.meshes = {{"a", numbered(shape, a, 0), {}}, {"b", numbered(shape, b, 1000), {}}};
  const auto once = sceneToAsset(scene, {});
  const auto again = decodedPositions(*assetToScene(once->asset), {});
  const auto decoded = decodedPositions(scene, {});
  for (const auto& [id, position] : decoded) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(again.at(id)[c], position[c], 1e-5);
  }
}

/// Where a morph target moves nothing, nothing moves.
TEST(Grids, WhatDoesNotMoveStaysWhereItIs) {
  const shapes::Shape shape = shapes::quadTorus(12, 9);
  CodedMesh mesh = codeMesh(shape);
  std::vector<Attribute> attributes{positionsOf(mesh, shape)};
  attributes.push_back(makeFloats("POSITION@0", 3, mesh.wedgeCount(), [](Index w, int c) {
    return w % 3 ? 0.f : static_cast<float>(0.1 * std::sin(w + c));
  }));
  PackOptions options;
  options.grid = PositionGrid{{0.5f, 0.25f, -3}, 0.001f};
  const AttributeTopology topology = mesh.topology(attributes);
  const auto decoded = decodeAttributes(topology, *encodeAttributes(topology, attributes, options));
  ASSERT_TRUE(decoded.ok());
  for (Index w = 0; w < mesh.wedgeCount(); ++w) {
    for (int c = 0; c < 3; ++c) {
      const float before = floatAt(attributes[1], w, c), after = floatAt((*decoded)[1], w, c);
      EXPECT_NEAR(before, after, 0.0005001);
      EXPECT_TRUE(before != 0 || after == 0);
    }
  }
}

}  // namespace
}  // namespace tutte
