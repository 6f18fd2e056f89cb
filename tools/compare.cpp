#include "tools/compare.h"

#include <algorithm>
#include <numeric>

#include "tools/face_matcher.h"
#include "tools/flat_scene.h"
#include "tools/value_check.h"
#include "tools/vertex_classes.h"

namespace tutte {
namespace {

/// Vertices without faces: within each class, one of A's with one of B's.
std::optional<Difference> matchIsolated(const FlatScene& a, const FlatScene& b, const ClassPair& classes,
                                        const ValueCheck& check, std::vector<double>& errors) {
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
    check.gauge(list_a[i], *found, a.vertex_wedges[list_a[i]], b.vertex_wedges[*found], errors);
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

std::optional<Difference> findDifference(const FlatScene& a, const FlatScene& b, const CompareOptions& options,
                                         std::vector<AttributeError>& found) {
  const ValueCheck check(a, b, options.attributes);
  if (!check.missing().empty()) return Difference{check.missing()};
  const PlaceNumbers places = numberPlaces(a, b);
  const ClassPair classes = classify(a, b, places, options.vertices_matter);
  if (classes.difference) return classes.difference;
  const bool exact = options.vertices_matter;
  const ComparedVertices vertices =
      exact ? ComparedVertices{identity(a.positions.size()), identity(b.positions.size()), a.positions.size(), false}
            : ComparedVertices{places.a, places.b, places.count, true};
  const std::vector<std::string> names = check.names();
  std::vector<double> errors(names.size());
  if (auto difference = matchFaces(a, b, classes, check, vertices, errors)) return difference;
  if (exact) {
    if (auto difference = matchIsolated(a, b, classes, check, errors)) return difference;
  }
  for (size_t i = 0; i < names.size(); ++i) found.push_back({names[i], errors[i]});
  return {};
}

}  // namespace

Comparison compare(const Scene& a, const Scene& b, const CompareOptions& options) {
  const Tolerances tolerances{options.bits, options.bounds, options.tolerance, options.exact};
  const FlatScene flat_a = flatten(a, tolerances);
  const FlatScene flat_b = flatten(b, tolerances);
  Comparison result;
  result.vertices = flat_a.positions.size();
  result.faces = flat_a.faceCount();
  result.wedges_a = flat_a.wedge_meshes.size();
  result.wedges_b = flat_b.wedge_meshes.size();
  if (flat_a.faceCount() != flat_b.faceCount()) {
    result.difference = "the first file has " + std::to_string(flat_a.faceCount()) + " polygons, the second " +
                        std::to_string(flat_b.faceCount()) + "; ";
  }
  const auto difference = findDifference(flat_a, flat_b, options, result.errors);
  result.same = !difference && result.difference.empty();
  if (difference) result.difference += sentence(*difference, flat_a, flat_b);
  return result;
}

}  // namespace tutte
