#include "tests/codec/checks.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>

#include "codec/decode.h"

namespace tutte {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

/// Per face: its first corner; at the end, the number of corners.
std::vector<size_t> firstCorners(std::span<const Index> degrees) {
  std::vector<size_t> first(degrees.size() + 1);
  for (size_t face = 0; face < degrees.size(); ++face) first[face + 1] = first[face] + degrees[face];
  return first;
}

/// Per corner: the next one of its face.
std::vector<Index> nextCorners(std::span<const Index> degrees) {
  std::vector<Index> next;
  for (Index degree : degrees) {
    const Index first = static_cast<Index>(next.size());
    for (Index i = 0; i < degree; ++i) next.push_back(first + (i + 1) % degree);
  }
  return next;
}

std::vector<Index> inverse(std::span<const Index> next) {
  std::vector<Index> previous(next.size());
  for (Index corner = 0; corner < next.size(); ++corner) previous[next[corner]] = corner;
  return previous;
}

bool isPermutation(std::span<const Index> list, size_t count) {
  std::vector<bool> seen(count);
  for (Index i : list) {
    if (i >= count || seen[i]) return false;
    seen[i] = true;
  }
  return list.size() == count;
}

AssertionResult countsAreRight(const Connectivity& mesh) {
  const size_t corners = std::accumulate(mesh.face_degrees.begin(), mesh.face_degrees.end(), size_t{0});
  if (mesh.umbrellas.size() != corners) return AssertionFailure() << "corners: " << mesh.umbrellas.size();
  if (mesh.twins.size() != corners) return AssertionFailure() << "twins: " << mesh.twins.size();
  if (!mesh.flipped.empty() && mesh.flipped.size() != mesh.face_degrees.size()) {
    return AssertionFailure() << "flipped: " << mesh.flipped.size();
  }
  if (!mesh.vertices.empty() && mesh.vertices.size() != mesh.umbrella_count) {
    return AssertionFailure() << "vertices: " << mesh.vertices.size();
  }
  if (mesh.vertices.empty() && mesh.umbrella_count > mesh.vertex_count) {
    return AssertionFailure() << mesh.umbrella_count << " umbrellas";
  }
  for (Index umbrella : mesh.umbrellas) {
    if (umbrella >= mesh.umbrella_count) return AssertionFailure() << "umbrella " << umbrella;
  }
  return AssertionSuccess();
}

AssertionResult verticesAreNumberedByAppearance(const Connectivity& mesh) {
  Index known = 0;
  for (Index vertex : mesh.vertices) {
    if (vertex > known) return AssertionFailure() << "vertex " << vertex << " before " << known;
    known = std::max(known, vertex + 1);
  }
  if (known > mesh.vertex_count) return AssertionFailure() << known << " vertices of " << mesh.vertex_count;
  return AssertionSuccess();
}

AssertionResult twinsMatch(const Connectivity& mesh, std::span<const Index> next) {
  for (Index corner = 0; corner < next.size(); ++corner) {
    const Index twin = mesh.twins[corner];
    if (twin == kNone) continue;
    if (twin >= next.size() || twin == corner || mesh.twins[twin] != corner) {
      return AssertionFailure() << "corner " << corner << " has twin " << twin;
    }
    if (mesh.umbrellas[twin] != mesh.umbrellas[next[corner]] || mesh.umbrellas[next[twin]] != mesh.umbrellas[corner]) {
      return AssertionFailure() << "the edges of " << corner << " and " << twin << " differ";
    }
  }
  return AssertionSuccess();
}

/// Walks round the umbrella of `corner` and marks its corners.
size_t markFan(const Connectivity& mesh, std::span<const Index> next, std::span<const Index> previous, Index corner,
               std::vector<bool>& seen) {
  Index at = corner;
  while (mesh.twins[at] != kNone && next[mesh.twins[at]] != corner) at = next[mesh.twins[at]];
  const Index start = at;
  size_t count = 0;
  do {
    seen[at] = true;
    ++count;
    at = mesh.twins[previous[at]];
  } while (at != kNone && at != start && count <= seen.size());
  return count;
}

AssertionResult umbrellasAreFans(const Connectivity& mesh, std::span<const Index> next) {
  const std::vector<Index> previous = inverse(next);
  std::vector<bool> corner_seen(next.size()), umbrella_seen(mesh.umbrella_count);
  for (Index corner = 0; corner < next.size(); ++corner) {
    if (corner_seen[corner]) continue;
    const Index umbrella = mesh.umbrellas[corner];
    if (umbrella_seen[umbrella]) return AssertionFailure() << "umbrella " << umbrella << " has two fans";
    umbrella_seen[umbrella] = true;
    if (markFan(mesh, next, previous, corner, corner_seen) > next.size()) {
      return AssertionFailure() << "the fan of corner " << corner << " never closes";
    }
  }
  return AssertionSuccess();
}

AssertionResult smallFacesComeLast(const Connectivity& mesh) {
  const auto small = [](Index degree) { return degree < 3; };
  const auto first = std::find_if(mesh.face_degrees.begin(), mesh.face_degrees.end(), small);
  if (!std::all_of(first, mesh.face_degrees.end(), small)) return AssertionFailure() << "a small face is not last";
  return AssertionSuccess();
}

}  // namespace

AssertionResult isValid(const Connectivity& mesh) {
  if (AssertionResult result = countsAreRight(mesh); !result) return result;
  if (AssertionResult result = verticesAreNumberedByAppearance(mesh); !result) return result;
  if (AssertionResult result = smallFacesComeLast(mesh); !result) return result;
  const std::vector<Index> next = nextCorners(mesh.face_degrees);
  if (AssertionResult result = twinsMatch(mesh, next); !result) return result;
  return umbrellasAreFans(mesh, next);
}

AssertionResult isUncut(const Connectivity& mesh, PolygonView input) {
  std::map<std::pair<Index, Index>, int> edges;
  const std::vector<Index> next = nextCorners(input.face_degrees);
  for (Index corner = 0; corner < next.size(); ++corner) {
    ++edges[std::minmax(input.corners[corner], input.corners[next[corner]])];
  }
  const auto shared = std::count_if(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 2; });
  const auto linked = std::count_if(mesh.twins.begin(), mesh.twins.end(), [](Index twin) { return twin != kNone; });
  if (linked != 2 * shared) return AssertionFailure() << linked << " linked corners at " << shared << " shared edges";
  if (!mesh.vertices.empty()) return AssertionFailure() << "vertices were cut";
  if (!mesh.flipped.empty()) return AssertionFailure() << "faces were flipped";
  return AssertionSuccess();
}

AssertionResult areEqual(const Connectivity& a, const Connectivity& b) {
  if (a.face_degrees != b.face_degrees) return AssertionFailure() << "the face degrees differ";
  if (a.umbrellas != b.umbrellas) return AssertionFailure() << "the umbrellas differ";
  if (a.twins != b.twins) return AssertionFailure() << "the twins differ";
  if (a.vertices != b.vertices) return AssertionFailure() << "the vertices differ";
  if (a.flipped != b.flipped) return AssertionFailure() << "the flipped faces differ";
  if (a.umbrella_count != b.umbrella_count || a.vertex_count != b.vertex_count) {
    return AssertionFailure() << "the counts differ";
  }
  return AssertionSuccess();
}

AssertionResult isSameMesh(const Encoded& encoded, const Connectivity& decoded, PolygonView input) {
  if (!isPermutation(encoded.vertex_order, input.vertex_count)) return AssertionFailure() << "vertex_order is none";
  if (!isPermutation(encoded.face_order, input.face_degrees.size())) return AssertionFailure() << "face_order is none";
  if (!isPermutation(encoded.corner_order, input.corners.size())) return AssertionFailure() << "corner_order is none";

  std::vector<Index> corner_of;
  const Polygons polygons = polygonsOf(decoded, &corner_of);
  if (polygons.vertex_count != input.vertex_count) return AssertionFailure() << polygons.vertex_count << " vertices";
  if (polygons.face_degrees.size() != input.face_degrees.size()) return AssertionFailure() << "face count";
  if (polygons.corners.size() != input.corners.size()) return AssertionFailure() << "corner count";
  if (!isPermutation(corner_of, input.corners.size())) return AssertionFailure() << "corner_of is no permutation";

  const std::vector<size_t> first = firstCorners(input.face_degrees);
  const std::vector<Index> next = nextCorners(input.face_degrees);
  size_t corner = 0;
  for (size_t face = 0; face < polygons.face_degrees.size(); ++face) {
    const Index degree = polygons.face_degrees[face], source = encoded.face_order[face];
    if (degree != input.face_degrees[source]) return AssertionFailure() << "degree of face " << face;
    const auto sourceOf = [&](Index i) { return encoded.corner_order[corner_of[corner + i % degree]]; };
    for (Index i = 0; i < degree; ++i) {
      const Index here = sourceOf(i);
      if (here < first[source] || here >= first[source + 1]) return AssertionFailure() << "corner of another face";
      if (sourceOf(i + 1) != next[here]) return AssertionFailure() << "corners of face " << face << " out of order";
      if (encoded.vertex_order[polygons.corners[corner + i]] != input.corners[here]) {
        return AssertionFailure() << "corner " << i << " of face " << face << " has another vertex";
      }
    }
    corner += degree;
  }
  return AssertionSuccess();
}

AssertionResult roundTrips(PolygonView input, const EncodeOptions& options) {
  const Result<Encoded> encoded = encode(input, options);
  if (!encoded) return AssertionFailure() << "encode: " << describe(encoded.error());
  if (AssertionResult result = isValid(encoded->connectivity); !result) return result << " (while encoding)";
  const Result<Connectivity> decoded = decode(encoded->bytes);
  if (!decoded) return AssertionFailure() << "decode: " << describe(decoded.error());
  if (AssertionResult result = areEqual(encoded->connectivity, *decoded); !result) return result;
  return isSameMesh(*encoded, *decoded, input);
}

AssertionResult isHarmless(std::span<const uint8_t> bytes) {
  const auto exact = std::make_unique<uint8_t[]>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), exact.get());
  Limits limits;
  limits.max_vertices = limits.max_faces = 1u << 20;
  limits.max_corners = 1u << 22;
  static Decoder decoder;  // sees the remains of all kinds of damage
  const Result<Connectivity> decoded = decoder.decode({exact.get(), bytes.size()}, limits);
  if (!decoded) {
    if (decoded.error() == Error::kNone) return AssertionFailure() << "refused without a reason";
    return AssertionSuccess();
  }
  if (decoded->vertex_count > limits.max_vertices || decoded->face_degrees.size() > limits.max_faces ||
      decoded->umbrellas.size() > limits.max_corners) {
    return AssertionFailure() << "larger than the limits";
  }
  return isValid(*decoded);
}

}  // namespace tutte
