#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "tests/shapes/shapes.h"

namespace tutte::shapes {
namespace {

using Cell = std::array<int, 3>;

/// The quads between filled and empty cells of a size[0] x size[1] x size[2] block, facing outwards.
Shape surfaceOf(Cell size, const std::function<bool(Cell)>& filled) {
  Shape shape;
  std::map<Cell, Index> vertices;
  const auto inside = [&](Cell cell) {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= size[axis]) return false;
    }
    return filled(cell);
  };
  const auto vertex = [&](Cell point) {
    const auto [found, is_new] = vertices.try_emplace(point, shape.mesh.vertex_count);
    if (is_new) shape.addVertex({float(point[0]), float(point[1]), float(point[2])});
    return found->second;
  };
  const auto addQuad = [&](Cell low, int axis, bool towards) {
    Cell u{}, v{};
    u[(axis + (towards ? 1 : 2)) % 3] = 1;
    v[(axis + (towards ? 2 : 1)) % 3] = 1;
    low[axis] += towards ? 1 : 0;
    const auto at = [&](int i, int j) {
      return vertex({low[0] + i * u[0] + j * v[0], low[1] + i * u[1] + j * v[1], low[2] + i * u[2] + j * v[2]});
    };
    const Index a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
    shape.addFace({a, b, c, d});
  };
  for (int x = 0; x < size[0]; ++x) {
    for (int y = 0; y < size[1]; ++y) {
      for (int z = 0; z < size[2]; ++z) {
        for (int side = 0; side < 6 && inside({x, y, z}); ++side) {
          Cell neighbour{x, y, z};
          neighbour[side / 2] += side % 2 ? 1 : -1;
          if (!inside(neighbour)) addQuad({x, y, z}, side / 2, side % 2);
        }
      }
    }
  }
  return shape;
}

using Edge = std::pair<Index, Index>;

struct Corner {
  Index face, first, degree, at;

  Index index() const { return first + at; }
  Index previous() const { return first + (at + degree - 1) % degree; }
};

/// The corners at which edges begin, in the order of these; where several begin at one edge, the last.
class CornersByEdge {
 public:
  explicit CornersByEdge(const Polygons& mesh);

  const Corner* find(const Edge& edge) const {
    const auto found = std::ranges::lower_bound(edges_, edge, {}, &Entry::first);
    return found == edges_.end() || found->first != edge ? nullptr : &found->second;
  }
  auto begin() const { return edges_.begin(); }
  auto end() const { return edges_.end(); }

 private:
  using Entry = std::pair<Edge, Corner>;
  std::vector<Entry> edges_;
};

CornersByEdge::CornersByEdge(const Polygons& mesh) {
  Index first = 0;
  for (Index face = 0; face < mesh.face_degrees.size(); ++face) {
    const Index degree = mesh.face_degrees[face];
    for (Index i = 0; i < degree; ++i) {
      edges_.push_back({{mesh.corners[first + i], mesh.corners[first + (i + 1) % degree]}, {face, first, degree, i}});
    }
    first += degree;
  }
  std::ranges::stable_sort(edges_, {}, &Entry::first);
  const auto same = [](const Entry& a, const Entry& b) { return a.first == b.first; };
  edges_.erase(edges_.begin(), std::unique(edges_.rbegin(), edges_.rend(), same).base());
}

/// The faces round the vertex of `start`, counter-clockwise; empty at a boundary.
std::vector<Index> facesRound(const Polygons& mesh, const CornersByEdge& edges, const Corner& start) {
  std::vector<Index> faces;
  const Index vertex = mesh.corners[start.index()];
  Corner corner = start;
  do {
    faces.push_back(corner.face);
    const Corner* found = edges.find({vertex, mesh.corners[corner.previous()]});
    if (!found) return {};
    corner = *found;
  } while (corner.face != start.face);
  return faces;
}

Position centre(const Shape& shape, Index first, Index degree) {
  Position sum{};
  for (Index i = 0; i < degree; ++i) {
    for (size_t k = 0; k < 3; ++k) sum[k] += shape.positions[shape.mesh.corners[first + i]][k] / float(degree);
  }
  return sum;
}

/// Drops vertices that no face uses.
Shape compacted(const Shape& shape) {
  Shape result;
  std::vector<Index> names(shape.mesh.vertex_count, kNone);
  for (Index vertex : shape.mesh.corners) names[vertex] = 0;
  for (Index vertex = 0; vertex < shape.mesh.vertex_count; ++vertex) {
    if (names[vertex] == kNone) continue;
    names[vertex] = shape.positions.empty() ? result.addVertex() : result.addVertex(shape.positions[vertex]);
  }
  result.mesh.face_degrees = shape.mesh.face_degrees;
  for (Index vertex : shape.mesh.corners) result.mesh.corners.push_back(names[vertex]);
  return result;
}

}  // namespace

Shape sponge(Index holes) {
  const int size = static_cast<int>(2 * holes + 1);
  return surfaceOf({size, size, size}, [](Cell cell) { return cell[0] % 2 + cell[1] % 2 + cell[2] % 2 <= 1; });
}

Shape plate(Index columns, Index rows) {
  const Cell size{static_cast<int>(2 * columns + 1), static_cast<int>(2 * rows + 1), 1};
  return surfaceOf(size, [](Cell cell) { return cell[0] % 2 == 0 || cell[1] % 2 == 0; });
}

Shape voxelsTouchingAtEdges(Index size) {
  const int n = static_cast<int>(size);
  return surfaceOf({n, n, n}, [](Cell cell) { return (cell[0] + cell[1] + cell[2]) % 2 == 0; });
}

Shape perforatedGrid(Index columns, Index rows) {
  const Index width = 3 * columns + 1;
  Shape shape = quadGrid(width, 3 * rows + 1);
  const Polygons whole = shape.mesh;
  shape.mesh.face_degrees.clear();
  shape.mesh.corners.clear();
  for (Index face = 0; face < whole.face_degrees.size(); ++face) {
    if (face % width % 3 == 1 && face / width % 3 == 1) continue;
    shape.addFace({whole.corners.begin() + 4 * face, whole.corners.begin() + 4 * face + 4});
  }
  return shape;
}

Shape copies(const Shape& shape, Index count) {
  Shape result;
  for (Index copy = 0; copy < count; ++copy) {
    const Index first = result.mesh.vertex_count;
    for (Position p : shape.positions) result.positions.push_back({p[0] + 5 * float(copy), p[1], p[2]});
    result.mesh.vertex_count += shape.mesh.vertex_count;
    result.mesh.face_degrees.insert(result.mesh.face_degrees.end(), shape.mesh.face_degrees.begin(),
                                    shape.mesh.face_degrees.end());
    for (Index vertex : shape.mesh.corners) result.mesh.corners.push_back(first + vertex);
  }
  return result;
}

Shape islands(Index triangles) { return copies(disc(3), triangles); }

Shape comb(Index teeth) {
  Shape shape = quadGrid(2 * teeth, 1);
  for (Index i = 0; i < teeth; ++i) {
    const Index a = 2 * teeth + 1 + 2 * i, b = a + 1;
    const Index c = shape.addVertex({float(2 * i + 1), 9, 0}), d = shape.addVertex({float(2 * i), 9, 0});
    shape.addFace({a, b, c, d});
  }
  return shape;
}

Shape dual(const Shape& shape) {
  const CornersByEdge edges(shape.mesh);
  Shape result;
  std::vector<bool> done(shape.mesh.vertex_count);
  Index first = 0;
  for (Index degree : shape.mesh.face_degrees) {
    if (shape.positions.empty()) {
      result.addVertex();
    } else {
      result.addVertex(centre(shape, first, degree));
    }
    first += degree;
  }
  for (const auto& [edge, corner] : edges) {
    if (done[edge.first]) continue;
    done[edge.first] = true;
    const std::vector<Index> faces = facesRound(shape.mesh, edges, corner);
    if (faces.size() >= 3) result.addFace(faces);
  }
  return compacted(result);
}

}  // namespace tutte::shapes
