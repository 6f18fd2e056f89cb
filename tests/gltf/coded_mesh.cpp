#include "tests/gltf/coded_mesh.h"

#include <cmath>
#include <map>

namespace tutte {
namespace {

bool sameValue(const Attribute& attribute, Index a, Index b) {
  const size_t stride = attribute.stride();
  return std::memcmp(&attribute.data[a * stride], &attribute.data[b * stride], stride) == 0;
}

std::vector<Index> nextCorners(const Connectivity& mesh) {
  std::vector<Index> next(mesh.umbrellas.size());
  Index first = 0;
  for (const Index degree : mesh.face_degrees) {
    for (Index i = 0; i < degree; ++i) next[first + i] = first + (i + 1) % degree;
    first += degree;
  }
  return next;
}

}  // namespace

AttributeTopology CodedMesh::topology(const std::vector<Attribute>& attributes) {
  const std::vector<Index> next = nextCorners(connectivity);
  seams.assign(attributes.size(), {});
  for (size_t i = 1; i < attributes.size(); ++i) {
    seams[i].assign(wedges.size(), 0);
    for (Index c = 0; c < wedges.size(); ++c) {
      const Index twin = connectivity.twins[c];
      if (twin == kNone) continue;
      seams[i][c] = !sameValue(attributes[i], wedges[c], wedges[next[twin]]) ||
                    !sameValue(attributes[i], wedges[next[c]], wedges[twin]);
    }
  }
  AttributeTopology result{connectivity, wedges, wedgeCount(), {}};
  result.seams.assign(seams.begin(), seams.end());
  return result;
}

CodedMesh codeMesh(const shapes::Shape& shape, bool split) {
  auto encoded = encode(shape.mesh);
  EXPECT_TRUE(encoded.ok());
  CodedMesh mesh;
  mesh.connectivity = std::move(encoded->connectivity);
  std::map<std::pair<Index, Index>, Index> known;  // vertex and corner that owns the wedge
  Index corner = 0, face = 0;
  for (const Index degree : mesh.connectivity.face_degrees) {
    for (Index i = 0; i < degree; ++i, ++corner) {
      const Index vertex = shape.mesh.corners[encoded->corner_order[corner]];
      const Index owner = split && face % 2 == 1 ? corner : kNone;
      const auto [entry, is_new] = known.emplace(std::pair{vertex, owner}, mesh.wedgeCount());
      if (is_new) mesh.vertex.push_back(vertex);
      mesh.wedges.push_back(entry->second);
    }
    ++face;
  }
  std::vector<bool> used(shape.mesh.vertex_count, false);
  for (const Index vertex : mesh.vertex) used[vertex] = true;
  for (Index v = 0; v < shape.mesh.vertex_count; ++v) {
    if (!used[v]) mesh.vertex.push_back(v);
  }
  return mesh;
}

Attribute positionsOf(const CodedMesh& mesh, const shapes::Shape& shape) {
  return makeFloats("POSITION", 3, mesh.wedgeCount(), [&](Index wedge, int c) {
    const Index vertex = mesh.vertex[wedge];
    if (!shape.positions.empty()) return shape.positions[vertex][c];
    return static_cast<float>(std::sin(0.7 * vertex + 2.1 * c) * 3 + c);
  });
}

}  // namespace tutte
