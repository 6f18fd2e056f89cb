// What `verify` must see, and what it must not mind.

#include "tools/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "tests/tools/scenes.h"

namespace tutte {
namespace {

const CompareOptions kExact{.bits = {0, 0, 0, 0, 0}, .attributes = {}};

void expectSame(const Scene& a, const Scene& b, const CompareOptions& options = kExact) {
  const Comparison comparison = compare(a, b, options);
  EXPECT_TRUE(comparison.same) << comparison.difference;
}

void expectDifferent(const Scene& a, const Scene& b, const std::string& what, const CompareOptions& options = kExact) {
  for (const bool swapped : {false, true}) {
    const Comparison comparison = swapped ? compare(b, a, options) : compare(a, b, options);
    EXPECT_FALSE(comparison.same);
    EXPECT_NE(comparison.difference.find(what), std::string::npos) << comparison.difference;
  }
}

Polygons& polygonsOf(Scene& scene) { return scene.meshes[0].mesh.polygons; }

/// Everything at one place, so that only connectivity tells vertices apart.
Scene collapsed(const shapes::Shape& shape) {
  shapes::Shape flat = shape;
  flat.positions.assign(flat.mesh.vertex_count, {1, 2, 3});
  return sceneOf(flat);
}

TEST(Compare, OrderDoesNotMatter) {
  for (const auto& named : shapes::allShapes()) {
    const Scene scene = sceneOf(named.shape);
    SCOPED_TRACE(named.name);
    expectSame(scene, shuffled(scene, 1));
  }
}

TEST(Compare, OrderDoesNotMatterWhereNothingHasAPlace) {
  for (const auto& shape : {shapes::cube(), shapes::quadTorus(5, 4), shapes::copies(shapes::cube(), 5),
                            shapes::triangleGrid(6, 5), shapes::dihedron(6), shapes::islands(7)}) {
    expectSame(collapsed(shape), shuffled(collapsed(shape), 2));
  }
}

TEST(Compare, SeesAMissingFace) {
  const Scene scene = sceneOf(shapes::quadGrid(20, 20));
  Scene other = scene;
  polygonsOf(other).face_degrees.pop_back();
  polygonsOf(other).corners.resize(polygonsOf(other).corners.size() - 4);
  expectDifferent(scene, other, "counterpart");
}

TEST(Compare, SeesADoubledFaceInPlaceOfAnother) {
  const Scene scene = sceneOf(shapes::quadGrid(20, 20));
  Scene other = scene;
  std::copy_n(polygonsOf(other).corners.begin(), 4, polygonsOf(other).corners.end() - 4);
  expectDifferent(scene, other, "");
}

TEST(Compare, SeesAnotherDiagonal) {
  const Scene scene = sceneOf(shapes::triangleGrid(20, 20));
  Scene other = scene;
  // Two triangles a b c and c d a of a cell become a b d and b c d.
  auto& corners = polygonsOf(other).corners;
  for (size_t f = 0; f + 5 < corners.size(); f += 3) {
    std::vector<Index> quad(corners.begin() + static_cast<ptrdiff_t>(f),
                            corners.begin() + static_cast<ptrdiff_t>(f + 3));
    const auto shared =
        std::count_if(corners.begin() + static_cast<ptrdiff_t>(f + 3), corners.begin() + static_cast<ptrdiff_t>(f + 6),
                      [&](Index v) { return std::count(quad.begin(), quad.end(), v) > 0; });
    if (shared != 2) continue;
    Index fourth = 0, apex = 0;
    for (int i = 3; i < 6; ++i) {
      if (!std::count(quad.begin(), quad.end(), corners[f + i])) fourth = corners[f + i];
    }
    for (int i = 0; i < 3; ++i) {
      const auto begin = corners.begin() + static_cast<ptrdiff_t>(f + 3);
      if (!std::count(begin, begin + 3, quad[i])) apex = static_cast<Index>(i);
    }
    const Index a = quad[apex], b = quad[(apex + 1) % 3], c = quad[(apex + 2) % 3];
    const std::vector<Index> flipped = {a, b, fourth, fourth, c, a};
    std::copy(flipped.begin(), flipped.end(), corners.begin() + static_cast<ptrdiff_t>(f));
    break;
  }
  ASSERT_NE(corners, polygonsOf(const_cast<Scene&>(scene)).corners);
  expectDifferent(scene, other, "a polygon has no counterpart");
}

TEST(Compare, SeesAFlippedFace) {
  const Scene scene = sceneOf(shapes::quadTorus(12, 9));
  Scene other = scene;
  std::reverse(polygonsOf(other).corners.begin() + 40, polygonsOf(other).corners.begin() + 44);
  expectDifferent(scene, other, "a polygon has no counterpart");
}

TEST(Compare, SeesSwappedTextureCoordinates) {
  Scene scene = sceneOf(shapes::quadTorus(12, 9));
  addSeams(scene);
  Scene other = scene;
  // A corner takes the other wedge of its vertex.
  PolygonMesh& mesh = other.meshes[0].mesh;
  for (size_t corner = 0, changed = 0; !changed; ++corner) {
    for (size_t twin = 0; twin < corner && !changed; ++twin) {
      if (mesh.polygons.corners[twin] != mesh.polygons.corners[corner] || mesh.wedges[twin] == mesh.wedges[corner])
        continue;
      mesh.wedges[corner] = mesh.wedges[twin];
      changed = 1;
    }
  }
  expectDifferent(scene, other, "TEXCOORD_0 differs");
  expectSame(scene, shuffled(scene, 3));
}

TEST(Compare, SeesALostIsolatedVertex) {
  shapes::Shape shape = shapes::cube();
  Scene without = sceneOf(shape);
  shape.addVertex({5, 5, 5});
  const Scene with = sceneOf(shape);
  expectDifferent(with, without, "vertex");
  shape.addVertex({5, 5, 5});
  expectDifferent(with, sceneOf(shape), "as many vertices at one place");
  shapes::Shape hidden = shapes::cube();  // at a corner of the cube
  hidden.addVertex(hidden.positions[0]);
  expectDifferent(sceneOf(hidden), without, "as many vertices");
  expectSame(sceneOf(shape), shuffled(sceneOf(shape), 4));
}

TEST(Compare, SeesVerticesThatWereJoinedOrSplit) {
  // Two cubes that touch at a corner: with one vertex there, and with two.
  shapes::Shape two = shapes::copies(shapes::cube(), 2);
  two.positions[8] = two.positions[0];
  const Scene split = sceneOf(two);
  shapes::Shape one = two;
  for (Index& corner : one.mesh.corners) corner = corner == 8 ? 0 : corner > 8 ? corner - 1 : corner;
  one.positions.erase(one.positions.begin() + 8);
  one.mesh.vertex_count = 15;
  expectDifferent(split, sceneOf(one), "as many vertices at one place");
  CompareOptions by_place = kExact;
  by_place.vertices_matter = false;
  expectSame(split, sceneOf(one), by_place);
}

TEST(Compare, SeesWhichOfTwoCoincidentVerticesAFaceUses) {
  shapes::Shape two = shapes::copies(shapes::quadGrid(4, 4), 2);
  const size_t half = two.positions.size() / 2;
  std::copy_n(two.positions.begin(), half, two.positions.begin() + static_cast<ptrdiff_t>(half));
  const Scene scene = sceneOf(two);
  expectSame(scene, shuffled(scene, 5));
  Scene other = scene;
  auto& corners = polygonsOf(other).corners;
  std::swap(corners[22], corners[corners.size() / 2 + 22]);
  expectDifferent(scene, other, "");
}

TEST(Compare, SeesMissingAndAdditionalAttributes) {
  Scene scene = sceneOf(shapes::cube());
  addSeams(scene);
  Scene other = scene;
  other.meshes[0].mesh.attributes.pop_back();
  expectDifferent(scene, other, "TEXCOORD_0 is in the");
  CompareOptions some = kExact;
  some.attributes = {"NORMAL"};
  expectSame(scene, other, some);
}

TEST(Compare, ToleranceIsHalfAStep) {
  const Scene scene = sceneOf(shapes::quadGrid(30, 30));
  CompareOptions options = kExact;
  options.bits.position_bits = 10;
  const double step = 30 / 1023.0;
  Scene other = shuffled(scene, 6);
  nudge(other, "POSITION", 100, static_cast<float>(0.49 * step));
  expectSame(scene, other, options);
  EXPECT_FALSE(compare(scene, other, kExact).same);
  nudge(other, "POSITION", 100, static_cast<float>(0.1 * step));
  EXPECT_FALSE(compare(scene, other, options).same);
  options.tolerance = step;
  expectSame(scene, other, options);
}

TEST(Compare, CoarseGridsOfDenseMeshes) {
  // All vertices within reach of their neighbours: places tell nothing, faces do.
  const Scene scene = sceneOf(shapes::triangleGrid(40, 40));
  CompareOptions options = kExact;
  options.tolerance = 2;
  expectSame(scene, shuffled(scene, 7), options);
}

TEST(Compare, LargeMeshesTakeSeconds) {
  const Scene scene = sceneOf(shapes::quadTorus(300, 200));
  const auto start = std::chrono::steady_clock::now();
  expectSame(scene, shuffled(scene, 8));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace tutte
