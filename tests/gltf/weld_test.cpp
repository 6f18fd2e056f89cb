// Vertices in one place: coded as one point, and told apart again.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "codec/payload.h"
#include "gltf_ext/welding.h"
#include "tests/gltf/coded_mesh.h"
#include "tests/gltf/packed_mesh.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using shapes::Position;
using shapes::Shape;

/// A box with vertices of its own, from one corner to the opposite one.
void addBox(Shape& shape, Position low, Position high) {
  const Index first = shape.mesh.vertex_count;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto at = [&](unsigned axis) { return corner >> axis & 1 ? high[axis] : low[axis]; };
    shape.addVertex({at(0), at(1), at(2)});
  }
  for (const std::array<Index, 4>& face : std::initializer_list<std::array<Index, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    shape.addFace({first + face[0], first + face[1], first + face[2], first + face[3]});
  }
}

/// Every face has vertices of its own.
Shape exploded(const Shape& shape) {
  Shape result;
  result.mesh.face_degrees = shape.mesh.face_degrees;
  for (const Index corner : shape.mesh.corners) {
    result.mesh.corners.push_back(result.addVertex(shape.positions[corner]));
  }
  return result;
}

Shape twoBoxes(Position second_low, Position second_high) {
  Shape shape;
  addBox(shape, {0, 0, 0}, {1, 1, 1});
  addBox(shape, second_low, second_high);
  return shape;
}

/// A strip of quads that runs to and fro over the same places: layers upon layers.
Shape foldedStrip(Index quads, Index width) {
  Shape shape;
  for (Index i = 0; i <= quads; ++i) {
    const Index at = i % (2 * width);
    const auto x = static_cast<float>(std::min(at, 2 * width - at));
    shape.addVertex({x, 0, 0});
    shape.addVertex({x, 1, 0});
  }
  for (Index i = 0; i < quads; ++i) shape.addFace({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  return shape;
}

/// Faces with two or more of their corners in one place.
Shape facesThatWouldRepeatAVertex() {
  Shape shape;
  const Position places[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  for (const Position& place : places) shape.addVertex(place);
  shape.addFace({0, 1, 2, 3});     // next to each other
  shape.addFace({0, 1, 3, 2, 4});  // apart
  shape.addFace({4, 5, 1});        // nothing but an edge is left
  shape.addFace({0, 3, 6});        // nothing but a point is left
  return shape;
}

Shape isolatedAmongDuplicates() {
  Shape shape = exploded(shapes::cube());
  shape.addVertex(shape.positions[0]);  // where corners are
  shape.addVertex({7, 7, 7});
  shape.addVertex({7, 7, 7});
  return shape;
}

Shape opposedDuplicates() {
  Shape shape = exploded(shapes::cube());
  const std::vector<Index> corners = shape.mesh.corners;
  for (size_t i = 0; i < corners.size(); i += 4) {
    std::vector<Index> face;
    for (size_t k = 4; k-- > 0;) face.push_back(shape.addVertex(shape.positions[corners[i + k]]));
    shape.addFace(face);
  }
  return shape;
}

std::vector<shapes::Named> shapesWithDuplicates() {
  std::vector<shapes::Named> list = {
      {"cube with a vertex per corner", exploded(shapes::cube())},
      {"sheet with a vertex per corner", exploded(shapes::quadGrid(12, 9))},
      {"boxes that touch in a vertex", twoBoxes({1, 1, 1}, {2, 2, 2})},
      {"boxes that touch in an edge", twoBoxes({1, 1, 0}, {2, 2, 1})},
      {"boxes that touch in a face", twoBoxes({1, 0, 0}, {2, 1, 1})},
      {"a box twice", twoBoxes({0, 0, 0}, {1, 1, 1})},
      {"folded strip", foldedStrip(20, 6)},
      {"faces that would repeat a vertex", facesThatWouldRepeatAVertex()},
      {"isolated vertices", isolatedAmongDuplicates()},
      {"an inside and an outside", opposedDuplicates()},
  };
  for (uint64_t seed = 0; seed < 6; ++seed) {
    Shape soup = shapes::soup(40, 25, 1, 6, seed);
    shapes::Random random(seed);
    for (Index v = 0; v < soup.mesh.vertex_count; ++v) {
      soup.positions.push_back({static_cast<float>(random.below(5)), 0, 0});
    }
    list.push_back({"soup in few places " + std::to_string(seed), soup});
  }
  return list;
}

/// Without wedges: each vertex is one.
PolygonMesh plain(const Shape& shape) {
  PolygonMesh mesh;
  mesh.polygons = shape.mesh;
  std::vector<Position> positions;  // isolated vertices come last
  for (const bool isolated : {false, true}) {
    for (Index v = 0; v < shape.mesh.vertex_count; ++v) {
      if ((std::ranges::find(shape.mesh.corners, v) == shape.mesh.corners.end()) != isolated) continue;
      positions.push_back(shape.positions[v]);
      for (size_t c = 0; c < shape.mesh.corners.size(); ++c) {
        if (shape.mesh.corners[c] == v) mesh.polygons.corners[c] = static_cast<Index>(positions.size() - 1);
      }
    }
  }
  mesh.wedge_count = shape.mesh.vertex_count;
  mesh.attributes.push_back(makeFloats("POSITION", 3, mesh.wedge_count,
                                       [&](Index v, int c) { return positions[v][static_cast<size_t>(c)]; }));
  return mesh;
}

/// Two wedges for vertices of even and odd faces, with values that differ in some.
PolygonMesh withSeams(const Shape& shape) {
  const PolygonMesh flat = plain(shape);
  PolygonMesh mesh = flat;
  std::vector<Index> vertex_of, wedge_of(2 * flat.wedge_count, kNone);
  size_t corner = 0;
  for (size_t face = 0; face < flat.polygons.face_degrees.size(); ++face) {
    for (Index i = 0; i < flat.polygons.face_degrees[face]; ++i, ++corner) {
      const Index vertex = flat.polygons.corners[corner];
      Index& wedge = wedge_of[2 * vertex + face % 2];
      if (wedge == kNone) {
        wedge = static_cast<Index>(vertex_of.size());
        vertex_of.push_back(vertex);
      }
      mesh.wedges.push_back(wedge);
    }
  }
  for (Index v = 0; v < flat.polygons.vertex_count; ++v) {
    if (wedge_of[2 * v] == kNone && wedge_of[2 * v + 1] == kNone) vertex_of.push_back(v);
  }
  mesh.wedge_count = static_cast<Index>(vertex_of.size());
  const auto* positions = reinterpret_cast<const float*>(flat.attributes[0].data.data());
  mesh.attributes = {
      makeFloats("POSITION", 3, mesh.wedge_count, [&](Index w, int c) { return positions[3 * vertex_of[w] + c]; }),
      makeFloats("TEXCOORD_0", 2, mesh.wedge_count, [](Index w, int c) { return static_cast<float>(w % 5 + 3 * c); })};
  return mesh;
}

PackOptions exactly(std::optional<bool> weld) {
  PackOptions options = withoutLoss({});
  options.weld = weld;
  return options;
}

PayloadCounts countsOf(const PolygonMesh& mesh, std::optional<bool> weld) {
  const Outcome<Packed> packed = pack(mesh, exactly(weld));
  EXPECT_TRUE(packed.ok());
  return *peekCounts(packed->bytes);
}

TEST(Weld, EveryVertexAndWedgeComesBack) {
  for (const shapes::Named& named : shapesWithDuplicates()) {
    SCOPED_TRACE(named.name);
    for (const PolygonMesh& mesh : {plain(named.shape), withSeams(named.shape)}) {
      EXPECT_GT(countsOf(mesh, true).welded, 0u);
      EXPECT_EQ(countsOf(mesh, false).welded, 0u);
      for (const std::optional<bool> weld : {std::optional(true), std::optional(false), std::optional<bool>()}) {
        expectRoundTrip(mesh, exactly(weld));
      }
    }
  }
}

TEST(Weld, CountsPoints) {
  EXPECT_EQ(countsOf(plain(exploded(shapes::cube())), true).points(), 8u);
  EXPECT_EQ(countsOf(plain(twoBoxes({1, 1, 1}, {2, 2, 2})), true).points(), 15u);
  EXPECT_EQ(countsOf(plain(twoBoxes({1, 1, 0}, {2, 2, 1})), true).points(), 14u);
  EXPECT_EQ(countsOf(plain(twoBoxes({1, 0, 0}, {2, 1, 1})), true).points(), 12u);
  EXPECT_EQ(countsOf(plain(isolatedAmongDuplicates()), true).points(), 11u) << "isolated vertices stay alone";
  EXPECT_FALSE(weldedPolygons(plain(shapes::cube())));
}

TEST(Weld, IsChosenWhereItIsShorter) {
  const PolygonMesh sheet = plain(exploded(shapes::quadGrid(12, 9)));
  const size_t chosen = pack(sheet)->bytes.size();
  PackOptions options;
  for (const bool weld : {true, false}) {
    options.weld = weld;
    EXPECT_LE(chosen, pack(sheet, options)->bytes.size());
  }
  EXPECT_GT(countsOf(sheet, std::nullopt).welded, 0u);
  const PolygonMesh large = plain(exploded(shapes::quadGrid(40, 40)));
  EXPECT_GT(large.wedge_count, 5000u);
  EXPECT_GT(countsOf(large, std::nullopt).welded, 0u);
}

TEST(Weld, CostsLittleMoreThanTheMeshWithoutDuplicates) {
  const Shape grid = shapes::quadGrid(30, 30);
  EXPECT_LE(pack(plain(exploded(grid)))->bytes.size(), pack(plain(grid))->bytes.size() + 24);
}

/// A payload whose counts or sections are not what they were, with right checksums.
TEST(Weld, ForgedPayloadsAreHarmless) {
  const PolygonMesh mesh = withSeams(isolatedAmongDuplicates());
  const Outcome<Packed> packed = pack(mesh, exactly(true));
  ASSERT_TRUE(packed.ok());
  const PayloadView view = *parsePayload(packed->bytes);
  PayloadParts parts{view.counts, {}, {}};
  for (int s = 0; s < kSectionCount; ++s) {
    if (view.present[s]) parts.set(static_cast<Section>(s), {view.sections[s].begin(), view.sections[s].end()});
  }
  for (Index welded = 0; welded < view.counts.vertices; ++welded) {
    parts.counts.welded = welded;
    EXPECT_EQ(unpack(writePayload(parts)).ok(), welded == view.counts.welded) << welded;
  }
  parts.counts = view.counts;
  std::vector<uint8_t>& seams = parts.sections[static_cast<size_t>(Section::kSeams)];
  for (size_t bit = 0; bit < 8 * seams.size(); ++bit) {
    seams[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    if (const Outcome<PolygonMesh> out = unpack(writePayload(parts))) {
      EXPECT_EQ(out->polygons.vertex_count, mesh.polygons.vertex_count);
      for (const Index vertex : out->polygons.corners) ASSERT_LT(vertex, mesh.polygons.vertex_count);
      for (const Index wedge : out->wedges) ASSERT_LT(wedge, mesh.wedge_count);
    }
    seams[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
  }
}

TEST(KeepAttributes, JoinsWhatOnlyDroppedAttributesToldApart) {
  PolygonMesh mesh = withSeams(shapes::quadGrid(4, 3));
  const Index vertices = mesh.polygons.vertex_count;
  EXPECT_GT(mesh.wedge_count, vertices);
  const PolygonMesh before = mesh;
  keepAttributes(mesh, {});
  EXPECT_EQ(mesh.wedge_count, before.wedge_count);
  keepAttributes(mesh, {"POSITION"});
  EXPECT_EQ(mesh.wedge_count, vertices);
  ASSERT_EQ(mesh.attributes.size(), 1u);
  for (size_t c = 0; c < mesh.wedges.size(); ++c) {
    const auto at = [&](const PolygonMesh& m) { return &m.attributes[0].data[12 * m.wedges[c]]; };
    EXPECT_TRUE(std::equal(at(mesh), at(mesh) + 12, at(before)));
  }
  expectRoundTrip(mesh, exactly(std::nullopt));
}

TEST(KeepAttributes, LeavesIsolatedVerticesAlone) {
  PolygonMesh mesh = withSeams(isolatedAmongDuplicates());
  keepAttributes(mesh, {"TEXCOORD_0"});
  ASSERT_EQ(mesh.attributes.size(), 2u);
  keepAttributes(mesh, {"NORMAL"});
  EXPECT_EQ(mesh.wedge_count, mesh.polygons.vertex_count);
  expectRoundTrip(mesh, exactly(true));
}

}  // namespace
}  // namespace tutte
