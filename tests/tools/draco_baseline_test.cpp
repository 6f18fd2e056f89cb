#include "tools/draco_baseline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/shapes/shapes.h"
#include "tests/tools/scratch.h"
#include "tools/import.h"

namespace tutte {
namespace {

constexpr uint64_t kDracoHeader = 11;

template <class Value>
Attribute floats(const char* name, int components, Index count, Value value) {
  Attribute attribute;
  attribute.name = name;
  attribute.components = static_cast<uint8_t>(components);
  attribute.data.resize(size_t{count} * attribute.stride());
  for (Index i = 0; i < count * static_cast<Index>(components); ++i) {
    const float number = static_cast<float>(value(i / components, i % components));
    std::memcpy(&attribute.data[4 * i], &number, 4);
  }
  return attribute;
}

/// Positions are the shape's own, or invented ones that differ from vertex to vertex.
PolygonMesh meshOf(const shapes::Shape& shape) {
  PolygonMesh mesh;
  mesh.polygons = shape.mesh;
  mesh.wedge_count = shape.mesh.vertex_count;
  mesh.attributes.push_back(floats("POSITION", 3, mesh.wedge_count, [&](Index v, int c) {
    return shape.positions.empty() ? std::sin(1.3 * v + c) : double{shape.positions[v][c]};
  }));
  return mesh;
}

struct Way {
  DracoInput input = DracoInput::kTriangles;
  int level = 10;
  int runs = 1;
};

DracoFigures figuresOf(const PolygonMesh& mesh, const PackOptions& options = {}, const Way& way = {}) {
  DracoBaseline baseline(mesh, options, way.input, way.level);
  for (int run = 0; run < way.runs; ++run) {
    const Outcome<Done> done = baseline.run();
    EXPECT_TRUE(done) << done.error().what;
  }
  return baseline.figures();
}

Outcome<Done> tryOut(const PolygonMesh& mesh, DracoInput input = DracoInput::kTriangles, int level = 10) {
  return DracoBaseline(mesh, {}, input, level).run();
}

constexpr Way kKeepPolygons{DracoInput::kPolygons, 10, 1};

TEST(DracoBaseline, BytesAddUpAndTimesAreTaken) {
  const PolygonMesh mesh = meshOf(shapes::quadTorus(40, 30));
  for (const int level : {7, 10}) {
    const DracoFigures figures = figuresOf(mesh, {}, {DracoInput::kTriangles, level, 2});
    EXPECT_EQ(figures.total_bytes, kDracoHeader + figures.connectivity_bytes + figures.attribute_bytes);
    EXPECT_GT(figures.connectivity_bytes, 0u);
    EXPECT_GT(figures.attribute_bytes, figures.connectivity_bytes);
    EXPECT_GT(figures.connectivity_encode_seconds, 0);
    EXPECT_GT(figures.connectivity_decode_seconds, 0);
    EXPECT_GE(figures.encode_seconds, figures.connectivity_encode_seconds);
    EXPECT_GE(figures.decode_seconds, figures.connectivity_decode_seconds);
  }
}

TEST(DracoBaseline, BytesDoNotDependOnRepetitions) {
  const PolygonMesh mesh = meshOf(shapes::sponge(1));
  const DracoFigures once = figuresOf(mesh);
  const DracoFigures often = figuresOf(mesh, {}, {DracoInput::kTriangles, 10, 3});
  EXPECT_EQ(once.total_bytes, often.total_bytes);
  EXPECT_EQ(once.connectivity_bytes, often.connectivity_bytes);
}

TEST(DracoBaseline, EqualPositionsAreWelded) {
  const shapes::Shape shape = shapes::quadTorus(20, 20);
  PolygonMesh welded = meshOf(shape), cut = welded;
  // Every corner becomes a vertex of its own.
  const Index corners = static_cast<Index>(cut.polygons.corners.size());
  cut.attributes[0] =
      floats("POSITION", 3, corners, [&](Index w, int c) { return shape.positions[shape.mesh.corners[w]][c]; });
  for (Index c = 0; c < corners; ++c) cut.polygons.corners[c] = c;
  cut.polygons.vertex_count = cut.wedge_count = corners;
  EXPECT_EQ(figuresOf(welded).total_bytes, figuresOf(cut).total_bytes);
}

TEST(DracoBaseline, FewerBitsTakeFewerBytes) {
  const PolygonMesh mesh = meshOf(shapes::quadTorus(30, 30));
  const uint64_t coarse = figuresOf(mesh, {.position_bits = 8}).attribute_bytes;
  const uint64_t fine = figuresOf(mesh, {.position_bits = 16}).attribute_bytes;
  const uint64_t exact = figuresOf(mesh, {.position_bits = 0}).attribute_bytes;
  EXPECT_LT(coarse, fine);
  EXPECT_LT(fine, exact);
}

TEST(DracoBaseline, PolygonsCostMoreThanTriangles) {
  const PolygonMesh mesh = meshOf(shapes::mergeFaces(shapes::randomTriangulation(500, 3), 300, 4));
  EXPECT_GT(figuresOf(mesh, {}, kKeepPolygons).total_bytes, figuresOf(mesh).total_bytes);
  const PolygonMesh big_face = meshOf(shapes::prism(40));
  EXPECT_TRUE(tryOut(big_face, DracoInput::kPolygons).ok());
}

TEST(DracoBaseline, ConnectivityAloneIsTheSameConnectivity) {
  const PolygonMesh mesh = meshOf(shapes::randomTriangulation(500, 3));
  const DracoFigures all = figuresOf(mesh), alone = figuresOf(mesh, {}, {DracoInput::kConnectivity, 10, 1});
  EXPECT_EQ(alone.connectivity_bytes, all.connectivity_bytes);
  EXPECT_LT(alone.attribute_bytes, 64u);
}

TEST(DracoBaseline, GivenTriangulationIsUsed) {
  PolygonMesh mesh = meshOf(shapes::quadGrid(12, 12));
  const uint64_t fans = figuresOf(mesh).total_bytes;
  shapes::Random random(8);
  for (Index face = 0; face < mesh.polygons.face_degrees.size(); ++face) {
    const Index first = 4 * face, turn = random.below(2);
    mesh.triangulation.counts.push_back(2);
    for (const Index corner : {0u, 1u, 2u, 0u, 2u, 3u})
      mesh.triangulation.corners.push_back(first + (corner + turn) % 4);
  }
  EXPECT_NE(figuresOf(mesh).connectivity_bytes, 0u);
  EXPECT_NE(figuresOf(mesh).total_bytes, fans);
}

TEST(DracoBaseline, AllKindsOfAttributes) {
  PolygonMesh mesh = meshOf(shapes::quadTorus(10, 10));
  const Index count = mesh.wedge_count;
  const auto wave = [](Index w, int c) { return std::sin(0.1 * w + c); };
  mesh.attributes.push_back(floats("NORMAL", 3, count, [](Index w, int c) {
    return c == 2 ? 0 : c ? std::sin(w) : std::cos(w);
  }));
  mesh.attributes.push_back(floats("TANGENT", 4, count, wave));
  mesh.attributes.push_back(floats("TEXCOORD_0", 2, count, wave));
  mesh.attributes.push_back(floats("COLOR_0", 4, count, wave));
  mesh.attributes.push_back(floats("WEIGHTS_0", 4, count, wave));
  mesh.attributes.push_back(floats("POSITION@0", 3, count, wave));
  Attribute joints;
  joints.name = "JOINTS_0";
  joints.components = 4;
  joints.type = ComponentType::kUint16;
  joints.data.resize(size_t{count} * joints.stride(), 3);
  mesh.attributes.push_back(joints);
  EXPECT_GT(figuresOf(mesh).attribute_bytes, figuresOf(meshOf(shapes::quadTorus(10, 10))).attribute_bytes);
}

uint64_t bytesOf(const DracoFigures& figures, const std::string& name) {
  for (const auto& [attribute, bytes] : figures.by_attribute) {
    if (attribute == name) return bytes;
  }
  ADD_FAILURE() << name;
  return 0;
}

TEST(DracoBaseline, BytesBySeamsAndByAttribute) {
  PolygonMesh plain = meshOf(shapes::quadTorus(24, 24));
  const Index vertices = plain.wedge_count;
  plain.attributes.push_back(floats("TEXCOORD_0", 2, vertices, [](Index v, int c) { return c ? v % 24 : v / 24; }));
  // Every second quad has texture coordinates of its own.
  PolygonMesh cut = plain;
  cut.wedges = cut.polygons.corners;
  for (Index c = 0; c < cut.wedges.size(); ++c) {
    if (c / 4 % 2) cut.wedges[c] = cut.wedge_count++;
  }
  std::vector<Index> source(cut.wedge_count);
  for (Index c = 0; c < cut.wedges.size(); ++c) source[cut.wedges[c]] = cut.polygons.corners[c];
  const auto position = [&](Index w, int c) {
    return reinterpret_cast<const float*>(plain.attributes[0].data.data())[3 * source[w] + c];
  };
  cut.attributes[0] = floats("POSITION", 3, cut.wedge_count, position);
  cut.attributes[1] = floats("TEXCOORD_0", 2, cut.wedge_count, [&](Index w, int c) { return w + 7 * c; });

  const DracoFigures smooth = figuresOf(plain), torn = figuresOf(cut);
  EXPECT_LT(smooth.seam_bytes, 20u);
  EXPECT_GT(torn.seam_bytes, 50u);
  EXPECT_EQ(torn.connectivity_bytes - torn.seam_bytes, smooth.connectivity_bytes - smooth.seam_bytes);
  EXPECT_EQ(bytesOf(torn, "POSITION"), bytesOf(smooth, "POSITION"));
  EXPECT_GT(bytesOf(torn, "TEXCOORD_0"), bytesOf(smooth, "TEXCOORD_0"));
  const DracoFigures polygons = figuresOf(cut, {}, kKeepPolygons);
  uint64_t sum = 0;
  for (const auto& [name, bytes] : polygons.by_attribute) sum += bytes;
  EXPECT_GT(bytesOf(polygons, "added_edges"), 0u);
  EXPECT_LE(sum, polygons.attribute_bytes);
  EXPECT_GE(sum + 64, polygons.attribute_bytes);
}

TEST(DracoBaseline, EveryShapeIsMeasuredOrRefused) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    const PolygonMesh mesh = meshOf(shape);
    for (const auto& outcome :
         {tryOut(mesh, DracoInput::kTriangles, 7), tryOut(mesh), tryOut(mesh, DracoInput::kPolygons)}) {
      if (!outcome.ok()) {
        EXPECT_EQ(outcome.error().kind, FailureKind::kUnsupported);
        EXPECT_FALSE(outcome.error().what.empty());
      }
    }
  }
}

TEST(DracoBaseline, NothingToTriangulateIsRefused) {
  EXPECT_FALSE(tryOut(PolygonMesh{}).ok());
  PolygonMesh degenerate = meshOf(shapes::tetrahedron());
  degenerate.polygons.corners.assign(degenerate.polygons.corners.size(), 0);
  const auto outcome = tryOut(degenerate);
  ASSERT_FALSE(outcome.ok());
  EXPECT_NE(outcome.error().what.find("degenerate"), std::string::npos) << outcome.error().what;
}

/// Bytes of draco_encoder -qp 11 --skip TEX_COORD --skip NORMAL, with -cl 7, -cl 10, and -cl 10 -preserve_polygons
/// (0: not compared).
struct Known {
  const char* file;
  uint64_t cl7, cl10, polygons;
};

TEST(DracoBaseline, AgreesWithDracosOwnCommand) {
  const std::filesystem::path folder = corpusFolder();
  if (folder.empty()) GTEST_SKIP() << "no corpus: set TUTTE_CORPUS to its folder";
  PackOptions options;
  options.position_bits = 11;
  for (const Known& known : {Known{"polygon/beast.obj", 42243, 37173, 60878}, Known{"triangle/spot.obj", 6551, 6139, 0},
                             Known{"paper-triangle/bunny_34835.off", 48687, 42728, 0}}) {
    SCOPED_TRACE(known.file);
    auto imported = importScene(folder / known.file);
    ASSERT_TRUE(imported.ok()) << imported.error().what;
    ASSERT_EQ(imported->scene.meshes.size(), 1u);
    PolygonMesh& mesh = imported->scene.meshes[0].mesh;
    mesh.attributes.resize(1);
    EXPECT_EQ(figuresOf(mesh, options, {DracoInput::kTriangles, 7, 1}).total_bytes, known.cl7);
    EXPECT_EQ(figuresOf(mesh, options).total_bytes, known.cl10);
    if (known.polygons == 0) continue;
    EXPECT_EQ(figuresOf(mesh, options, kKeepPolygons).total_bytes, known.polygons);
  }
}

}  // namespace
}  // namespace tutte
