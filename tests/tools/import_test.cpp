// Importers on files made here: what they keep, and what they say about broken ones.

#include "tools/import.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/tools/scratch.h"
#include "tools/values.h"

namespace tutte {
namespace {

std::span<const uint8_t> bytesOf(const std::string& text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

const PolygonMesh& only(const Outcome<Imported>& imported) {
  EXPECT_TRUE(imported.ok()) << imported.error().where << ": " << imported.error().what;
  EXPECT_EQ(imported->scene.meshes.size(), 1u);
  return imported->scene.meshes.at(0).mesh;
}

void expectFailure(const Outcome<Imported>& imported, const std::string& where, const std::string& what) {
  ASSERT_FALSE(imported.ok());
  EXPECT_EQ(imported.error().where, where);
  EXPECT_NE(imported.error().what.find(what), std::string::npos) << imported.error().what;
  EXPECT_NE(imported.error().what.find("; "), std::string::npos) << "no remedy: " << imported.error().what;
}

std::vector<float> valuesOf(const PolygonMesh& mesh, const char* name) {
  const Attribute* attribute = findAttribute(mesh, name);
  return attribute ? floatsOf(*attribute) : std::vector<float>();
}

const std::string kQuadAndTriangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n";

TEST(ImportObj, KeepsFacesOfAnyDegree) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += "v " + std::to_string(i) + " 0 0\n";
  text += "f 1\nf 1 2\nf 1 2 3\nf";
  for (int i = 1; i <= 300; ++i) text += " " + std::to_string(i);
  const auto imported = importObj(bytesOf(text), {});
  EXPECT_EQ(only(imported).polygons.face_degrees, (std::vector<Index>{1, 2, 3, 300}));
  EXPECT_EQ(only(imported).polygons.corners.back(), 299u);
}

TEST(ImportObj, KeepsVertexIdentityAndPutsIsolatedVerticesLast) {
  const auto imported = importObj(bytesOf("v 9 9 9\nv 0 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 4 5\nf 3 5 4\n"), {});
  const PolygonMesh& mesh = only(imported);
  EXPECT_EQ(mesh.polygons.vertex_count, 5u);  // the two at the origin stay two
  EXPECT_EQ(mesh.polygons.corners, (std::vector<Index>{0, 2, 3, 1, 3, 2}));
  EXPECT_EQ(valuesOf(mesh, "POSITION")[12], 9);  // the isolated one
}

TEST(ImportObj, MakesWedgesOfIndexTuples) {
  const auto imported = importObj(
      bytesOf(kQuadAndTriangle + "vt 0 0\nvt 1 0.25\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1 4/1/1\nf 2/1/1 5/1/1 3/1/1\n"), {});
  const PolygonMesh& mesh = only(imported);
  EXPECT_EQ(mesh.polygons.vertex_count, 5u);
  EXPECT_EQ(mesh.wedge_count, 6u);  // vertex 2 has two texture coordinates
  EXPECT_EQ(mesh.polygons.corners[1], mesh.polygons.corners[4]);
  EXPECT_NE(mesh.wedgeOf(1), mesh.wedgeOf(4));
  EXPECT_EQ(valuesOf(mesh, "TEXCOORD_0")[2 * mesh.wedgeOf(1) + 1], 0.75f);  // turned upside down
}

TEST(ImportObj, CountsNegativeIndicesBackwards) {
  const auto imported = importObj(bytesOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -1 -2\n"), {});
  EXPECT_EQ(only(imported).polygons.corners, (std::vector<Index>{0, 1, 2, 0, 3, 2}));
}

TEST(ImportObj, ReadsColoursMaterialsAndOddText) {
  const Scratch scratch;
  scratch.write("my colours.mtl", "newmtl red one\nKd 1 0 0\nd 0.5\n");
  const auto path =
      scratch.write("model.obj",
                    "\xEF\xBB\xBF# comment\r\nmtllib my colours.mtl\r\nv 0 0 0 1 0 0\r\nv 1 0 0 0 1 0 # c\r\n"
                    "v 0 1 0 0 0 1\r\nv 1 1 0 1 1 1\r\nf 1 2 \\\r\n3\r\nusemtl red one\r\nf 2 4 3");
  const auto imported = importScene(path);
  const PolygonMesh& mesh = only(imported);
  EXPECT_EQ(mesh.polygons.face_degrees, (std::vector<Index>{3, 3}));
  EXPECT_EQ(mesh.groups, (std::vector<Index>{0, 1}));
  EXPECT_EQ(valuesOf(mesh, "COLOR_0")[4], 1);
  ASSERT_EQ(imported->scene.materials.size(), 1u);
  EXPECT_EQ(imported->scene.materials[0].name, "red one");
  EXPECT_EQ(imported->scene.materials[0].base_color[3], 0.5);
  EXPECT_EQ(imported->scene.meshes[0].group_materials, (std::vector<int>{-1, 0}));
}

TEST(ImportObj, OpensNoFileOutsideTheFolder) {
  const Scratch scratch;
  scratch.write("outside.mtl", "newmtl a\nKd 1 0 0\n");
  std::filesystem::create_directory(scratch / "inside");
  for (const std::string& name : {std::string("../outside.mtl"), (scratch / "outside.mtl").string()}) {
    const auto path =
        scratch.write("inside/m.obj", "mtllib " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const auto imported = importScene(path);
    ASSERT_TRUE(imported.ok());
    EXPECT_FALSE(imported->warnings.empty());
    EXPECT_EQ(imported->scene.materials[0].base_color[1], 1);
  }
}

TEST(ImportObj, CompletesNormals) {
  const auto imported =
      importObj(bytesOf(kQuadAndTriangle + "vn 0 0 2\nvn 0 0 0\nf 1//1 2//1 3//1 4//2\nf 2 5 3\n"), {});
  const PolygonMesh& mesh = only(imported);
  const auto normals = valuesOf(mesh, "NORMAL");
  for (Index wedge = 0; wedge < mesh.wedge_count; ++wedge) EXPECT_FLOAT_EQ(normals[3 * wedge + 2], 1);
  EXPECT_EQ(imported->warnings.size(), 2u);
}

TEST(ImportObj, NamesLineAndRemedy) {
  expectFailure(importObj(bytesOf("v 0 0 0\nv 1 0 0\nf 1 2 3\n"), {}), "line 3", "does not exist");
  expectFailure(importObj(bytesOf("v 0 0 0\nf 1 -2 1\n"), {}), "line 2", "does not exist");
  expectFailure(importObj(bytesOf("v 0 0 0\nf 0 1 1\n"), {}), "line 2", "names no vertex");
  expectFailure(importObj(bytesOf("v 0 0 0\nf 1/4 1 1\n"), {}), "line 2", "texture coordinate");
  expectFailure(importObj(bytesOf("v 0 0 0\n\n# c\nf 1 x 1\n"), {}), "line 4", "vertex numbers");
  expectFailure(importObj(bytesOf("v 0 0 nan\n"), {}), "line 1", "finite");
  expectFailure(importObj(bytesOf("v 0 0\n"), {}), "line 1", "missing");
  expectFailure(importObj(bytesOf("v 0 0 1e99\n"), {}), "line 1", "finite");
  expectFailure(importObj(bytesOf("v 0 0 0\nf \n"), {}), "line 2", "no vertex");
  expectFailure(importObj(bytesOf(std::string("v 0 0 0\0", 8)), {}), "byte 7", "not text");
  expectFailure(importObj(bytesOf("\xFE\xFF v"), {}), "byte 0", "UTF-16");
}

TEST(ImportObj, WarnsAboutWhatIsLost) {
  const auto imported = importObj(bytesOf(kQuadAndTriangle + "g a\np 1\nl 1 2\nf 1 2 3\n"), {});
  ASSERT_TRUE(imported.ok());
  EXPECT_EQ(imported->warnings.size(), 2u);
}

const std::string kPlyHead =
    "comment x\nelement vertex 4\nproperty float x\nproperty float y\nproperty double z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty short quality\n"
    "element edge 1\nproperty int a\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";

template <class T>
void put(std::string& text, T value, bool big) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  if (big) std::reverse(bytes, bytes + sizeof value);
  text.append(bytes, sizeof value);
}

std::string binaryPly(bool big) {
  std::string text = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + kPlyHead;
  for (int i = 0; i < 4; ++i) {
    put(text, i == 1 || i == 2 ? 1.0f : 0.0f, big);
    put(text, i >= 2 ? 1.0f : 0.0f, big);
    put(text, 0.5, big);
    text += {'\x10', '\x20', '\x30'};
    put(text, static_cast<int16_t>(-i), big);
  }
  put(text, int32_t{7}, big);
  for (const auto& face : {std::vector<int>{0, 1, 2, 3}, std::vector<int>{2, 1, 0}}) {
    text += static_cast<char>(face.size());
    for (int vertex : face) put(text, static_cast<int32_t>(vertex), big);
  }
  return text;
}

TEST(ImportPly, ReadsAllThreeFormatsAlike) {
  const std::string text = "ply\nformat ascii 1.0\n" + kPlyHead +
                           "0 0 0.5 16 32 48 0\n1 0 0.5 16 32 48 -1\n1 1 0.5 16 32 48 -2\n0 1 0.5 16 32 48 -3\n7\n"
                           "4 0 1 2 3\n3 2 1 0\n";
  const auto ascii = importPly(bytesOf(text));
  for (const bool big : {false, true}) {
    const std::string binary = binaryPly(big);
    const auto imported = importPly(bytesOf(binary));
    const PolygonMesh& mesh = only(imported);
    EXPECT_EQ(mesh.polygons.face_degrees, (std::vector<Index>{4, 3}));
    EXPECT_EQ(mesh.polygons.corners, only(ascii).polygons.corners);
    EXPECT_EQ(valuesOf(mesh, "POSITION"), valuesOf(only(ascii), "POSITION"));
    EXPECT_EQ(valuesOf(mesh, "_QUALITY"), (std::vector<float>{0, -1, -2, -3}));
    const Attribute* color = findAttribute(mesh, "COLOR_0");
    ASSERT_TRUE(color);
    EXPECT_EQ(color->type, ComponentType::kUint8);
    EXPECT_EQ(std::vector<uint8_t>(color->data.begin(), color->data.begin() + 4),
              (std::vector<uint8_t>{16, 32, 48, 255}));
    EXPECT_EQ(imported->warnings.size(), 1u);  // the edges
  }
}

TEST(ImportPly, EveryPrefixIsRefused) {
  const std::string whole = binaryPly(false);
  for (size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(importPly(bytesOf(whole.substr(0, size))).ok()) << size;
}

TEST(ImportPly, TurnsEverySecondTriangleOfAStrip) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  for (int i = 0; i < 6; ++i) text += std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\n";
  const auto imported = importPly(bytesOf(text + "10 0 1 2 3 -1 2 3 3 4 5\n"));
  EXPECT_EQ(only(imported).polygons.corners, (std::vector<Index>{0, 1, 2, 2, 1, 3, 3, 4, 5}));
}

TEST(ImportPly, ReadsTextureCoordinatesOfCorners) {
  const auto imported = importPly(bytesOf(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_index\nproperty list uchar float texcoord\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0.5 1 1 0 1\n"));
  EXPECT_EQ(only(imported).polygons.vertex_count, 4u);
  EXPECT_EQ(only(imported).wedge_count, 5u);
}

TEST(ImportPly, NamesElementAndRemedy) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  expectFailure(importPly(bytesOf(head + "0 0 0\n3 0 0 1\n")), "face 0", "vertex 1");
  expectFailure(importPly(bytesOf(head + "0 0 0\n3 0 0 -1\n")), "face 0", "names no vertex");
  expectFailure(importPly(bytesOf(head + "0 0 nan\n3 0 0 0\n")), "vertex 0", "finite");
  expectFailure(importPly(bytesOf(head + "0 0 0\n3 0 0")), "face 0", "too early");
  expectFailure(importPly(bytesOf(head + "0 0 0\n-3 0 0\n")), "face 0", "length");
  expectFailure(importPly(bytesOf("ply\nformat ascii 2.0\n")), "line 2", "format");
  expectFailure(importPly(bytesOf("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n")),
                "vertex 0", "too short");
}

TEST(ImportOff, ReadsCommentsColoursNormalsAndOddHeaders) {
  const auto plain =
      importOff(bytesOf("# c\nOFF 4 2 0 # c\n\n0 0 0\n1 0 0\n1 1 0\n0 1 0 # c\n4 0 1 2 3\n3 0 1 2 255 0 0\n"));
  EXPECT_EQ(only(plain).polygons.face_degrees, (std::vector<Index>{4, 3}));
  EXPECT_EQ(plain->warnings.size(), 1u);
  const auto rich =
      importOff(bytesOf("STCNOFF\n3 1 3\n0 0 0 0 0 1 255 0 0 255 0.5 0.5\n1 0 0 0 0 1 0 255 0 255 1 0\n"
                        "0 1 0 0 0 1 0 0 255 255 0 1\n3 0 1 2\n"));
  EXPECT_EQ(only(rich).attributes.size(), 4u);
  EXPECT_EQ(findAttribute(only(rich), "COLOR_0")->type, ComponentType::kUint8);
  EXPECT_EQ(only(importOff(bytesOf("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"))).polygons.vertex_count, 3u);
}

TEST(ImportOff, ReadsBinaryOfEitherOrderWithAndWithoutColourCounts) {
  for (const bool big : {false, true}) {
    for (const bool counts : {false, true}) {
      std::string text = "OFF BINARY\n";
      for (const int32_t count : {4, 2, 0}) put(text, count, big);
      for (int i = 0; i < 12; ++i) put(text, static_cast<float>(i), big);
      for (const auto& face : {std::vector<int>{0, 1, 2, 3}, std::vector<int>{2, 1, 0}}) {
        put(text, static_cast<int32_t>(face.size()), big);
        for (int vertex : face) put(text, static_cast<int32_t>(vertex), big);
        if (counts) put(text, int32_t{0}, big);
      }
      const auto imported = importOff(bytesOf(text));
      EXPECT_EQ(only(imported).polygons.corners, (std::vector<Index>{0, 1, 2, 3, 2, 1, 0}));
      for (size_t size = 0; size < text.size(); ++size) EXPECT_FALSE(importOff(bytesOf(text.substr(0, size))).ok());
    }
  }
}

TEST(ImportOff, NamesLineAndRemedy) {
  expectFailure(importOff(bytesOf("OFF\n1 1 0\n0 0 0\n3 0 0 1\n")), "line 4", "vertex 1");
  expectFailure(importOff(bytesOf("OFF\n1 1 0\n0 0 x\n3 0 0 0\n")), "line 3", "finite");
  expectFailure(importOff(bytesOf("OFF\n1 2 0\n0 0 0\n3 0 0 0\n")), "line 5", "too early");
  expectFailure(importOff(bytesOf("4OFF\n1 1 0\n")), "line 1", "OFF");
  expectFailure(importOff(bytesOf("OFF\n4000000000 1 0\n")), "line 3", "too short");
}

TEST(ImportScene, TellsFormatsByContent) {
  const Scratch scratch;
  const auto obj = scratch.write("really_obj.off", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(only(importScene(obj)).polygons.vertex_count, 3u);
  const auto ply =
      scratch.write("really_ply.xyz", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n");
  EXPECT_EQ(only(importScene(ply)).polygons.vertex_count, 1u);
}

TEST(ImportScene, MissingFilesAreInputErrors) {
  const auto imported = importScene("does_not_exist.obj");
  ASSERT_FALSE(imported.ok());
  EXPECT_EQ(imported.error().kind, FailureKind::kIo);
}

TEST(ImportAssimp, WeldsSoupsByPosition) {
  const Scratch scratch;
  const auto path = scratch.write("two.stl",
                                  "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                  "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\n"
                                  "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n");
  EXPECT_EQ(only(importScene(path)).polygons.vertex_count, 4u);
}

TEST(ImportAssimp, KeepsPolygonsOfRealModels) {
  const std::filesystem::path folder = "/usr/share/assimp/models";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
  const auto duck = importScene(folder / "Collada/duck.dae");
  EXPECT_EQ(only(duck).polygons.face_degrees.size(), 2144u);
  EXPECT_EQ(only(duck).polygons.vertex_count, 2108u);
  EXPECT_FALSE(duck->warnings.empty());  // its texture, light and camera
  const auto spider = importScene(folder / "OBJ/spider.obj");
  EXPECT_EQ(only(spider).polygons.vertex_count, 762u);
}

}  // namespace
}  // namespace tutte
