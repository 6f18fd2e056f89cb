// Exporters: what they write reads back as the same scene.

#include "tools/export.h"

#include <gtest/gtest.h>

#include "tests/tools/scenes.h"
#include "tests/tools/scratch.h"
#include "tools/compare.h"
#include "tools/import.h"

namespace tutte {
namespace {

const CompareOptions kExact{.bits = {0, 0, 0, 0, 0}, .attributes = {}};

/// Writes, reads and compares; returns the warnings of the exporter.
std::vector<std::string> expectRoundTrip(const Scene& scene, const std::string& name, CompareOptions options = kExact) {
  const Scratch scratch;
  const auto exported = exportScene(scene, scratch / name);
  EXPECT_TRUE(exported.ok());
  EXPECT_TRUE(writeFiles(exported->files).ok());
  const auto imported = importScene(scratch / name);
  EXPECT_TRUE(imported.ok()) << imported.error().where << ": " << imported.error().what;
  if (!imported) return {};
  const Comparison comparison = compare(scene, imported->scene, options);
  EXPECT_TRUE(comparison.same) << comparison.difference;
  return exported->warnings;
}

TEST(Export, EveryShapeToObjAndPly) {
  for (const auto& named : shapes::allShapes()) {
    SCOPED_TRACE(named.name);
    bool empty_faces = false;  // OBJ has no faces without corners
    for (Index degree : named.shape.mesh.face_degrees) empty_faces = empty_faces || degree == 0;
    if (!empty_faces) expectRoundTrip(sceneOf(named.shape), "model.obj");
    expectRoundTrip(sceneOf(named.shape), "model.ply");
  }
}

TEST(Export, SeamsOfTextureCoordinatesKeepVertices) {
  Scene scene = sceneOf(shapes::quadTorus(9, 7));
  addSeams(scene);
  EXPECT_TRUE(expectRoundTrip(scene, "model.obj").empty());
  EXPECT_TRUE(expectRoundTrip(scene, "model.ply").empty());
}

TEST(Export, SeamsOfNormalsCostPlyItsVertices) {
  Scene scene = sceneOf(shapes::cube());
  addSeams(scene);
  PolygonMesh& mesh = scene.meshes[0].mesh;
  std::vector<float> normals;
  for (Index wedge = 0; wedge < mesh.wedge_count; ++wedge) {
    normals.insert(normals.end(), {wedge % 2 ? 1.0f : 0.0f, wedge % 2 ? 0.0f : 1.0f, 0.0f});
  }
  mesh.attributes[1] = floatAttribute("NORMAL", 3, normals);
  EXPECT_TRUE(expectRoundTrip(scene, "model.obj").empty());
  CompareOptions by_place = kExact;
  by_place.vertices_matter = false;
  EXPECT_EQ(expectRoundTrip(scene, "model.ply", by_place).size(), 1u);
}

TEST(Export, ColoursAndCustomAttributes) {
  Scene scene = sceneOf(shapes::tetrahedron());
  const std::vector<uint8_t> colors = {1, 2, 3, 255, 4, 5, 6, 7, 8, 9, 10, 11, 200, 201, 202, 203};
  auto& attributes = scene.meshes[0].mesh.attributes;
  attributes.push_back(byteAttribute("COLOR_0", 4, colors));
  attributes.push_back(floatAttribute("_QUALITY", 1, std::vector<float>{1, 2, 3.5f, -1e-30f}));
  EXPECT_TRUE(expectRoundTrip(scene, "model.ply").empty());
  CompareOptions options = kExact;
  options.attributes = {"NONE"};
  EXPECT_EQ(expectRoundTrip(scene, "model.obj", options).size(), 2u);  // opacity and _QUALITY
}

TEST(Export, MaterialsGoToALibrary) {
  const Scratch scratch;
  Scene scene = sceneOf(shapes::cube());
  scene.materials = {{"red", {1, 0, 0, 0.5}}, {"red", {0, 1, 0, 1}}};
  scene.meshes[0].mesh.groups = {0, 0, 1, 1, 0, 1};
  scene.meshes[0].mesh.group_count = 2;
  scene.meshes[0].group_materials = {0, 1};
  ASSERT_TRUE(writeFiles(exportObj(scene, scratch / "m.obj").files).ok());
  const auto imported = importScene(scratch / "m.obj");
  ASSERT_TRUE(imported.ok());
  ASSERT_EQ(imported->scene.materials.size(), 2u);
  EXPECT_EQ(imported->scene.materials[0].base_color[3], 0.5);
  EXPECT_EQ(imported->scene.materials[1].base_color[1], 1);
  EXPECT_EQ(imported->scene.meshes[0].mesh.groups, scene.meshes[0].mesh.groups);
}

TEST(Export, MeshesStandWhereTheirNodesPutThem) {
  Scene scene = sceneOf(shapes::cube());
  scene.nodes = {{.name = "a", .meshes = {0}, .children = {1}}, {.name = "b", .meshes = {0}, .children = {}}};
  scene.nodes[1].matrix[12] = 10;
  for (const char* name : {"model.obj", "model.ply"}) expectRoundTrip(scene, name);
  const auto placed = placedMeshes(scene);
  ASSERT_EQ(placed.size(), 2u);
}

TEST(Export, PolygonsWithHolesBecomeTriangles) {
  Scene scene = sceneOf(shapes::copies(shapes::disc(4), 2));
  PolygonMesh& mesh = scene.meshes[0].mesh;
  mesh.attributes[0] = floatAttribute(
      "POSITION", 3, std::vector<float>{0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0, 3, 3, 0, 3, 6, 0, 6, 6, 0, 6, 3, 0});
  mesh.ring_owners = {kNone, 0};
  triangulate(mesh);
  const Scratch scratch;
  const Exported exported = exportObj(scene, scratch / "m.obj");
  EXPECT_EQ(exported.warnings.size(), 1u);
  ASSERT_TRUE(writeFiles(exported.files).ok());
  EXPECT_EQ(importScene(scratch / "m.obj")->scene.meshes[0].mesh.polygons.face_degrees, std::vector<Index>(8, 3));
}

TEST(Export, OtherExtensionsAreUsageErrors) {
  const auto exported = exportScene({}, "model.xyz");
  ASSERT_FALSE(exported.ok());
  EXPECT_EQ(exported.error().kind, FailureKind::kUsage);
}

}  // namespace
}  // namespace tutte
