#include "tests/codec/overlays.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace tutte::overlays {
namespace {

using shapes::Random;

void addTree(Index first, Index i, Index j, Random& random, std::vector<Index>& corners) {
  if (j - i < 2) return;
  const Index apex = i + 1 + random.below(j - i - 1);
  corners.insert(corners.end(), {first + i, first + apex, first + j});
  addTree(first, i, apex, random, corners);
  addTree(first, apex, j, random, corners);
}

void addFan(Index first, Index degree, Index apex, std::vector<Index>& corners) {
  for (Index i = 1; i + 1 < degree; ++i) {
    for (const Index local : {apex, apex + i, apex + i + 1}) corners.push_back(first + local % degree);
  }
}

void addList(const std::vector<Index>& polygon, Random& random, std::vector<Index>& corners) {
  const Index count = random.below(static_cast<Index>(polygon.size()) + 2);
  for (Index i = 0; i < 3 * count; ++i) corners.push_back(polygon[random.below(static_cast<Index>(polygon.size()))]);
}

}  // namespace

std::vector<Base> bases() {
  std::vector<shapes::Named> list = shapes::allShapes();
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const shapes::Shape sphere = shapes::randomTriangulation(60, seed);
    list.push_back({"merged" + std::to_string(seed), shapes::mergeFaces(sphere, 40, seed)});
    list.push_back({"torn" + std::to_string(seed), shapes::removeFaces(sphere, 30, seed)});
    list.push_back({"soup" + std::to_string(seed), shapes::soup(12, 20, 0, 6, seed)});
  }
  std::vector<Base> result;
  for (shapes::Named& named : list) {
    Result<Encoded> encoded = encode(named.shape.mesh);
    if (encoded) result.push_back({named.name, std::move(encoded->connectivity)});
  }
  return result;
}

std::vector<Index> colours(const Connectivity& mesh, Index colours, Index patch, uint64_t seed) {
  Random random(seed);
  std::vector<Index> result(mesh.face_degrees.size());
  Index colour = 0;
  for (Index& face : result) face = random.below(patch) == 0 ? colour = random.below(colours) : colour;
  return result;
}

std::vector<Index> wedgesByColour(const Connectivity& mesh, Index colour_count, Index patch, uint64_t seed) {
  std::vector<Index> wedges(mesh.umbrellas.size());
  if (colour_count == 0) {
    std::iota(wedges.begin(), wedges.end(), 0u);
    return wedges;
  }
  const std::vector<Index> colour = colours(mesh, colour_count, patch, seed);
  std::map<std::pair<Index, Index>, Index> wedge_of;
  Index corner = 0;
  for (Index face = 0; face < mesh.face_degrees.size(); ++face) {
    for (Index i = 0; i < mesh.face_degrees[face]; ++i, ++corner) {
      const auto key = std::pair(mesh.vertexOf(corner), colour[face]);
      wedges[corner] = wedge_of.try_emplace(key, static_cast<Index>(wedge_of.size())).first->second;
    }
  }
  return wedges;
}

Index countOf(const std::vector<Index>& values) { return values.empty() ? 0 : *std::ranges::max_element(values) + 1; }

std::vector<Index> randomRings(Index face_count, Index rarity, uint64_t seed) {
  Random random(seed);
  std::vector<Index> owners(face_count, kNone);
  std::vector<uint8_t> owns(face_count);
  for (Index face = 0; face < face_count; ++face) {
    const Index owner = random.below(face_count);
    if (random.below(rarity) != 0 || owns[face] || owner == face || owners[owner] != kNone) continue;
    owners[face] = owner;
    owns[owner] = 1;
  }
  return owners;
}

Triangulation triangles(const Connectivity& mesh, const std::vector<Index>& ring_owners, Style style, uint64_t seed) {
  Random random(seed);
  Triangulation result;
  std::vector<std::vector<Index>> polygons(mesh.face_degrees.size());
  Index corner = 0;
  for (Index face = 0; face < polygons.size(); ++face) {
    const Index owner = ring_owners.empty() || ring_owners[face] == kNone ? face : ring_owners[face];
    for (Index i = 0; i < mesh.face_degrees[face]; ++i) polygons[owner].push_back(corner++);
  }
  Index first = 0;
  for (Index face = 0; face < polygons.size(); ++face) {
    const Index degree = mesh.face_degrees[face];
    const size_t before = result.corners.size();
    const bool simple = polygons[face].size() == degree;
    const bool hole = !ring_owners.empty() && ring_owners[face] != kNone;
    if (!hole && polygons[face].size() >= 3) {
      if (!simple || style == Style::kLists)
        addList(polygons[face], random, result.corners);
      else if (style == Style::kTrees)
        addTree(first, 0, degree - 1, random, result.corners);
      else
        addFan(first, degree,
               style == Style::kFirstFans  ? 0
               : style == Style::kParallel ? 1
                                           : random.below(degree),
               result.corners);
    }
    result.counts.push_back(static_cast<Index>((result.corners.size() - before) / 3));
    first += degree;
  }
  return result;
}

std::vector<std::vector<std::array<Index, 3>>> normalised(const Triangulation& triangulation) {
  std::vector<std::vector<std::array<Index, 3>>> result;
  size_t next = 0;
  for (const Index count : triangulation.counts) {
    auto& list = result.emplace_back();
    for (Index i = 0; i < count; ++i, next += 3) {
      const Index* t = &triangulation.corners[next];
      list.push_back(std::min({std::array{t[0], t[1], t[2]}, {t[1], t[2], t[0]}, {t[2], t[0], t[1]}}));
    }
    std::ranges::sort(list);
  }
  return result;
}

}  // namespace tutte::overlays
