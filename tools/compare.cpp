#include "tools/compare.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/flat_scene.h"
#include "tools/vertex_classes.h"

namespace tutte {
namespace {

/// Attributes of A and B with the same name.
struct AttributePair {
  const FlatAttribute& a;
  const FlatAttribute& b;
};

/// Whether values agree within A's tolerances.
class ValueCheck {
 public:
  ValueCheck(const FlatScene& a, const FlatScene& b, const std::set<std::string>& names) : a_(a), b_(b) {
    for (const FlatAttribute& attribute : a.attributes) {
      if (!names.empty() && !names.count(attribute.name)) continue;
      const auto other = find(b, attribute.name);
      if (!other)
        missing_ = attribute.name + " is in the first file only";
      else
        pairs_.push_back({attribute, *other});
    }
    for (const FlatAttribute& attribute : b.attributes) {
      if (!names.empty() && !names.count(attribute.name)) continue;
      if (!find(a, attribute.name)) missing_ = attribute.name + " is in the second file only";
    }
  }

  /// An attribute that only one scene has, as a sentence; or nothing.
  const std::string& missing() const { return missing_; }

  bool samePlace(Index vertex_a, Index vertex_b) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double distance = std::abs(a_.positions[vertex_a][axis] - b_.positions[vertex_b][axis]);
      if (!(distance <= a_.tolerances[vertex_a]) && distance != 0) return false;
    }
    return true;
  }

  /// The first attribute in which two wedges differ, or nullptr.
  const char* differing(Index wedge_a, Index wedge_b) const {
    for (const AttributePair& pair : pairs_) {
      const Index mesh_a = a_.wedge_meshes[wedge_a], mesh_b = b_.wedge_meshes[wedge_b];
      if (pair.a.given[mesh_a] != pair.b.given[mesh_b] ||
          !sameValue(pair, wedge_a, wedge_b, pair.a.tolerances[mesh_a])) {
        return pair.a.name.c_str();
      }
    }
    return nullptr;
  }

 private:
  static const FlatAttribute* find(const FlatScene& scene, const std::string& name) {
    for (const FlatAttribute& attribute : scene.attributes) {
      if (attribute.name == name) return &attribute;
    }
    return nullptr;
  }

  static bool sameValue(const AttributePair& pair, Index wedge_a, Index wedge_b, double tolerance) {
    const int most = std::max(pair.a.components, pair.b.components);
    for (int i = 0; i < most; ++i) {
      // A fourth component that is not there is 1: OBJ has no opacity.
      const float x = i < pair.a.components ? pair.a.values[size_t{wedge_a} * pair.a.components + i] : 1.0f;
      const float y = i < pair.b.components ? pair.b.values[size_t{wedge_b} * pair.b.components + i] : 1.0f;
      if (!(std::abs(x - y) <= tolerance) && x != y && !(std::isnan(x) && std::isnan(y))) return false;
    }
    return true;
  }

  const FlatScene& a_;
  const FlatScene& b_;
  std::vector<AttributePair> pairs_;
  std::string missing_;
};

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
          std::vector<Index> vertices_a, std::vector<Index> vertices_b, size_t vertex_count, bool vertices_matter)
      : a_(a),
        b_(b),
        classes_(classes),
        check_(check),
        vertices_a_(std::move(vertices_a)),
        vertices_b_(std::move(vertices_b)),
        incidence_a_(a, vertices_a_, vertex_count, classes.a.faces),
        incidence_b_(b, vertices_b_, vertex_count, classes.b.faces),
        vertex_to_b_(vertex_count, kNone),
        vertex_to_a_(vertex_count, kNone),
        face_to_b_(a.faceCount(), kNone),
        face_to_a_(b.faceCount(), kNone) {
    if (vertices_matter) return;
    std::iota(vertex_to_b_.begin(), vertex_to_b_.end(), 0u);
    vertex_to_a_ = vertex_to_b_;
  }

  std::optional<Difference> run() {
    sortByLabel();
    // Faces that only one other can be come first: what follows from them is certain.
    for (const bool unique : {true, false}) {
      for (Index face : order_a_) {
        if (face_to_b_[face] != kNone || (unique && candidatesOf(face).size() > 1)) continue;
        if (!start(face)) return difference_;
      }
    }
    return matchRings();
  }

  /// A's vertex -> B's, kNone for isolated ones.
  const std::vector<Index>& vertices() const { return vertex_to_b_; }

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

  Index vertexA(Index corner) const { return vertices_a_[a_.corners[corner]]; }
  Index vertexB(Index corner) const { return vertices_b_[b_.corners[corner]]; }

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
  std::vector<Index> vertices_a_, vertices_b_;  ///< a scene's vertex -> the vertex that is compared
  Incidence incidence_a_, incidence_b_;
  std::vector<Index> vertex_to_b_, vertex_to_a_, face_to_b_, face_to_a_;
  std::vector<Index> order_a_, order_b_;  ///< faces by label
  std::vector<Index> changed_vertices_, changed_faces_;
  std::optional<Difference> difference_;
};

/// Vertices without faces: within each class, one of A's with one of B's.
std::optional<Difference> matchIsolated(const FlatScene& a, const FlatScene& b, const ClassPair& classes,
                                        const ValueCheck& check) {
  const auto isolated = [](const FlatScene& scene, const std::vector<uint64_t>& labels) {
    std::vector<uint8_t> used(scene.positions.size());
    for (Index corner : scene.corners) used[corner] = 1;
    std::vector<Index> list;
    for (Index vertex = 0; vertex < used.size(); ++vertex) {
      if (!used[vertex]) list.push_back(vertex);
    }
    std::stable_sort(list.begin(), list.end(), [&](Index x, Index y) {
      return std::pair(labels[x], scene.positions[x]) < std::pair(labels[y], scene.positions[y]);
    });
    return list;
  };
  const std::vector<Index> list_a = isolated(a, classes.a.vertices);
  std::vector<Index> list_b = isolated(b, classes.b.vertices);
  if (list_a.size() != list_b.size()) return Difference{"the numbers of vertices without polygons differ"};
  for (size_t i = 0; i < list_a.size(); ++i) {
    const auto matches = [&](Index candidate) {
      return classes.a.vertices[list_a[i]] == classes.b.vertices[candidate] && check.samePlace(list_a[i], candidate) &&
             !check.differing(a.vertex_wedges[list_a[i]], b.vertex_wedges[candidate]);
    };
    const auto window = list_b.begin() + static_cast<ptrdiff_t>(std::min(list_b.size(), i + 1000));
    const auto found = std::find_if(list_b.begin() + static_cast<ptrdiff_t>(i), window, matches);
    if (found == window) return Difference{"a vertex without polygons has no counterpart", list_a[i]};
    std::iter_swap(list_b.begin() + static_cast<ptrdiff_t>(i), found);
  }
  return {};
}

std::string placeOf(const FlatScene& scene, const char* which, Index vertex, Index face) {
  std::string text = std::string(" (") + which + ":";
  char buffer[128];
  if (face != kNone) {
    const Index mesh = scene.face_meshes[face];
    std::snprintf(buffer, sizeof buffer, " mesh %u, polygon %u of degree %u", mesh, face - scene.mesh_faces[mesh],
                  scene.degree(face));
    text += buffer;
    if (vertex == kNone && scene.degree(face) > 0) vertex = scene.corners[scene.face_starts[face]];
  }
  if (vertex != kNone) {
    const auto& at = scene.positions[vertex];
    std::snprintf(buffer, sizeof buffer, "%s at %g %g %g", face == kNone ? " vertex" : "", at[0], at[1], at[2]);
    text += buffer;
  }
  return text + ")";
}

std::string sentence(const Difference& difference, const FlatScene& a, const FlatScene& b) {
  std::string text = difference.what;
  if (difference.vertex_a != kNone || difference.face_a != kNone) {
    text += placeOf(a, "first file", difference.vertex_a, difference.face_a);
  }
  if (difference.vertex_b != kNone || difference.face_b != kNone) {
    text += placeOf(b, "second file", difference.vertex_b, difference.face_b);
  }
  return text;
}

std::vector<Index> identity(size_t count) {
  std::vector<Index> result(count);
  std::iota(result.begin(), result.end(), 0u);
  return result;
}

std::optional<Difference> findDifference(const FlatScene& a, const FlatScene& b, const CompareOptions& options) {
  const ValueCheck check(a, b, options.attributes);
  if (!check.missing().empty()) return Difference{check.missing()};
  const PlaceNumbers places = numberPlaces(a, b);
  const ClassPair classes = classify(a, b, places, options.vertices_matter);
  if (classes.difference) return classes.difference;
  const bool exact = options.vertices_matter;
  Matcher matcher(a, b, classes, check, exact ? identity(a.positions.size()) : places.a,
                  exact ? identity(b.positions.size()) : places.b, exact ? a.positions.size() : places.count, exact);
  if (auto difference = matcher.run()) return difference;
  return exact ? matchIsolated(a, b, classes, check) : std::nullopt;
}

}  // namespace

Comparison compare(const Scene& a, const Scene& b, const CompareOptions& options) {
  const FlatScene flat_a = flatten(a, options.bits, options.tolerance);
  const FlatScene flat_b = flatten(b, options.bits, options.tolerance);
  Comparison result;
  result.vertices = flat_a.positions.size();
  result.faces = flat_a.faceCount();
  result.wedges_a = flat_a.wedge_meshes.size();
  result.wedges_b = flat_b.wedge_meshes.size();
  if (flat_a.faceCount() != flat_b.faceCount()) {
    result.difference = "the first file has " + std::to_string(flat_a.faceCount()) + " polygons, the second " +
                        std::to_string(flat_b.faceCount()) + "; ";
  }
  const auto difference = findDifference(flat_a, flat_b, options);
  result.same = !difference && result.difference.empty();
  if (difference) result.difference += sentence(*difference, flat_a, flat_b);
  return result;
}

}  // namespace tutte
