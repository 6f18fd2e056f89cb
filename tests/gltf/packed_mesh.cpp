#include "tests/gltf/packed_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

namespace tutte {
namespace {

std::vector<std::array<Index, 3>> trianglesOf(const PolygonMesh& mesh, const std::vector<Index>& name) {
  const Triangulation triangulation =
      mesh.triangulation.counts.empty() ? fanTriangulation(mesh.polygons, {}) : mesh.triangulation;
  std::vector<std::array<Index, 3>> result;
  for (size_t i = 0; i < triangulation.corners.size(); i += 3) {
    const auto at = [&](size_t k) {
      return name.empty() ? triangulation.corners[i + k] : name[triangulation.corners[i + k]];
    };
    result.push_back(std::min({std::array{at(0), at(1), at(2)}, {at(1), at(2), at(0)}, {at(2), at(0), at(1)}}));
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace

void expectSame(const PolygonMesh& in, const Packed& packed, const PolygonMesh& out) {
  ASSERT_EQ(out.polygons.corners.size(), in.polygons.corners.size());
  ASSERT_EQ(out.wedge_count, in.wedge_count);
  ASSERT_EQ(out.polygons.vertex_count, in.polygons.vertex_count);
  ASSERT_EQ(packed.wedge_order.size(), in.wedge_count);
  std::map<Index, Index> vertex_of, coded_of;
  for (Index corner = 0; corner < out.polygons.corners.size(); ++corner) {
    const Index source = packed.corner_order[corner];
    EXPECT_EQ(packed.wedge_order[out.wedgeOf(corner)], in.wedgeOf(source));
    const auto vertex = vertex_of.try_emplace(out.polygons.corners[corner], in.polygons.corners[source]).first;
    EXPECT_EQ(vertex->second, in.polygons.corners[source]);
    const auto coded = coded_of.try_emplace(in.polygons.corners[source], out.polygons.corners[corner]).first;
    EXPECT_EQ(coded->second, out.polygons.corners[corner]);
  }
  size_t corner = 0;
  std::vector<size_t> first(in.polygons.face_degrees.size() + 1);
  for (size_t f = 0; f + 1 < first.size(); ++f) first[f + 1] = first[f] + in.polygons.face_degrees[f];
  for (size_t face = 0; face < out.polygons.face_degrees.size(); ++face) {
    const Index source = packed.face_order[face], degree = out.polygons.face_degrees[face];
    ASSERT_EQ(degree, in.polygons.face_degrees[source]);
    for (Index i = 0; i < degree; ++i) {
      const Index here = packed.corner_order[corner + i], there = packed.corner_order[corner + (i + 1) % degree];
      EXPECT_EQ(there - first[source], (here - first[source] + 1) % degree) << "a face lost its orientation";
    }
    if (!in.groups.empty() && in.group_count > 1) {
      EXPECT_EQ(out.groups[face], in.groups[source]);
    }
    if (!in.ring_owners.empty()) {
      const Index owner = out.ring_owners[face];
      EXPECT_EQ(owner == kNone ? kNone : packed.face_order[owner], in.ring_owners[source]);
    }
    corner += degree;
  }
  if (!in.triangulation.counts.empty()) {
    EXPECT_EQ(trianglesOf(out, packed.corner_order), trianglesOf(in, {}));
  }
  ASSERT_EQ(out.attributes.size(), in.attributes.size());
  for (size_t slot = 0; slot < in.attributes.size(); ++slot) {
    const Attribute &a = in.attributes[slot], &b = out.attributes[slot];
    EXPECT_EQ(a.name, b.name);
    for (Index wedge = 0; wedge < in.wedge_count; ++wedge) {
      EXPECT_EQ(0,
                std::memcmp(&a.data[packed.wedge_order[wedge] * a.stride()], &b.data[wedge * a.stride()], a.stride()));
    }
  }
}

void expectRoundTrip(const PolygonMesh& mesh, const PackOptions& options) {
  const Outcome<Packed> packed = pack(mesh, options);
  ASSERT_TRUE(packed.ok()) << packed.error().where << ": " << packed.error().what;
  const Outcome<PolygonMesh> out = unpack(packed->bytes);
  ASSERT_TRUE(out.ok()) << out.error().where << ": " << out.error().what;
  expectSame(mesh, *packed, *out);
  const Outcome<PolygonMesh> topology = unpackTopology(packed->bytes);
  ASSERT_TRUE(topology.ok());
  EXPECT_EQ(topology->wedges, out->wedges);
  EXPECT_TRUE(topology->attributes.empty());
}

}  // namespace tutte
