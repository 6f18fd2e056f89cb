// The arrays of the extension, checked by reading them as a loader would.

#include "codec/arrays.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/codec/overlays.h"

namespace tutte {
namespace {

using overlays::Style;

/// A mesh whose wedges are its vertices.
struct Sample {
  Polygons polygons;
  std::vector<Index> groups, owners;
  Index group_count = 1;
  Triangulation triangulation;

  ArraySource source() const {
    return {polygons, {}, polygons.vertex_count, groups, group_count, owners, triangulation};
  }
};

Sample sample(const Connectivity& mesh, Index group_count, Index ring_rarity, Style style) {
  Sample result;
  result.polygons = polygonsOf(mesh);
  result.group_count = group_count;
  result.groups = overlays::colours(mesh, group_count, 3, 1);
  if (ring_rarity != 0) {
    result.owners = overlays::randomRings(static_cast<Index>(mesh.face_degrees.size()), ring_rarity, 2);
    for (size_t face = 0; face < result.owners.size(); ++face) {
      if (result.owners[face] != kNone) result.groups[face] = result.groups[result.owners[face]];
    }
  }
  result.triangulation = overlays::triangles(mesh, result.owners, style, 3);
  return result;
}

std::vector<Index> slice(const DerivedArray& array, Index group) {
  return {array.values.begin() + array.group_starts[group], array.values.begin() + array.group_starts[group + 1]};
}

/// The rings of every polygon of a group, in the order of the arrays, straight from the mesh.
std::vector<std::vector<std::vector<Index>>> expectedRings(const Sample& s, Index group) {
  std::vector<std::vector<Index>> faces;
  size_t corner = 0;
  for (const Index degree : s.polygons.face_degrees) {
    auto& face = faces.emplace_back();
    while (face.size() < degree) face.push_back(s.polygons.corners[corner++]);
  }
  std::vector<std::vector<std::vector<Index>>> result;
  for (Index face = 0; face < faces.size(); ++face) {
    if (s.groups[face] != group || (!s.owners.empty() && s.owners[face] != kNone)) continue;
    auto& rings = result.emplace_back(1, faces[face]);
    for (Index hole = 0; hole < s.owners.size(); ++hole) {
      if (s.owners[hole] == face) rings.push_back(faces[hole]);
    }
  }
  return result;
}

/// Reads a group's loops as EXT_mesh_polygon says.
std::vector<std::vector<std::vector<Index>>> readRings(const std::vector<Index>& loops,
                                                       const std::vector<Index>& offsets) {
  std::vector<std::vector<std::vector<Index>>> result;
  for (size_t n = 0; n < offsets.size(); ++n) {
    const size_t end = n + 1 < offsets.size() ? offsets[n + 1] - 1 : loops.size();
    auto& rings = result.emplace_back(1);
    for (size_t i = offsets[n]; i < end; ++i) {
      if (loops[i] == kNone)
        rings.emplace_back();
      else
        rings.back().push_back(loops[i]);
    }
    EXPECT_TRUE(n + 1 == offsets.size() || loops[end] == kNone);
  }
  return result;
}

TEST(Arrays, LoopsHoldEveryRing) {
  for (const overlays::Base& base : overlays::bases()) {
    SCOPED_TRACE(base.name);
    for (const Index rarity : {0u, 3u}) {
      const Sample s = sample(base.mesh, 3, rarity, Style::kFans);
      const DerivedArray loops = polygonLoops(s.source());
      const DerivedArray offsets = polygonLoopOffsets(s.source());
      const DerivedArray degrees = ringDegrees(s.source());
      for (Index g = 0; g < 3; ++g) {
        const auto expected = expectedRings(s, g);
        EXPECT_EQ(readRings(slice(loops, g), slice(offsets, g)), expected);
        std::vector<Index> expected_degrees;
        for (const auto& polygon : expected) {
          for (const auto& ring : polygon) expected_degrees.push_back(static_cast<Index>(ring.size()));
        }
        EXPECT_EQ(slice(degrees, g), expected_degrees);
      }
    }
  }
}

using Triangles = std::vector<std::array<Index, 3>>;

Triangles normal(const std::vector<Index>& indices, size_t begin, size_t end) {
  Triangles result;
  for (size_t i = begin; i < end; i += 3) {
    const Index a = indices[i], b = indices[i + 1], c = indices[i + 2];
    result.push_back(std::min({std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}));
  }
  std::ranges::sort(result);
  return result;
}

TEST(Arrays, TrianglesAreThePolygonsOwn) {
  for (const overlays::Base& base : overlays::bases()) {
    SCOPED_TRACE(base.name);
    for (const Style style : {Style::kFirstFans, Style::kFans, Style::kTrees, Style::kLists}) {
      const Sample s = sample(base.mesh, 2, 5, style);
      const TriangleArray triangles = triangleIndices(s.source());
      const DerivedArray offsets = polygonIndexOffsets(s.source());
      std::vector<Index> wedges;
      for (const Index corner : s.triangulation.corners) wedges.push_back(s.polygons.corners[corner]);
      for (Index g = 0; g < 2; ++g) {
        const std::vector<Index> indices = slice(triangles, g), starts = slice(offsets, g);
        size_t polygon = 0, first = 0;
        for (Index face = 0; face < s.groups.size(); ++face) {
          const size_t end = first + 3 * s.triangulation.counts[face];
          if (s.groups[face] == g && (s.owners.empty() || s.owners[face] == kNone)) {
            const size_t stop = polygon + 1 < starts.size() ? starts[polygon + 1] : indices.size();
            EXPECT_EQ(normal(indices, starts[polygon], stop), normal(wedges, first, end));
            ++polygon;
          }
          first = end;
        }
        EXPECT_EQ(polygon, starts.size());
      }
    }
  }
}

/// Polygons as a reader of FB_ngon_encoding finds them, each as a cycle that starts at its smallest wedge.
std::vector<std::vector<Index>> readNgons(const std::vector<Index>& indices) {
  std::vector<std::vector<Index>> result;
  for (size_t i = 0; i < indices.size(); i += 3) {
    const bool same = i > 0 && indices[i] == indices[i - 3];
    if (!same) result.push_back({indices[i], indices[i + 1]});
    EXPECT_TRUE(!same || indices[i + 1] == result.back().back());
    result.back().push_back(indices[i + 2]);
  }
  return result;
}

std::vector<Index> fromSmallest(std::vector<Index> cycle) {
  std::ranges::rotate(cycle, std::ranges::min_element(cycle));
  return cycle;
}

TEST(Arrays, NgonEncodingIsClaimedOnlyWhereItHolds) {
  int held = 0;
  for (const overlays::Base& base : overlays::bases()) {
    SCOPED_TRACE(base.name);
    for (const Style style : {Style::kFirstFans, Style::kFans, Style::kTrees}) {
      const Sample s = sample(base.mesh, 2, 0, style);
      const TriangleArray triangles = triangleIndices(s.source());
      for (Index g = 0; g < 2; ++g) {
        if (!triangles.ngon_encoding[g]) continue;
        ++held;
        const auto expected = expectedRings(s, g);
        const auto found = readNgons(slice(triangles, g));
        ASSERT_EQ(found.size(), expected.size());
        for (size_t i = 0; i < found.size(); ++i) {
          // A wedge that a polygon has twice may come first in either place.
          std::vector<Index> a = found[i], b = expected[i][0];
          std::ranges::sort(a);
          std::ranges::sort(b);
          EXPECT_EQ(a, b);
          if (std::ranges::adjacent_find(b) != b.end()) continue;
          EXPECT_EQ(fromSmallest(found[i]), fromSmallest(expected[i][0]));
        }
      }
    }
  }
  EXPECT_GT(held, 100);
}

TEST(Arrays, NgonEncodingHoldsForCleanFans) {
  for (const shapes::Named& named : shapes::cleanShapes()) {
    const Sample s = sample(encode(named.shape.mesh)->connectivity, 1, 0, Style::kFirstFans);
    const bool simple = std::ranges::all_of(s.polygons.face_degrees, [](Index d) { return d == 3 || d == 4; });
    EXPECT_TRUE(!simple || triangleIndices(s.source()).ngon_encoding[0]) << named.name;
  }
}

TEST(Arrays, WeldNamesTheFirstWedgeOfEachVertex) {
  const Connectivity mesh = encode(shapes::cube().mesh)->connectivity;
  Sample s = sample(mesh, 1, 0, Style::kFans);
  std::vector<Index> wedges(24);
  for (Index c = 0; c < 24; ++c) wedges[c] = 3 * s.polygons.corners[c] + c / 4 % 3;
  ArraySource source = s.source();
  source.wedges = wedges;
  source.wedge_count = 24;
  const DerivedArray weld = weldedWedges(source);
  for (Index c = 0; c < 24; ++c) {
    EXPECT_EQ(weld.values[wedges[c]] / 3, s.polygons.corners[c]);
    EXPECT_LE(weld.values[wedges[c]], wedges[c]);
  }
  EXPECT_EQ(weld.group_starts, (std::vector<Index>{0, 24}));
}

TEST(Arrays, PacksIndicesBySize) {
  using Bytes = std::vector<uint8_t>;
  const std::vector<Index> values = {1, 254, kNone};
  EXPECT_EQ(*packIndices(values, 1), (Bytes{1, 254, 255}));
  EXPECT_EQ(*packIndices(values, 2), (Bytes{1, 0, 254, 0, 255, 255}));
  EXPECT_EQ(*packIndices(values, 4), (Bytes{1, 0, 0, 0, 254, 0, 0, 0, 255, 255, 255, 255}));
  EXPECT_EQ(packIndices(std::vector<Index>{255}, 1).error(), Error::kTooLarge);
  EXPECT_EQ(packIndices(std::vector<Index>{65535}, 2).error(), Error::kTooLarge);
  EXPECT_EQ(packIndices(values, 3).error(), Error::kCountMismatch);
}

}  // namespace
}  // namespace tutte
