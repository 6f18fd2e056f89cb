// pack() and unpack(): everything a PolygonMesh holds comes back, in coded order.

#include "gltf_ext/pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "codec/bytes.h"
#include "codec/payload.h"
#include "tests/gltf/packed_mesh.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using shapes::Random;

template <class T>
Attribute attribute(std::string name, uint8_t components, ComponentType type, const std::vector<T>& values) {
  Attribute result{std::move(name), components, type, false, std::vector<uint8_t>(values.size() * sizeof(T))};
  if (!values.empty()) std::memcpy(result.data.data(), values.data(), result.data.size());
  return result;
}

/// Wedges by face colour, so that there are seams; groups, triangles and integer attributes, which pack without loss.
PolygonMesh decorate(const Polygons& polygons, uint64_t seed) {
  Random random(seed);
  PolygonMesh mesh;
  mesh.polygons = polygons;
  const size_t faces = polygons.face_degrees.size();
  mesh.group_count = faces > 1 ? 2 : 1;
  std::map<std::pair<Index, Index>, Index> wedge_of;
  std::vector<Index> vertex_of;
  size_t corner = 0;
  for (size_t face = 0; face < faces; ++face) {
    mesh.groups.push_back(random.below(mesh.group_count));
    const Index degree = polygons.face_degrees[face], colour = random.below(3),
                apex = degree ? random.below(degree) : 0;
    mesh.triangulation.counts.push_back(degree < 3 ? 0 : degree - 2);
    for (Index i = 1; i + 1 < degree; ++i) {
      for (const Index k : {apex, apex + i, apex + i + 1}) {
        mesh.triangulation.corners.push_back(static_cast<Index>(corner) + k % degree);
      }
    }
    for (Index i = 0; i < degree; ++i, ++corner) {
      const auto key = std::pair(polygons.corners[corner], colour);
      const auto [entry, is_new] = wedge_of.try_emplace(key, static_cast<Index>(wedge_of.size()));
      if (is_new) vertex_of.push_back(key.first);
      mesh.wedges.push_back(entry->second);
    }
  }
  for (Index vertex = 0; vertex < polygons.vertex_count; ++vertex) {
    if (std::ranges::find(polygons.corners, vertex) == polygons.corners.end()) vertex_of.push_back(vertex);
  }
  mesh.wedge_count = static_cast<Index>(vertex_of.size());
  std::vector<uint16_t> positions, ids;
  for (const Index vertex : vertex_of) {
    for (const Index value : {vertex, vertex * 7 % 1000, vertex * vertex % 1000}) {
      positions.push_back(static_cast<uint16_t>(value));
    }
    ids.push_back(static_cast<uint16_t>(random.below(5)));
  }
  mesh.attributes.push_back(attribute("POSITION", 3, ComponentType::kUint16, positions));
  mesh.attributes.push_back(attribute("_ID", 1, ComponentType::kUint16, ids));
  return mesh;
}

TEST(Pack, EveryShapeComesBackWithAllThatItCarries) {
  uint64_t seed = 0;
  for (const shapes::Named& named : shapes::allShapes()) {
    SCOPED_TRACE(named.name);
    PolygonMesh mesh = decorate(named.shape.mesh, ++seed);
    expectRoundTrip(mesh);
    mesh.attributes.clear();
    expectRoundTrip(mesh);
  }
}

TEST(Pack, MeshesWithoutAnythingElse) {
  for (const shapes::Named& named : shapes::allShapes()) {
    SCOPED_TRACE(named.name);
    PolygonMesh mesh;
    mesh.polygons = named.shape.mesh;
    mesh.wedge_count = mesh.polygons.vertex_count;
    mesh.triangulation = fanTriangulation(mesh.polygons, {});
    // Which corner the default fan starts at is not kept.
    const Outcome<Packed> packed = pack(mesh);
    ASSERT_TRUE(packed.ok());
    const Outcome<PolygonMesh> out = unpack(packed->bytes);
    ASSERT_TRUE(out.ok());
    expectSame(mesh, *packed, *out);
  }
}

PolygonMesh plateWithHole() {
  PolygonMesh mesh;
  mesh.polygons.face_degrees = {4, 4, 4};
  mesh.polygons.corners = {0, 1, 2, 3, 7, 6, 5, 4, 4, 5, 6, 7};  // a square, its hole, and a square in the hole
  mesh.polygons.vertex_count = mesh.wedge_count = 8;
  mesh.ring_owners = {kNone, 0, kNone};
  mesh.triangulation.counts = {8, 0, 2};
  mesh.triangulation.corners = {0, 1, 7, 1, 6, 7, 1, 2, 6, 2, 5, 6,  2, 3,  5,
                                3, 4, 5, 3, 0, 4, 0, 7, 4, 8, 9, 10, 8, 10, 11};
  return mesh;
}

TEST(Pack, PolygonsWithHoles) {
  expectRoundTrip(plateWithHole());
  PolygonMesh untriangulated = plateWithHole();
  untriangulated.triangulation = {};
  const std::vector<uint16_t> positions = {0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0, 3, 3, 0, 6, 3, 0, 6, 6, 0, 3, 6, 0};
  untriangulated.attributes = {attribute("POSITION", 3, ComponentType::kUint16, positions)};
  const Outcome<Packed> packed = pack(untriangulated);
  ASSERT_TRUE(packed.ok());
  const Outcome<PolygonMesh> out = unpack(packed->bytes);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->triangulation.corners.size(), 30u);
}

TEST(Pack, ChoosesTrianglesThatCostNothing) {
  PolygonMesh mesh;
  const shapes::Shape grid = shapes::quadGrid(20, 20);
  mesh.polygons = grid.mesh;
  mesh.wedge_count = mesh.polygons.vertex_count;
  std::vector<float> positions;
  for (const shapes::Position& p : grid.positions) positions.insert(positions.end(), p.begin(), p.end());
  mesh.attributes = {attribute("POSITION", 3, ComponentType::kFloat, positions)};
  const Outcome<Packed> packed = pack(mesh);
  ASSERT_TRUE(packed.ok());
  const Result<PayloadView> view = parsePayload(packed->bytes);
  ASSERT_TRUE(view.ok());
  EXPECT_FALSE(view->has(Section::kTriangulation));
}

TEST(Pack, RefusesMeshesThatContradictThemselves) {
  const PolygonMesh good = decorate(shapes::cube().mesh, 1);
  ASSERT_TRUE(pack(good).ok());
  const auto refused = [&](auto&& change) {
    PolygonMesh mesh = good;
    change(mesh);
    return !pack(mesh).ok();
  };
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.polygons.corners[0] = 8; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.polygons.face_degrees[0] = 5; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.wedges[0] = m.wedge_count; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.wedges.pop_back(); }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.wedges.clear(); }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { std::ranges::fill(m.wedges, 0u); }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.groups[0] = 2; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.group_count = 7; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.group_count = 0; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.ring_owners = {0, kNone}; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.ring_owners = {0, kNone, kNone, kNone, kNone, kNone}; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.triangulation.corners[0] = 24; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.triangulation.corners.pop_back(); }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.attributes[1].data.pop_back(); }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.attributes[0].name = "NORMAL"; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.attributes[1].components = 5; }));
  EXPECT_TRUE(refused([](PolygonMesh& m) { m.wedge_count += 1, m.attributes.clear(); }));
  EXPECT_TRUE(refused([](PolygonMesh& m) {
    for (size_t i = 0; i < m.attributes[0].data.size(); ++i) m.attributes[0].data[i] = static_cast<uint8_t>(i * 37);
  })) << "wedges of one vertex at different places";
}

TEST(Unpack, NoticesEveryFlippedBitAndTruncation) {
  const Outcome<Packed> packed = pack(decorate(shapes::dodecahedron().mesh, 5));
  ASSERT_TRUE(packed.ok());
  std::vector<uint8_t> bytes = packed->bytes;
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    EXPECT_FALSE(unpack(bytes).ok()) << "bit " << bit;
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
  }
  for (size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(unpack(cut).ok());
  }
}

/// The payload again, with one byte of one section changed and the checksums made right.
std::vector<uint8_t> forged(const PayloadView& view, Section section, size_t at, uint8_t change, int count_change) {
  PayloadParts parts;
  parts.counts = view.counts;
  for (int s = 0; s < kSectionCount; ++s) {
    if (view.present[s]) parts.set(static_cast<Section>(s), {view.sections[s].begin(), view.sections[s].end()});
  }
  auto& bytes = parts.sections[static_cast<size_t>(section)];
  if (at < bytes.size()) bytes[at] ^= change;
  Index* counts[] = {nullptr,
                     &parts.counts.vertices,
                     &parts.counts.wedges,
                     &parts.counts.faces,
                     &parts.counts.corners,
                     &parts.counts.triangles,
                     &parts.counts.groups,
                     &parts.counts.attributes};
  if (count_change > 0) ++*counts[count_change];
  if (count_change < 0) --*counts[-count_change];
  return writePayload(parts);
}

void expectSound(const PolygonMesh& mesh) {
  for (const Index vertex : mesh.polygons.corners) ASSERT_LT(vertex, mesh.polygons.vertex_count);
  for (const Index wedge : mesh.wedges) ASSERT_LT(wedge, mesh.wedge_count);
  for (const Index group : mesh.groups) ASSERT_LT(group, mesh.group_count);
  for (const Index corner : mesh.triangulation.corners) ASSERT_LT(corner, mesh.polygons.corners.size());
  for (const Attribute& a : mesh.attributes) ASSERT_EQ(a.data.size(), size_t{mesh.wedge_count} * a.stride());
}

TEST(Unpack, ForgedSectionsAreHarmless) {
  PolygonMesh holes = plateWithHole();
  for (const PolygonMesh& mesh : {decorate(shapes::cube().mesh, 3), holes, decorate(shapes::quadGrid(4, 4).mesh, 2)}) {
    const Outcome<Packed> packed = pack(mesh);
    ASSERT_TRUE(packed.ok());
    const Result<PayloadView> view = parsePayload(packed->bytes);
    ASSERT_TRUE(view.ok());
    for (int s = 0; s < kSectionCount; ++s) {
      for (size_t bit = 0; bit < 8 * view->sections[s].size(); ++bit) {
        const Outcome<PolygonMesh> out =
            unpack(forged(*view, static_cast<Section>(s), bit / 8, static_cast<uint8_t>(1 << bit % 8), 0));
        if (out) expectSound(*out);
      }
    }
    for (const int count : {1, 3, 4, 5, -1, -3, -4, -5}) {
      EXPECT_FALSE(unpack(forged(*view, Section::kConnectivity, ~size_t{0}, 0, count)).ok()) << count;
    }
  }
}

TEST(Unpack, HoldsTheCallersLimits) {
  const Outcome<Packed> packed = pack(decorate(shapes::cube().mesh, 1));
  ASSERT_TRUE(packed.ok());
  EXPECT_TRUE(unpack(packed->bytes, {8, 6, 24}).ok());
  EXPECT_FALSE(unpack(packed->bytes, {7, 6, 24}).ok());
  EXPECT_FALSE(unpack(packed->bytes, {8, 5, 24}).ok());
  EXPECT_FALSE(unpack(packed->bytes, {8, 6, 23}).ok());
}

}  // namespace
}  // namespace tutte
