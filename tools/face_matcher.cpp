#include "tools/face_matcher.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace tutte {
namespace {

/// Corners of each vertex, face after face; a face's appearances at a vertex are ordered by the face's label.
struct Incidence {
  std::vector<Index> starts;
  std::vector<Index> faces;

  Incidence(const FlatScene& scene, const std::vector<Index>& vertices, size_t vertex_count,
            const std::vector<uint64_t>& labels)
      : starts(vertex_count + 1) {
    for (Index corner : scene.corners) ++starts[vertices[corner] + 1];
    for (size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    faces.resize(scene.corners.size());
    std::vector<Index> order(scene.faceCount()), ends(starts.begin(), starts.end() - 1);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](Index x, Index y) { return labels[x] < labels[y]; });
    for (Index face : order) {
      for (Index i = scene.face_starts[face]; i < scene.face_starts[face + 1]; ++i) {
        faces[ends[vertices[scene.corners[i]]]++] = face;
      }
    }
  }

  std::span<const Index> at(Index vertex) const {
    return std::span(faces).subspan(starts[vertex], starts[vertex + 1] - starts[vertex]);
  }
};

/// Relates faces and vertices of A to those of B, step by step from faces that are already related.
class Matcher {
 public:
  Matcher(const FlatScene& a, const FlatScene& b, const ClassPair& classes, const ValueCheck& check,
          const ComparedVertices& vertices)
      : a_(a),
        b_(b),
        classes_(classes),
        check_(check),
        vertices_(vertices),
        incidence_a_(a, vertices.a, vertices.count, classes.a.faces),
        incidence_b_(b, vertices.b, vertices.count, classes.b.faces),
        vertex_to_b_(vertices.count, kNone),
        vertex_to_a_(vertices.count, kNone),
        face_to_b_(a.faceCount(), kNone),
        face_to_a_(b.faceCount(), kNone),
        turns_(a.faceCount()) {
    if (!vertices.related) return;
    std::iota(vertex_to_b_.begin(), vertex_to_b_.end(), 0u);
    vertex_to_a_ = vertex_to_b_;
  }

  std::optional<Difference> run(std::vector<double>& errors) {
    sortByLabel();
    // Faces that only one other can be come first: what follows from them is certain.
    for (const bool unique : {true, false}) {
      for (Index face : order_a_) {
        if (face_to_b_[face] != kNone || (unique && candidatesOf(face).size() > 1)) continue;
        if (!start(face)) return difference_;
      }
    }
    if (auto difference = matchRings()) return difference;
    gauge(errors);
    return {};
  }

 private:
  static constexpr int kMostTries = 4096;

  void sortByLabel() {
    for (auto [order, labels] : {std::pair{&order_a_, &classes_.a.faces}, std::pair{&order_b_, &classes_.b.faces}}) {
      order->resize(labels->size());
      std::iota(order->begin(), order->end(), 0u);
      std::stable_sort(order->begin(), order->end(), [&](Index x, Index y) { return (*labels)[x] < (*labels)[y]; });
    }
  }

  std::span<const Index> candidatesOf(Index face) const { return withLabel(order_b_, classes_.a.faces[face]); }

  std::span<const Index> withLabel(std::span<const Index> faces, uint64_t label) const {
    const auto& labels = classes_.b.faces;
    const auto first = std::lower_bound(faces.begin(), faces.end(), label,
                                        [&](Index face, uint64_t wanted) { return labels[face] < wanted; });
    const auto last =
        std::upper_bound(first, faces.end(), label, [&](uint64_t wanted, Index face) { return wanted < labels[face]; });
    return {first, last};
  }

  /// Relates a face and all that hangs on it, trying one candidate after the other.
  bool start(Index face) {
    int tries = 0;
    difference_ = {"a polygon has no counterpart", kNone, kNone, face, kNone};
    for (Index candidate : candidatesOf(face)) {
      if (face_to_a_[candidate] != kNone) continue;
      for (Index turn = 0; turn < std::max(a_.degree(face), 1u); ++turn) {
        if (!fits(face, candidate, turn)) continue;
        if (++tries > kMostTries) return false;
        changed_vertices_.clear();
        changed_faces_.clear();
        relate(face, candidate, turn);
        if (spread()) return true;
        undo();
      }
    }
    return false;
  }

  Index vertexA(Index corner) const { return vertices_.a[a_.corners[corner]]; }
  Index vertexB(Index corner) const { return vertices_.b[b_.corners[corner]]; }

  Index cornerB(Index face_a, Index face_b, Index i, Index turn) const {
    const Index degree = a_.degree(face_a), shifted = i + turn;
    return b_.face_starts[face_b] + (shifted >= degree ? shifted - degree : shifted);
  }

  /// Whether the faces can be related with B's corner `turn` at A's first one. Says in difference_ what does not fit.
  bool fits(Index face_a, Index face_b, Index turn) {
    const Index degree = a_.degree(face_a);
    if (degree != b_.degree(face_b)) return false;
    for (Index i = 0; i < degree; ++i) {
      const Index x = a_.face_starts[face_a] + i, y = cornerB(face_a, face_b, i, turn);
      if (!mayRelate(vertexA(x), vertexB(y))) return false;
      if (!check_.samePlace(a_.corners[x], b_.corners[y])) return false;
    }
    for (Index i = 0; i < degree; ++i) {
      const Index x = a_.face_starts[face_a] + i, y = cornerB(face_a, face_b, i, turn);
      if (const char* name = check_.differing(a_.wedges[x], b_.wedges[y])) {
        difference_ = {std::string(name) + " differs", a_.corners[x], b_.corners[y], face_a, face_b};
        return false;
      }
    }
    return true;
  }

  bool mayRelate(Index x, Index y) const {
    if (vertex_to_b_[x] != kNone || vertex_to_a_[y] != kNone) return vertex_to_b_[x] == y && vertex_to_a_[y] == x;
    return classes_.a.vertices[x] == classes_.b.vertices[y];
  }

  void relate(Index face_a, Index face_b, Index turn) {
    face_to_b_[face_a] = face_b;
    turns_[face_a] = turn;
    face_to_a_[face_b] = face_a;
    changed_faces_.push_back(face_a);
    for (Index i = 0; i < a_.degree(face_a); ++i) {
      const Index x = vertexA(a_.face_starts[face_a] + i), y = vertexB(cornerB(face_a, face_b, i, turn));
      if (vertex_to_b_[x] != kNone) continue;
      vertex_to_b_[x] = y;
      vertex_to_a_[y] = x;
      changed_vertices_.push_back(x);
    }
  }

  /// Relates the faces round every vertex that became known. False when one of them cannot be.
  bool spread() {
    for (size_t next = 0; next < changed_vertices_.size(); ++next) {
      const Index vertex = changed_vertices_[next];
      const auto others = incidence_b_.at(vertex_to_b_[vertex]);
      for (Index face : incidence_a_.at(vertex)) {
        if (face_to_b_[face] != kNone) continue;
        difference_ = {"a polygon has no counterpart", a_.corners[a_.face_starts[face]], kNone, face, kNone};
        if (!relateToOneOf(face, withLabel(others, classes_.a.faces[face]))) return false;
      }
    }
    return true;
  }

  bool relateToOneOf(Index face, std::span<const Index> candidates) {
    for (Index candidate : candidates) {
      if (face_to_a_[candidate] != kNone) continue;
      for (Index turn = 0; turn < a_.degree(face); ++turn) {
        if (!fits(face, candidate, turn)) continue;
        relate(face, candidate, turn);
        return true;
      }
    }
    return false;
  }

  void undo() {
    for (Index face : changed_faces_) {
      face_to_a_[face_to_b_[face]] = kNone;
      face_to_b_[face] = kNone;
    }
    for (Index vertex : changed_vertices_) {
      vertex_to_a_[vertex_to_b_[vertex]] = kNone;
      vertex_to_b_[vertex] = kNone;
    }
  }

  void gauge(std::vector<double>& errors) const {
    for (Index face = 0; face < a_.faceCount(); ++face) {
      for (Index i = 0; i < a_.degree(face); ++i) {
        const Index x = a_.face_starts[face] + i, y = cornerB(face, face_to_b_[face], i, turns_[face]);
        check_.gauge(a_.corners[x], b_.corners[y], a_.wedges[x], b_.wedges[y], errors);
      }
    }
  }

  /// Interior rings must lie in related polygons.
  std::optional<Difference> matchRings() const {
    for (Index face = 0; face < a_.faceCount(); ++face) {
      const Index owner_a = a_.owners[face], owner_b = b_.owners[face_to_b_[face]];
      const bool same = owner_a == kNone ? owner_b == kNone : owner_b != kNone && face_to_b_[owner_a] == owner_b;
      if (!same) return Difference{"a hole is in another polygon", kNone, kNone, face, face_to_b_[face]};
    }
    return {};
  }

  const FlatScene& a_;
  const FlatScene& b_;
  const ClassPair& classes_;
  const ValueCheck& check_;
  const ComparedVertices& vertices_;
  Incidence incidence_a_, incidence_b_;
  std::vector<Index> vertex_to_b_, vertex_to_a_, face_to_b_, face_to_a_;
  std::vector<Index> turns_;              ///< per face of A that is related: the corner of B's face at its first one
  std::vector<Index> order_a_, order_b_;  ///< faces by label
  std::vector<Index> changed_vertices_, changed_faces_;
  std::optional<Difference> difference_;
};

}  // namespace

std::optional<Difference> matchFaces(const FlatScene& a, const FlatScene& b, const ClassPair& classes,
                                     const ValueCheck& check, const ComparedVertices& vertices,
                                     std::vector<double>& errors) {
  return Matcher(a, b, classes, check, vertices).run(errors);
}

}  // namespace tutte
