// Scenes to assets and back.

#include "gltf_ext/scene.h"

#include <gtest/gtest.h>

#include <cstring>

#include "gltf_ext/decompress.h"
#include "gltf_ext/extract.h"
#include "gltf_ext/triangulate.h"
#include "tests/gltf/assets.h"

namespace tutte {
namespace {

PolygonMesh meshOf(const shapes::Shape& shape) {
  PolygonMesh mesh;
  mesh.polygons = shape.mesh;
  mesh.wedge_count = shape.mesh.vertex_count;
  Attribute position{"POSITION", 3, ComponentType::kFloat, false, {}};
  position.data.resize(size_t{mesh.wedge_count} * 12);
  for (Index v = 0; v < mesh.wedge_count; ++v) {
    const shapes::Position invented = {static_cast<float>(v), static_cast<float>(v % 7), static_cast<float>(v % 11)};
    const shapes::Position& value = v < shape.positions.size() ? shape.positions[v] : invented;
    std::memcpy(position.data.data() + 12 * size_t{v}, value.data(), 12);
  }
  mesh.attributes.push_back(std::move(position));
  triangulate(mesh);
  return mesh;
}

TEST(Scene, ShapesSurviveWithTheirVertices) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    Scene scene;
    scene.meshes.push_back({name, meshOf(shape), {}});
    const auto compressed = sceneToAsset(scene, lossless());
    if (fanIndices(shape.mesh).empty()) continue;
    ASSERT_TRUE(compressed) << why(compressed);
    for (const Failure& failure : validate(compressed->asset)) ADD_FAILURE() << failure.where << ": " << failure.what;
    const auto back = assetToScene(*parseAsset(*toGlb(compressed->asset)));
    ASSERT_TRUE(back) << why(back);
    ASSERT_EQ(back->meshes.size(), 1u);
    EXPECT_TRUE(facesOf(back->meshes[0].mesh) == facesOf(scene.meshes[0].mesh));
    EXPECT_EQ(back->meshes[0].mesh.polygons.vertex_count, shape.mesh.vertex_count);
    EXPECT_EQ(back->meshes[0].name, name);
  }
}

TEST(Scene, NodesGroupsAndMaterials) {
  Scene scene;
  PolygonMesh cube = meshOf(shapes::cube());
  cube.groups = {0, 0, 1, 1, 0, 1};
  cube.group_count = 2;
  scene.meshes.push_back({"cube", cube, {1, -1}});
  scene.meshes.push_back({"prism", meshOf(shapes::prism(5)), {0}});
  scene.materials = {{"red", {1, 0, 0, 1}}, {"glass", {0, 0, 1, 0.5}}};
  Matrix moved = kIdentity;
  moved[12] = 5;
  scene.nodes = {{"root", {}, kIdentity, {1, 2}}, {"both", {0, 1}, moved, {}}, {"one", {1}, kIdentity, {}}};
  const auto compressed = sceneToAsset(scene, lossless());
  ASSERT_TRUE(compressed) << why(compressed);
  const auto back = assetToScene(compressed->asset);
  ASSERT_TRUE(back) << why(back);
  EXPECT_EQ(back->meshes[0].group_materials, (std::vector<int>{1, -1}));
  EXPECT_EQ(back->meshes[1].group_materials, (std::vector<int>{0}));
  EXPECT_TRUE(facesOf(back->meshes[0].mesh) == facesOf(cube));
  EXPECT_EQ(back->materials[1].name, "glass");
  EXPECT_EQ(back->materials[1].base_color, scene.materials[1].base_color);
  ASSERT_EQ(back->nodes.size(), 4u) << "a second mesh of a node gets a node of its own";
  EXPECT_EQ(back->nodes[1].matrix, moved);
  EXPECT_EQ(back->nodes[1].children, (std::vector<Index>{3}));
  EXPECT_EQ(back->nodes[3].meshes, (std::vector<Index>{1}));
  EXPECT_EQ(compressed->asset.json["scenes"][0]["nodes"], Json::array({0}));
}

TEST(Scene, FacesWithoutTrianglesAreKept) {
  Scene scene;
  scene.meshes.push_back({"small", meshOf(shapes::smallFaces()), {}});
  const auto compressed = sceneToAsset(scene, lossless());
  ASSERT_TRUE(compressed) << why(compressed);
  const auto back = assetToScene(compressed->asset);
  ASSERT_TRUE(back) << why(back);
  EXPECT_TRUE(facesOf(back->meshes[0].mesh) == facesOf(scene.meshes[0].mesh));
}

TEST(Scene, MeshesThatCannotBeShownAreNamed) {
  Scene scene;
  shapes::Shape edge;
  edge.mesh = {{2}, {0, 1}, 2};
  scene.meshes.push_back({"an edge", meshOf(edge), {}});
  const auto compressed = sceneToAsset(scene);
  ASSERT_FALSE(compressed);
  EXPECT_NE(compressed.error().where.find("an edge"), std::string::npos);
  scene.meshes[0] = {"nothing", meshOf(shapes::Shape{}), {}};
  const auto empty = sceneToAsset(scene);
  ASSERT_TRUE(empty) << why(empty);
  EXPECT_EQ(empty->report.warnings.size(), 1u);
}

TEST(Extract, PartsOfAMesh) {
  PolygonMesh cube = meshOf(shapes::cube());
  cube.groups = {2, 0, 1, 1, 1, 1};
  cube.group_count = 3;
  const std::vector<Index> wanted = {2, 0};
  const PolygonMesh part = extractGroups(cube, wanted);
  EXPECT_EQ(part.polygons.face_degrees, (std::vector<Index>{4, 4}));
  EXPECT_EQ(part.groups, (std::vector<Index>{0, 1}));
  EXPECT_EQ(part.group_count, 2u);
  EXPECT_EQ(part.attributes[0].data.size(), part.wedge_count * 12u);
  EXPECT_EQ(part.triangulation.counts, (std::vector<Index>{2, 2}));
  const std::vector<Index> all = {0, 1, 2};
  EXPECT_TRUE(facesOf(extractGroups(cube, all)) == facesOf(cube));
}

}  // namespace
}  // namespace tutte
