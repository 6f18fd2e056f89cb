#include <algorithm>
#include <numeric>
#include <set>

#include "tests/shapes/shapes.h"

namespace tutte::shapes {
namespace {

/// A closed triangulation that can be changed: corner c of triangle c / 3, and the corner before which the same edge
/// begins on the other side.
class Triangulator {
 public:
  Triangulator() {
    for (auto face : {std::array<Index, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
      vertices_.insert(vertices_.end(), face.begin(), face.end());
    }
    twins_ = {8, 9, 3, 2, 11, 6, 5, 10, 0, 1, 7, 4};
  }

  Index triangles() const { return static_cast<Index>(vertices_.size() / 3); }

  /// Puts a vertex into triangle t.
  void split(Index t, Index vertex) {
    const Index a = 3 * t, b = a + 1, c = a + 2, p = static_cast<Index>(vertices_.size()), q = p + 3;
    const Index twin_b = twins_[b], twin_c = twins_[c];
    vertices_.insert(vertices_.end(), {vertices_[b], vertices_[c], vertex, vertices_[c], vertices_[a], vertex});
    vertices_[c] = vertex;
    twins_.resize(p + 6);
    link(p, twin_b);
    link(q, twin_c);
    link(b, p + 2);
    link(p + 1, q + 2);
    link(q + 1, c);
  }

  /// Turns the edge that begins at `corner`, unless its new ends are neighbours already.
  void flip(Index corner) {
    const Index other = twins_[corner];
    const Index a1 = next(corner), a2 = next(a1), b1 = next(other), b2 = next(b1);
    const Index top = vertices_[a2], bottom = vertices_[b2];
    if (top == bottom || areNeighbours(a2, bottom)) return;
    const Index outer_a1 = twins_[a1], outer_b1 = twins_[b1];
    vertices_[a1] = bottom;
    vertices_[b1] = top;
    link(corner, outer_b1);
    link(other, outer_a1);
    link(a1, b1);
  }

  Shape shape(Index vertex_count) const {
    Shape shape;
    shape.mesh.vertex_count = vertex_count;
    shape.mesh.face_degrees.assign(triangles(), 3);
    shape.mesh.corners = vertices_;
    return shape;
  }

 private:
  static Index next(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

  void link(Index a, Index b) {
    twins_[a] = b;
    twins_[b] = a;
  }

  /// Walks round the vertex at `corner`.
  bool areNeighbours(Index corner, Index vertex) const {
    Index at = corner;
    do {
      if (vertices_[next(at)] == vertex) return true;
      at = next(twins_[at]);
    } while (at != corner);
    return false;
  }

  std::vector<Index> vertices_, twins_;
};

using Face = std::vector<Index>;

std::vector<Face> facesOf(const Polygons& mesh) {
  std::vector<Face> faces;
  auto corner = mesh.corners.begin();
  for (Index degree : mesh.face_degrees) {
    faces.emplace_back(corner, corner + degree);
    corner += degree;
  }
  return faces;
}

Shape withFaces(const Shape& shape, const std::vector<Face>& faces) {
  Shape result;
  result.mesh.vertex_count = shape.mesh.vertex_count;
  result.positions = shape.positions;
  for (const Face& face : faces) result.addFace(face);
  return result;
}

template <class T>
void permute(std::vector<T>& list, Random& random) {
  for (size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random.below(static_cast<Index>(i))]);
}

std::vector<Index> permutation(Index count, Random& random) {
  std::vector<Index> list(count);
  std::iota(list.begin(), list.end(), 0u);
  permute(list, random);
  return list;
}

/// `a` and `b` without the edge from a[i] to its successor; empty when they share more than that edge.
Face merged(const Face& a, size_t i, const Face& b) {
  const std::set<Index> members(a.begin(), a.end());
  const auto shared = std::count_if(b.begin(), b.end(), [&](Index v) { return members.count(v) != 0; });
  const auto at = std::find(b.begin(), b.end(), a[(i + 1) % a.size()]);
  if (shared != 2 || at == b.end()) return {};
  const size_t j = static_cast<size_t>(at - b.begin());
  if (b[(j + 1) % b.size()] != a[i]) return {};
  Face result;
  for (size_t k = 1; k < a.size(); ++k) result.push_back(a[(i + k) % a.size()]);
  for (size_t k = 1; k < b.size(); ++k) result.push_back(b[(j + k) % b.size()]);
  return result;
}

}  // namespace

Shape randomTriangulation(Index vertices, uint64_t seed) {
  Random random(seed);
  Triangulator mesh;
  for (Index vertex = 4; vertex < vertices; ++vertex) {
    mesh.split(random.below(mesh.triangles()), vertex);
    for (int i = 0; i < 6; ++i) mesh.flip(random.below(3 * mesh.triangles()));
  }
  Shape shape = mesh.shape(vertices);
  for (Index vertex = 0; vertex < vertices; ++vertex) {
    shape.positions.push_back({float(random.below(1000)), float(random.below(1000)), float(random.below(1000))});
  }
  return shape;
}

Shape mergeFaces(const Shape& shape, Index count, uint64_t seed) {
  Random random(seed);
  std::vector<Face> faces = facesOf(shape.mesh);
  for (Index attempt = 0; attempt < 4 * count && count != 0; ++attempt) {
    const Index a = random.below(static_cast<Index>(faces.size()));
    const size_t i = random.below(static_cast<Index>(faces[a].size()));
    const auto faces_edge = [&](const Face& face) { return !merged(faces[a], i, face).empty(); };
    const auto b = std::find_if(faces.begin(), faces.end(), faces_edge);
    if (b == faces.end()) continue;
    faces[a] = merged(faces[a], i, *b);
    faces.erase(b);
    --count;
  }
  return withFaces(shape, faces);
}

Shape removeFaces(const Shape& shape, Index count, uint64_t seed) {
  Random random(seed);
  std::vector<Face> faces = facesOf(shape.mesh);
  for (; count != 0 && !faces.empty(); --count)
    faces.erase(faces.begin() + random.below(static_cast<Index>(faces.size())));
  return withFaces(shape, faces);
}

Shape shuffle(const Shape& shape, uint64_t seed) {
  Random random(seed);
  const std::vector<Index> names = permutation(shape.mesh.vertex_count, random);
  std::vector<Face> faces = facesOf(shape.mesh);
  for (Face& face : faces) {
    for (Index& vertex : face) vertex = names[vertex];
    if (!face.empty())
      std::rotate(face.begin(), face.begin() + random.below(static_cast<Index>(face.size())), face.end());
  }
  permute(faces, random);
  Shape result = withFaces(shape, faces);
  for (Index vertex = 0; vertex < shape.positions.size(); ++vertex) {
    result.positions[names[vertex]] = shape.positions[vertex];
  }
  return result;
}

Shape flipFaces(const Shape& shape, Index count, uint64_t seed) {
  Random random(seed);
  std::vector<Face> faces = facesOf(shape.mesh);
  for (; count != 0; --count) {
    Face& face = faces[random.below(static_cast<Index>(faces.size()))];
    std::reverse(face.begin(), face.end());
  }
  return withFaces(shape, faces);
}

Shape soup(Index vertices, Index faces, Index min_degree, Index max_degree, uint64_t seed) {
  Random random(seed);
  Shape shape;
  shape.mesh.vertex_count = vertices;
  for (Index face = 0; face < faces; ++face) {
    Face corners(min_degree + random.below(max_degree - min_degree + 1));
    for (Index& corner : corners) corner = random.below(vertices);
    shape.addFace(corners);
  }
  return shape;
}

}  // namespace tutte::shapes
