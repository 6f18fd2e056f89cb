#include "tests/gltf/assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "gltf_ext/accessors.h"

namespace tutte {
namespace {

template <class T>
Bytes bytesOf(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// All attribute bytes of a wedge.
std::string wedgeBytes(const PolygonMesh& mesh, Index wedge) {
  std::string bytes;
  for (const Attribute& attribute : mesh.attributes) {
    const auto* data = reinterpret_cast<const char*>(attribute.data.data());
    bytes.append(data + size_t{wedge} * attribute.stride(), attribute.stride());
  }
  return bytes;
}

/// The cycle that begins at the smallest of its rotations.
std::string rotated(std::vector<std::string> cycle) {
  std::vector<std::string> best = cycle;
  for (size_t i = 0; i < cycle.size(); ++i) {
    std::rotate(cycle.begin(), cycle.begin() + 1, cycle.end());
    best = std::min(best, cycle);
  }
  std::string result = std::to_string(cycle.size()) + ":";
  for (const std::string& part : best) result += part;
  return result;
}

std::vector<std::string> ring(const PolygonMesh& mesh, Index first, Index degree) {
  std::vector<std::string> cycle;
  for (Index i = 0; i < degree; ++i) cycle.push_back(wedgeBytes(mesh, mesh.wedgeOf(first + i)));
  return cycle;
}

std::string groupName(const PolygonMesh& mesh, size_t face) {
  return "g" + std::to_string(mesh.groups.empty() ? 0 : mesh.groups[face]) + " ";
}

}  // namespace

Asset emptyAsset() {
  Asset asset;
  asset.json = {{"asset", {{"version", "2.0"}}}};
  return asset;
}

uint64_t addRawAccessor(Asset& asset, Bytes bytes, ComponentType type, const std::string& kind, uint64_t count,
                        Json view) {
  const uint64_t index = appendView(asset, std::move(bytes), std::move(view));
  return appendElement(
      asset.json, "accessors",
      {{"bufferView", index}, {"componentType", static_cast<uint64_t>(type)}, {"count", count}, {"type", kind}});
}

uint64_t addFloats(Asset& asset, const std::vector<float>& values, uint64_t components) {
  const uint64_t index =
      addRawAccessor(asset, bytesOf(values), ComponentType::kFloat, typeName(static_cast<uint32_t>(components)),
                     values.size() / components, {{"target", 34962}});
  setBounds(asset.json["accessors"][index], bytesOf(values), static_cast<uint32_t>(components), ComponentType::kFloat);
  return index;
}

uint64_t addShorts(Asset& asset, const std::vector<Index>& values) {
  const std::vector<uint16_t> shorts(values.begin(), values.end());
  return addRawAccessor(asset, bytesOf(shorts), ComponentType::kUint16, "SCALAR", shorts.size(), {{"target", 34963}});
}

uint64_t addPositions(Asset& asset, const shapes::Shape& shape) {
  std::vector<float> values;
  for (Index v = 0; v < shape.mesh.vertex_count; ++v) {
    const bool known = v < shape.positions.size();
    const shapes::Position invented = {static_cast<float>(v), static_cast<float>(v % 7), static_cast<float>(v % 11)};
    const shapes::Position& position = known ? shape.positions[v] : invented;
    values.insert(values.end(), position.begin(), position.end());
  }
  return addFloats(asset, values, 3);
}

std::vector<Index> fanIndices(const Polygons& polygons) {
  std::vector<Index> indices;
  Index previous = kNone;
  size_t first = 0;
  for (const Index degree : polygons.face_degrees) {
    if (degree >= 3) {
      Index start = 0;
      while (start + 1 < degree && polygons.corners[first + start] == previous) ++start;
      const auto corner = [&](Index i) { return polygons.corners[first + (start + i) % degree]; };
      for (Index i = 1; i + 1 < degree; ++i) indices.insert(indices.end(), {corner(0), corner(i), corner(i + 1)});
      previous = corner(0);
    }
    first += degree;
  }
  return indices;
}

void addMesh(Asset& asset, Json primitive) {
  const uint64_t mesh = appendElement(asset.json, "meshes", {{"primitives", Json::array({std::move(primitive)})}});
  const uint64_t node = appendElement(asset.json, "nodes", {{"mesh", mesh}});
  asset.json["scenes"][0]["nodes"].push_back(node);
}

Asset triangleAsset(const shapes::Shape& shape) {
  Asset asset = emptyAsset();
  const uint64_t positions = addPositions(asset, shape);
  addMesh(asset, {{"attributes", {{"POSITION", positions}}}, {"indices", addShorts(asset, fanIndices(shape.mesh))}});
  return asset;
}

Asset fanAsset(const shapes::Shape& shape) {
  Asset asset = triangleAsset(shape);
  asset.json["meshes"][0]["primitives"][0]["extensions"]["FB_ngon_encoding"] = Json::object();
  addExtension(asset.json, "extensionsUsed", "FB_ngon_encoding");
  return asset;
}

Asset polygonAsset(const shapes::Shape& shape) {
  Asset asset = triangleAsset(shape);
  std::vector<Index> loops, loop_offsets, index_offsets;
  Index triangles = 0;
  size_t first = 0;
  for (const Index degree : shape.mesh.face_degrees) {
    if (degree >= 3) {
      if (!loops.empty()) loops.push_back(0xFFFF);
      loop_offsets.push_back(static_cast<Index>(loops.size()));
      index_offsets.push_back(3 * triangles);
      triangles += degree - 2;
      for (Index i = 0; i < degree; ++i) loops.push_back(shape.mesh.corners[first + i]);
    }
    first += degree;
  }
  asset.json["meshes"][0]["primitives"][0]["extensions"]["EXT_mesh_polygon"] = {
      {"count", loop_offsets.size()},
      {"loopIndices", addShorts(asset, loops)},
      {"loopIndicesOffsets", addShorts(asset, loop_offsets)},
      {"indicesOffsets", addShorts(asset, index_offsets)}};
  addExtension(asset.json, "extensionsUsed", "EXT_mesh_polygon");
  return asset;
}

Asset holeAsset() {
  Asset asset = emptyAsset();
  const uint64_t positions =
      addFloats(asset, {0, 0, 0, 3, 0, 0, 3, 3, 0, 0, 3, 0, 1, 1, 0, 1, 2, 0, 2, 2, 0, 2, 1, 0, 4, 0, 0, 4, 3, 0}, 3);
  const std::vector<Index> triangles = {0, 1, 7, 0, 7, 4, 1, 2, 6, 1, 6, 7, 2, 3, 5,
                                        2, 5, 6, 3, 0, 4, 3, 4, 5, 1, 8, 9, 1, 9, 2};
  addMesh(asset, {{"attributes", {{"POSITION", positions}}}, {"indices", addShorts(asset, triangles)}});
  asset.json["meshes"][0]["primitives"][0]["extensions"]["EXT_mesh_polygon"] = {
      {"count", 2},
      {"loopIndices", addShorts(asset, {0, 1, 2, 3, 0xFFFF, 4, 5, 6, 7, 0xFFFF, 1, 8, 9, 2})},
      {"loopIndicesOffsets", addShorts(asset, {0, 10})},
      {"indicesOffsets", addShorts(asset, {0, 24})}};
  addExtension(asset.json, "extensionsUsed", "EXT_mesh_polygon");
  return asset;
}

CompressOptions lossless() {
  CompressOptions options;
  options.pack.position_bits = options.pack.normal_bits = options.pack.texcoord_bits = 0;
  options.pack.color_bits = options.pack.generic_bits = 0;
  return options;
}

std::vector<std::string> facesOf(const PolygonMesh& mesh) {
  const size_t count = mesh.polygons.face_degrees.size();
  std::vector<std::vector<std::string>> holes(count);
  std::vector<std::string> rings(count), faces;
  Index first = 0;
  for (size_t face = 0; face < count; ++face) {
    rings[face] = rotated(ring(mesh, first, mesh.polygons.face_degrees[face]));
    first += mesh.polygons.face_degrees[face];
  }
  for (size_t face = 0; face < count && !mesh.ring_owners.empty(); ++face) {
    if (mesh.ring_owners[face] != kNone) holes[mesh.ring_owners[face]].push_back(rings[face]);
  }
  for (size_t face = 0; face < count; ++face) {
    if (!mesh.ring_owners.empty() && mesh.ring_owners[face] != kNone) continue;
    std::sort(holes[face].begin(), holes[face].end());
    std::string text = groupName(mesh, face) + rings[face];
    for (const std::string& hole : holes[face]) text += " hole " + hole;
    faces.push_back(std::move(text));
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<std::string> trianglesOf(const PolygonMesh& mesh) {
  std::vector<std::string> triangles;
  if (mesh.triangulation.counts.empty()) return facesOf(mesh);
  size_t next = 0;
  for (size_t face = 0; face < mesh.triangulation.counts.size(); ++face) {
    for (Index i = 0; i < mesh.triangulation.counts[face]; ++i, next += 3) {
      std::vector<std::string> cycle;
      for (size_t k = next; k < next + 3; ++k) {
        cycle.push_back(wedgeBytes(mesh, mesh.wedgeOf(mesh.triangulation.corners[k])));
      }
      triangles.push_back(groupName(mesh, face) + rotated(std::move(cycle)));
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

void expectSameScene(const Asset& a, const Asset& b) {
  const auto first = assetToScene(a), second = assetToScene(b);
  ASSERT_TRUE(first) << why(first);
  ASSERT_TRUE(second) << why(second);
  ASSERT_EQ(first->meshes.size(), second->meshes.size());
  for (size_t i = 0; i < first->meshes.size(); ++i) {
    const PolygonMesh &left = first->meshes[i].mesh, &right = second->meshes[i].mesh;
    EXPECT_EQ(left.polygons.vertex_count, right.polygons.vertex_count) << i;
    EXPECT_EQ(left.wedge_count, right.wedge_count) << i;
    EXPECT_TRUE(facesOf(left) == facesOf(right)) << "faces of mesh " << i;
    EXPECT_TRUE(trianglesOf(left) == trianglesOf(right)) << "triangles of mesh " << i;
    EXPECT_EQ(first->meshes[i].name, second->meshes[i].name);
    EXPECT_EQ(first->meshes[i].group_materials, second->meshes[i].group_materials);
  }
  ASSERT_EQ(first->nodes.size(), second->nodes.size());
  for (size_t i = 0; i < first->nodes.size(); ++i) {
    EXPECT_EQ(first->nodes[i].matrix, second->nodes[i].matrix);
    EXPECT_EQ(first->nodes[i].meshes, second->nodes[i].meshes);
    EXPECT_EQ(first->nodes[i].children, second->nodes[i].children);
  }
  EXPECT_EQ(first->materials.size(), second->materials.size());
}

}  // namespace tutte
