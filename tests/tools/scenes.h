#pragma once
// Scenes made of generated shapes.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "gltf_ext/scene.h"
#include "gltf_ext/triangulate.h"
#include "tests/shapes/shapes.h"
#include "tools/indexed_mesh.h"
#include "tools/values.h"

namespace tutte {

/// A scene of one mesh with positions (made up where the shape has none) and nothing else.
inline Scene sceneOf(const shapes::Shape& shape) {
  std::vector<float> values;
  std::mt19937 random(1);
  for (Index vertex = 0; vertex < shape.mesh.vertex_count; ++vertex) {
    for (int axis = 0; axis < 3; ++axis) {
      values.push_back(shape.positions.empty() ? static_cast<float>(random() % 100000) / 1000
                                               : shape.positions[vertex][axis]);
    }
  }
  IndexedMesh indexed;
  indexed.vertex_count = shape.mesh.vertex_count;
  indexed.face_degrees = shape.mesh.face_degrees;
  indexed.corners = shape.mesh.corners;
  indexed.vertex_attributes.push_back(floatAttribute("POSITION", 3, values));
  std::vector<std::string> warnings;
  SceneMesh mesh;
  mesh.name = "shape";
  mesh.mesh = buildMesh(std::move(indexed), warnings);
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

/// Gives every vertex up to two wedges, with texture coordinates that differ between them and normals that do not.
inline void addSeams(Scene& scene) {
  PolygonMesh& mesh = scene.meshes[0].mesh;
  const Index vertices = mesh.polygons.vertex_count;
  std::vector<Index> second(vertices, kNone);
  std::vector<Index> sources(vertices);
  std::iota(sources.begin(), sources.end(), 0u);
  std::vector<uint8_t> seen(vertices);
  for (size_t corner = 0; corner < mesh.polygons.corners.size(); ++corner) {
    const Index vertex = mesh.polygons.corners[corner];
    Index wedge = vertex;
    if (seen[vertex] && corner % 3 == 0) {
      if (second[vertex] == kNone) second[vertex] = static_cast<Index>(sources.size()), sources.push_back(vertex);
      wedge = second[vertex];
    }
    seen[vertex] = 1;
    mesh.wedges.push_back(wedge);
  }
  mesh.wedge_count = static_cast<Index>(sources.size());
  const std::vector<float> old = floatsOf(mesh.attributes[0]);
  std::vector<float> positions, texcoords, normals;
  for (Index wedge = 0; wedge < sources.size(); ++wedge) {
    for (int axis = 0; axis < 3; ++axis) positions.push_back(old[3 * sources[wedge] + axis]);
    texcoords.push_back(static_cast<float>(wedge % 1000) / 1000);
    texcoords.push_back(static_cast<float>(wedge * 7 % 1000) / 1000);
    const double angle = sources[wedge] * 0.1;
    for (double value : {std::cos(angle), std::sin(angle), 0.0}) normals.push_back(static_cast<float>(value));
  }
  mesh.attributes = {floatAttribute("POSITION", 3, positions), floatAttribute("NORMAL", 3, normals),
                     floatAttribute("TEXCOORD_0", 2, texcoords)};
}

/// The same mesh with its vertices, faces and first corners in another order.
inline Scene shuffled(const Scene& scene, uint32_t seed) {
  std::mt19937 random(seed);
  Scene out = scene;
  const PolygonMesh& from = scene.meshes[0].mesh;
  PolygonMesh& to = out.meshes[0].mesh;
  std::vector<uint8_t> used(from.polygons.vertex_count);
  for (Index vertex : from.polygons.corners) used[vertex] = 1;
  const auto connected = static_cast<Index>(std::count(used.begin(), used.end(), 1));
  std::vector<Index> vertices(from.polygons.vertex_count), faces(from.polygons.face_degrees.size());
  std::iota(vertices.begin(), vertices.end(), 0u);
  std::iota(faces.begin(), faces.end(), 0u);
  if (from.wedges.empty()) {
    std::shuffle(vertices.begin(), vertices.begin() + connected, random);
    std::shuffle(vertices.begin() + connected, vertices.end(), random);
  }
  std::shuffle(faces.begin(), faces.end(), random);
  std::vector<Index> starts;
  Index start = 0;
  for (Index degree : from.polygons.face_degrees) starts.push_back(start), start += degree;
  to.polygons.face_degrees.clear();
  to.polygons.corners.clear();
  to.wedges.clear();
  for (Index face : faces) {
    const Index degree = from.polygons.face_degrees[face];
    const Index turn = degree ? static_cast<Index>(random() % degree) : 0;
    to.polygons.face_degrees.push_back(degree);
    for (Index i = 0; i < degree; ++i) {
      const Index corner = starts[face] + (i + turn) % degree;
      to.polygons.corners.push_back(vertices[from.polygons.corners[corner]]);
      if (!from.wedges.empty()) to.wedges.push_back(from.wedges[corner]);
    }
  }
  if (from.wedges.empty()) {
    for (Attribute& attribute : to.attributes) {
      const size_t stride = attribute.stride();
      std::vector<uint8_t> moved(attribute.data.size());
      for (Index i = 0; i < vertices.size(); ++i) {
        std::copy_n(attribute.data.begin() + static_cast<ptrdiff_t>(i * stride), stride,
                    moved.begin() + static_cast<ptrdiff_t>(vertices[i] * stride));
      }
      attribute.data = std::move(moved);
    }
  }
  return out;
}

/// Changes one float of an attribute.
inline void nudge(Scene& scene, const char* name, size_t index, float by) {
  for (Attribute& attribute : scene.meshes[0].mesh.attributes) {
    if (attribute.name != name) continue;
    std::vector<float> values = floatsOf(attribute);
    values[index] += by;
    attribute = floatAttribute(attribute.name, attribute.components, values);
  }
}

}  // namespace tutte
