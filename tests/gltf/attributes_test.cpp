// Meshes with one or many attributes, with seams and without: what comes back.

#include <gtest/gtest.h>

#include "gltf_ext/octahedron.h"
#include "tests/gltf/attribute_trip.h"
#include "tests/gltf/coded_mesh.h"

namespace tutte {
namespace {

TEST(Attributes, PositionsOfEveryShape) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    for (const bool split : {false, true}) {
      CodedMesh mesh = codeMesh(shape, split);
      const std::vector<Attribute> attributes{positionsOf(mesh, shape)};
      const auto decoded = roundTrip(mesh, attributes);
      ASSERT_EQ(decoded.size(), 1u);
      EXPECT_LE(largestError(attributes[0], decoded[0]), quantisationBound(attributes[0], 14));
      const auto exact = roundTrip(mesh, attributes, losslessPacking());
      ASSERT_EQ(exact.size(), 1u);
      EXPECT_EQ(exact[0].data, attributes[0].data);
    }
  }
}

TEST(Attributes, SeamsKeepEveryWedgesValue) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    CodedMesh mesh = codeMesh(shape, true);
    const Index count = mesh.wedgeCount();
    std::vector<Attribute> attributes{positionsOf(mesh, shape)};
    attributes.push_back(makeFloats("NORMAL", 3, count, [](Index w, int c) { return direction(w)[c]; }));
    attributes.push_back(makeFloats("TEXCOORD_0", 2, count, wave));
    attributes.push_back(makeFloats("TEXCOORD_1", 2, count, [&](Index w, int c) { return wave(mesh.vertex[w], c); }));
    attributes.push_back(makeAttribute<uint16_t>("_ID", ComponentType::kUint16, 1, count,
                                                 [](Index w, int) { return static_cast<uint16_t>(w * 7); }));
    const auto decoded = roundTrip(mesh, attributes);
    ASSERT_EQ(decoded.size(), attributes.size());
    EXPECT_LE(largestError(attributes[1], decoded[1]), 3.0 / octahedronCentre(10));
    EXPECT_LE(largestError(attributes[2], decoded[2]), quantisationBound(attributes[2], 12));
    EXPECT_LE(largestError(attributes[3], decoded[3]), quantisationBound(attributes[3], 12));
    EXPECT_EQ(decoded[4].data, attributes[4].data);
  }
}

TEST(Attributes, DecodedValuesAreAFixedPoint) {
  const shapes::Shape shape = shapes::mergeFaces(shapes::randomTriangulation(300, 5), 100, 6);
  CodedMesh mesh = codeMesh(shape);
  std::vector<Attribute> attributes{positionsOf(mesh, shape)};
  attributes.push_back(makeFloats("NORMAL", 3, mesh.wedgeCount(), [](Index w, int c) { return direction(w)[c]; }));
  const auto once = roundTrip(mesh, attributes);
  const auto twice = roundTrip(mesh, once);
  for (size_t i = 0; i < attributes.size(); ++i) EXPECT_EQ(once[i].data, twice[i].data) << attributes[i].name;
}

TEST(Attributes, NoneAndNothing) {
  CodedMesh mesh = codeMesh(shapes::cube());
  EXPECT_TRUE(roundTrip(mesh, {}).empty());
  CodedMesh empty = codeMesh(shapes::Shape{});
  const auto decoded = roundTrip(empty, {makeFloats("POSITION", 3, 0, wave), makeFloats("NORMAL", 3, 0, wave)});
  EXPECT_EQ(decoded.size(), 2u);
}

TEST(Attributes, ManyMorphTargets) {
  const shapes::Shape shape = shapes::quadGrid(6, 6);
  CodedMesh mesh = codeMesh(shape);
  std::vector<Attribute> attributes{positionsOf(mesh, shape)};
  for (int target = 0; target < 300; ++target) {
    attributes.push_back(makeFloats("POSITION@" + std::to_string(target), 3, mesh.wedgeCount(),
                                    [&](Index w, int c) { return wave(w * target, c); }));
  }
  const auto decoded = roundTrip(mesh, attributes);
  ASSERT_EQ(decoded.size(), attributes.size());
  for (size_t i = 0; i < decoded.size(); ++i) {
    EXPECT_LE(largestError(attributes[i], decoded[i]), quantisationBound(attributes[i], 14));
  }
}

}  // namespace
}  // namespace tutte
