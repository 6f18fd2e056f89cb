#include "tools/vertex_classes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace tutte {
namespace {

uint64_t mix(uint64_t value) {
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9u;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBu;
  return value ^ (value >> 31);
}

/// 1 / odd, modulo 2^64.
constexpr uint64_t inverse(uint64_t odd) {
  uint64_t result = odd;
  for (int i = 0; i < 6; ++i) result *= 2 - odd * result;
  return result;
}

class UnionFind {
 public:
  explicit UnionFind(size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }
  Index find(Index i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(Index a, Index b) { parents_[find(a)] = find(b); }

 private:
  std::vector<Index> parents_;
};

using Cell = std::array<int64_t, 3>;

struct CellHash {
  size_t operator()(const Cell& cell) const {
    return mix(mix(mix(static_cast<uint64_t>(cell[0])) + static_cast<uint64_t>(cell[1])) +
               static_cast<uint64_t>(cell[2]));
  }
};

/// Cells of the size of the tolerance; without one, every distinct position is a cell of its own.
class Grid {
 public:
  Grid(const FlatScene& a, const FlatScene& b) {
    for (double tolerance : a.tolerances) size_ = std::max(size_, tolerance);
    for (const FlatScene* scene : {&a, &b}) {
      for (const auto& at : scene->positions) numbers_.push_back(numberOf(cellOf(at)));
    }
  }

  PlaceNumbers run(size_t count_a) {
    UnionFind sets(cells_.size());
    if (size_ > 0) {
      for (const auto& [cell, number] : cells_) joinNeighbours(sets, cell, number);
    }
    std::vector<Index> numbers(cells_.size(), kNone);
    PlaceNumbers places;
    for (size_t i = 0; i < numbers_.size(); ++i) {
      Index& number = numbers[sets.find(numbers_[i])];
      if (number == kNone) number = places.count++;
      (i < count_a ? places.a : places.b).push_back(number);
    }
    return places;
  }

 private:
  Cell cellOf(const std::array<double, 3>& at) const {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
      const double value = at[axis] + 0.0;  // -0 becomes 0
      const double scaled = size_ > 0 ? std::floor(value / size_) : 0;
      cell[axis] = size_ > 0 && std::abs(scaled) < 9e18 ? static_cast<int64_t>(scaled) : std::bit_cast<int64_t>(value);
    }
    return cell;
  }

  Index numberOf(const Cell& cell) { return cells_.try_emplace(cell, static_cast<Index>(cells_.size())).first->second; }

  void joinNeighbours(UnionFind& sets, const Cell& cell, Index number) const {
    for (int i = 0; i < 13; ++i) {  // half of the 26; the other half is seen from the other side
      const Cell other = {cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1};
      if (const auto found = cells_.find(other); found != cells_.end()) sets.join(number, found->second);
    }
  }

  double size_ = 0;
  std::unordered_map<Cell, Index, CellHash> cells_;
  std::vector<Index> numbers_;
};

/// Labels of faces by the labels of their vertices in cyclic order, and of vertices by those of their corners.
class Refiner {
 public:
  Refiner(const FlatScene& scene, const std::vector<Index>& vertices) : scene_(scene), vertices_(vertices) {}

  /// One round. `vertices` is changed, `faces` is set.
  void run(std::vector<uint64_t>& vertices, std::vector<uint64_t>& faces) const {
    std::vector<uint64_t> sums(vertices.size());
    faces.assign(scene_.faceCount(), 0);
    for (size_t face = 0; face < faces.size(); ++face) faces[face] = label(face, vertices, sums);
    for (size_t i = 0; i < vertices.size(); ++i) vertices[i] = mix(vertices[i] + mix(sums[i] + 1));
  }

 private:
  /// The polynomial hash of every rotation, each from the one before it; the face's label is their sum, and every
  /// corner's goes to its vertex.
  uint64_t label(size_t face, const std::vector<uint64_t>& vertices, std::vector<uint64_t>& sums) const {
    static constexpr uint64_t kBase = 0x9E3779B97F4A7C15u, kInverse = inverse(kBase);
    const Index start = scene_.face_starts[face], degree = scene_.degree(face);
    uint64_t hash = 0, power = 1;
    for (Index i = 0; i < degree; ++i, power *= kBase) hash += vertices[vertices_[scene_.corners[start + i]]] * power;
    uint64_t sum = degree + (scene_.owners[face] == kNone ? 0 : 0x100000000u);
    for (Index i = 0; i < degree; ++i) {
      const Index vertex = vertices_[scene_.corners[start + i]];
      const uint64_t corner = mix(hash + degree);
      sum += corner;
      sums[vertex] += corner;
      hash = (hash - vertices[vertex]) * kInverse + vertices[vertex] * power * kInverse;
    }
    return mix(sum);
  }

  const FlatScene& scene_;
  const std::vector<Index>& vertices_;
};

std::vector<Index> orderOf(const std::vector<uint64_t>& labels) {
  std::vector<Index> order(labels.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](Index x, Index y) {
    return std::pair{labels[x], x} < std::pair{labels[y], y};
  });
  return order;
}

/// The first of A's and of B's without counterpart; kNone where there is none.
std::pair<Index, Index> firstUnmatched(const std::vector<uint64_t>& a, const std::vector<uint64_t>& b) {
  const std::vector<Index> order_a = orderOf(a), order_b = orderOf(b);
  std::pair<Index, Index> first{kNone, kNone};
  size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[order_a[i]] < b[order_b[j]])) {
      first.first = std::min(first.first, order_a[i++]);
    } else if (i == a.size() || b[order_b[j]] < a[order_a[i]]) {
      first.second = std::min(first.second, order_b[j++]);
    } else {
      ++i, ++j;
    }
  }
  return first;
}

size_t distinct(std::vector<uint64_t> labels) {
  std::sort(labels.begin(), labels.end());
  return static_cast<size_t>(std::unique(labels.begin(), labels.end()) - labels.begin());
}

std::vector<Index> identity(size_t count) {
  std::vector<Index> result(count);
  std::iota(result.begin(), result.end(), 0u);
  return result;
}

/// Labels of places, for every vertex or (when coincident vertices are one) for every place that a scene uses.
std::vector<uint64_t> placeLabels(const std::vector<Index>& places) {
  std::vector<uint64_t> labels;
  for (Index place : places) labels.push_back(mix(place + 1));
  return labels;
}

std::vector<uint64_t> presence(std::vector<Index> places) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return {places.begin(), places.end()};
}

}  // namespace

PlaceNumbers numberPlaces(const FlatScene& a, const FlatScene& b) { return Grid(a, b).run(a.positions.size()); }

ClassPair classify(const FlatScene& a, const FlatScene& b, const PlaceNumbers& places, bool vertices_matter) {
  ClassPair result;
  const auto differ = [&](const char* what, std::pair<Index, Index> first, bool faces) {
    if (first.first == kNone && first.second == kNone) return false;
    result.difference = {what};
    (faces ? result.difference->face_a : result.difference->vertex_a) = first.first;
    (faces ? result.difference->face_b : result.difference->vertex_b) = first.second;
    return true;
  };
  const auto firstAt = [](const std::vector<Index>& all, Index index, const std::vector<uint64_t>& present) {
    return index == kNone ? kNone : static_cast<Index>(std::find(all.begin(), all.end(), present[index]) - all.begin());
  };
  const auto present_a = presence(places.a), present_b = presence(places.b);
  const auto lonely = firstUnmatched(present_a, present_b);
  const std::pair<Index, Index> lonely_vertices = {firstAt(places.a, lonely.first, present_a),
                                                   firstAt(places.b, lonely.second, present_b)};
  if (differ("a vertex has no counterpart at its place", lonely_vertices, false)) return result;
  result.a.vertices = placeLabels(places.a);
  result.b.vertices = placeLabels(places.b);
  if (vertices_matter && differ("there are not as many vertices at one place",
                                firstUnmatched(result.a.vertices, result.b.vertices), false)) {
    return result;
  }
  // Without identity of vertices, places are the vertices of both, and one round says all.
  const std::vector<Index> vertices_a = vertices_matter ? identity(places.a.size()) : places.a;
  const std::vector<Index> vertices_b = vertices_matter ? identity(places.b.size()) : places.b;
  if (!vertices_matter) result.a.vertices = result.b.vertices = placeLabels(identity(places.count));
  const Refiner refiner_a(a, vertices_a), refiner_b(b, vertices_b);
  size_t classes = distinct(result.a.vertices);
  for (int round = 0; round < (vertices_matter ? kMaxRounds : 1); ++round) {
    refiner_a.run(result.a.vertices, result.a.faces);
    refiner_b.run(result.b.vertices, result.b.faces);
    if (differ("a polygon has no counterpart", firstUnmatched(result.a.faces, result.b.faces), true)) return result;
    if (vertices_matter &&
        differ("a vertex has other polygons around it", firstUnmatched(result.a.vertices, result.b.vertices), false)) {
      return result;
    }
    const size_t now = distinct(result.a.vertices);
    if (now == result.a.vertices.size() || now == classes) break;
    classes = now;
  }
  return result;
}

}  // namespace tutte
