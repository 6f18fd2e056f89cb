// Subdivision of any mesh, by rule. Only connectivity: the results have no positions.

#include <algorithm>
#include <unordered_map>

#include "tests/shapes/shapes.h"

namespace tutte::shapes {
namespace {

uint64_t edgeKey(Index a, Index b) { return uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

/// A new vertex per edge, made when it is first asked for.
class EdgePoints {
 public:
  explicit EdgePoints(Shape& shape) : shape_(shape) {}

  Index between(Index a, Index b) {
    const auto [found, is_new] = points_.try_emplace(edgeKey(a, b), shape_.mesh.vertex_count);
    if (is_new) ++shape_.mesh.vertex_count;
    return found->second;
  }

 private:
  Shape& shape_;
  std::unordered_map<uint64_t, Index> points_;
};

Shape splitTriangles(const Shape& shape) {
  Shape result;
  result.mesh.vertex_count = shape.mesh.vertex_count;
  EdgePoints points(result);
  const std::vector<Index>& corners = shape.mesh.corners;
  for (size_t i = 0; i + 3 <= corners.size(); i += 3) {
    const Index a = corners[i], b = corners[i + 1], c = corners[i + 2];
    const Index ab = points.between(a, b), bc = points.between(b, c), ca = points.between(c, a);
    result.addFace({a, ab, ca});
    result.addFace({b, bc, ab});
    result.addFace({c, ca, bc});
    result.addFace({ab, bc, ca});
  }
  return result;
}

/// Quads cut into grids, each of its own fineness, and triangles where a coarser one meets a finer one.
class Tessellation {
 public:
  Tessellation(const Shape& quads, const std::vector<Index>& levels) : quads_(quads), levels_(levels) {
    result_.mesh.vertex_count = quads.mesh.vertex_count;
    for (Index c = 0; c < quads.mesh.corners.size(); ++c) {
      Index& level = edge_levels_[edgeKey(quads.mesh.corners[c], successor(c))];
      level = std::max(level, levels[c / 4]);
    }
  }

  Shape run() && {
    for (Index quad = 0; quad < levels_.size(); ++quad) fill(quad);
    return std::move(result_);
  }

 private:
  Index successor(Index corner) const { return quads_.mesh.corners[corner % 4 == 3 ? corner - 3 : corner + 1]; }

  Index edgeLevel(Index quad, Index side) const {
    const Index corner = 4 * quad + side;
    return edge_levels_.at(edgeKey(quads_.mesh.corners[corner], successor(corner)));
  }

  /// Point `i` of `count` equal steps along a side of the quad.
  Index onSide(Index quad, Index side, Index i, Index count) {
    const Index corner = 4 * quad + side;
    const Index a = quads_.mesh.corners[corner], b = successor(corner);
    if (i == 0) return a;
    if (i == count) return b;
    const Index steps = Index{1} << edgeLevel(quad, side);
    const Index at = i * (steps / count);
    auto& points = edge_points_[edgeKey(a, b)];
    if (points.empty()) {
      for (Index k = 1; k < steps; ++k) points.push_back(result_.mesh.vertex_count++);
    }
    return points[a < b ? at - 1 : steps - at - 1];
  }

  void fill(Index quad) {
    const Index size = Index{1} << levels_[quad];
    const Index inner = result_.mesh.vertex_count;
    result_.mesh.vertex_count += (size - 1) * (size - 1);
    const auto at = [&](Index x, Index y) {
      if (y == 0) return onSide(quad, 0, x, size);
      if (x == size) return onSide(quad, 1, y, size);
      if (y == size) return onSide(quad, 2, size - x, size);
      if (x == 0) return onSide(quad, 3, size - y, size);
      return inner + (y - 1) * (size - 1) + x - 1;
    };
    for (Index y = 0; y < size; ++y) {
      for (Index x = 0; x < size; ++x) {
        std::vector<Index> cell{at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
        const bool outside[4] = {y == 0, x + 1 == size, y + 1 == size, x == 0};
        const Index begin[4] = {x, y, size - x - 1, size - y - 1};
        addCell(quad, cell, outside, begin, size);
      }
    }
  }

  /// A quad; or, where the quad beyond a side is finer, a fan from the first point that hangs on such a side.
  void addCell(Index quad, const std::vector<Index>& cell, const bool (&outside)[4], const Index (&begin)[4],
               Index size) {
    std::vector<Index> ring;
    size_t first = 0;
    for (Index side = 0; side < 4; ++side) {
      ring.push_back(cell[side]);
      if (!outside[side] || edgeLevel(quad, side) == levels_[quad]) continue;
      if (first == 0) first = ring.size();
      ring.push_back(onSide(quad, side, 2 * begin[side] + 1, 2 * size));
    }
    if (ring.size() == 4) return result_.addFace(ring);
    for (size_t i = 1; i + 1 < ring.size(); ++i) {
      result_.addFace({ring[first], ring[(first + i) % ring.size()], ring[(first + i + 1) % ring.size()]});
    }
  }

  const Shape& quads_;
  const std::vector<Index>& levels_;
  std::unordered_map<uint64_t, Index> edge_levels_;
  std::unordered_map<uint64_t, std::vector<Index>> edge_points_;
  Shape result_;
};

/// Per quad: `deepest` in `features` quads, one less for every `width` steps from them; so neighbours differ by one at
/// most.
std::vector<Index> levelsAround(const Shape& quads, Index features, Index deepest, Index width, uint64_t seed) {
  const Index count = static_cast<Index>(quads.mesh.face_degrees.size());
  std::unordered_map<uint64_t, std::array<Index, 2>> sides;
  for (Index c = 0; c < quads.mesh.corners.size(); ++c) {
    const Index end = quads.mesh.corners[c % 4 == 3 ? c - 3 : c + 1];
    const auto [found, is_new] = sides.try_emplace(edgeKey(quads.mesh.corners[c], end), std::array{c / 4, c / 4});
    if (!is_new) found->second[1] = c / 4;
  }
  Random random(seed);
  std::vector<Index> distance(count, kNone), queue;
  while (features-- > 0) {
    const Index quad = random.below(count);
    if (distance[quad] == kNone) queue.push_back(quad);
    distance[quad] = 0;
  }
  for (size_t i = 0; i < queue.size(); ++i) {
    for (Index side = 0; side < 4; ++side) {
      const Index c = 4 * queue[i] + side, end = quads.mesh.corners[side == 3 ? c - 3 : c + 1];
      for (const Index next : sides.at(edgeKey(quads.mesh.corners[c], end))) {
        if (distance[next] != kNone) continue;
        distance[next] = distance[queue[i]] + 1;
        queue.push_back(next);
      }
    }
  }
  std::vector<Index> levels(count);
  for (Index quad = 0; quad < count; ++quad) levels[quad] = deepest - std::min(deepest, distance[quad] / width);
  return levels;
}

}  // namespace

Shape subdivideTriangles(const Shape& shape, Index times) {
  Shape result = shape;
  result.positions.clear();
  while (times-- > 0) result = splitTriangles(result);
  return result;
}

Shape subdivideToQuads(const Shape& shape) {
  Shape result;
  result.mesh.vertex_count = shape.mesh.vertex_count;
  EdgePoints points(result);
  Index first = 0;
  for (const Index degree : shape.mesh.face_degrees) {
    const Index centre = result.mesh.vertex_count++;
    const auto at = [&](Index i) { return shape.mesh.corners[first + i % degree]; };
    for (Index i = 0; i < degree; ++i) {
      const Index before = points.between(at(i + degree - 1), at(i)), after = points.between(at(i), at(i + 1));
      result.addFace({at(i), after, centre, before});
    }
    first += degree;
  }
  return result;
}

Shape adaptiveTessellation(const Shape& quads, Index features, Index deepest, Index width, uint64_t seed) {
  return Tessellation(quads, levelsAround(quads, features, deepest, width, seed)).run();
}

}  // namespace tutte::shapes
