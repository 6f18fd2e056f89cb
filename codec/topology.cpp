#include "codec/topology.h"

#include <algorithm>
#include <utility>

namespace tutte {
namespace {

constexpr Index kMaxCorners = 1u << 30;

Error check(PolygonView mesh) {
  if (mesh.corners.size() > kMaxCorners || mesh.face_degrees.size() > kMaxCorners || mesh.vertex_count > kMaxCorners) {
    return Error::kTooLarge;
  }
  uint64_t sum = 0;
  for (const Index degree : mesh.face_degrees) sum += degree;
  if (sum != mesh.corners.size()) return Error::kCountMismatch;
  for (const Index vertex : mesh.corners) {
    if (vertex >= mesh.vertex_count) return Error::kIndexOutOfRange;
  }
  return Error::kNone;
}

// Faces of degree 3 and more; the others are noted as strays.
void collectFaces(PolygonView mesh, Topology& topology) {
  FaceCorners& faces = topology.faces;
  faces.first.reserve(mesh.face_degrees.size() + 1);
  faces.first.push_back(0);
  const bool any_stray = std::any_of(mesh.face_degrees.begin(), mesh.face_degrees.end(), [](Index d) { return d < 3; });
  if (!any_stray) faces.vertex.assign(mesh.corners.begin(), mesh.corners.end());
  Index corner = 0, kept = 0;
  for (Index f = 0; f < mesh.face_degrees.size(); corner += mesh.face_degrees[f++]) {
    const Index degree = mesh.face_degrees[f];
    if (degree < 3) {
      topology.strays.push_back(f);
      continue;
    }
    faces.first.push_back(kept += degree);
    if (!any_stray) continue;
    topology.source_face.push_back(f);
    for (Index i = 0; i < degree; ++i) {
      faces.vertex.push_back(mesh.corners[corner + i]);
      topology.source_corner.push_back(corner + i);
    }
  }
  faces.triangles = std::all_of(mesh.face_degrees.begin(), mesh.face_degrees.end(), [](Index d) { return d <= 3; });
  if (!faces.triangles) faces.listFaces();
  topology.real_faces = faces.faceCount();
}

// Marks the faces that repeat a vertex; empty when none does.
std::vector<uint8_t> findRepeating(const FaceCorners& faces, Index vertex_count) {
  constexpr Index kFew = 8;  // vertices that are quicker compared with each other
  std::vector<uint8_t> repeating;
  std::vector<Index> last_face;
  for (Index f = 0; f < faces.faceCount(); ++f) {
    const Index first = faces.first[f], end = faces.first[f + 1];
    bool repeats = false;
    if (end - first <= kFew) {
      for (Index c = first + 1; c < end; ++c) {
        for (Index before = first; before < c; ++before) repeats |= faces.vertex[c] == faces.vertex[before];
      }
    } else {
      last_face.resize(vertex_count, kNone);
      for (Index c = first; c < end; ++c) repeats |= std::exchange(last_face[faces.vertex[c]], f) == f;
    }
    if (!repeats) continue;
    repeating.resize(faces.faceCount());
    repeating[f] = 1;
  }
  return repeating;
}

// Which faces to turn round, so that as many as possible of the conflicting pairs agree: along a spanning forest, the
// smaller part of each component.
std::vector<uint8_t> chooseFlips(const FaceCorners& faces, const EdgePairs& pairs) {
  constexpr uint8_t kUnseen = 2;
  std::vector<uint8_t> flips(faces.faceCount(), kUnseen);
  std::vector<Index> component;
  for (Index root = 0; root < faces.faceCount(); ++root) {
    if (flips[root] != kUnseen) continue;
    flips[root] = 0;
    component.assign(1, root);
    size_t flipped = 0;
    for (size_t i = 0; i < component.size(); ++i) {
      const Index f = component[i];
      flipped += flips[f];
      for (Index c = faces.first[f]; c < faces.first[f + 1]; ++c) {
        const Index twin = pairs.twin[c];
        if (twin == kNone || flips[faces.faceOf(twin)] != kUnseen) continue;
        flips[faces.faceOf(twin)] = flips[f] ^ static_cast<uint8_t>(faces.vertex[c] == faces.vertex[twin]);
        component.push_back(faces.faceOf(twin));
      }
    }
    if (2 * flipped <= component.size()) continue;
    for (const Index f : component) flips[f] ^= 1;
  }
  return flips;
}

// Turns faces round: the first corner stays, the others are reversed.
void applyFlips(Topology& topology) {
  FaceCorners& faces = topology.faces;
  if (topology.source_corner.empty()) {
    topology.source_corner.resize(faces.vertex.size());
    for (Index c = 0; c < faces.vertex.size(); ++c) topology.source_corner[c] = c;
  }
  for (Index f = 0; f < faces.faceCount(); ++f) {
    if (!topology.flipped[f]) continue;
    std::reverse(faces.vertex.begin() + faces.first[f] + 1, faces.vertex.begin() + faces.first[f + 1]);
    std::reverse(topology.source_corner.begin() + faces.first[f] + 1,
                 topology.source_corner.begin() + faces.first[f + 1]);
  }
}

void pairFaces(Topology& topology, Index vertex_count) {
  const std::vector<uint8_t> isolated = findRepeating(topology.faces, vertex_count);
  EdgePairs pairs = pairEdges(topology.faces, vertex_count, isolated, true);
  if (pairs.conflicts) {
    topology.flipped = chooseFlips(topology.faces, pairs);
    applyFlips(topology);
    pairs = pairEdges(topology.faces, vertex_count, isolated, false);
    if (std::count(topology.flipped.begin(), topology.flipped.end(), 1) == 0) topology.flipped.clear();
  }
  topology.twin = std::move(pairs.twin);
}

// Numbers the umbrellas. A vertex's first umbrella keeps the vertex's number, so a manifold mesh is not rewritten.
void nameUmbrellas(Topology& topology, Index vertex_count) {
  FaceCorners& faces = topology.faces;
  const Index corners = static_cast<Index>(faces.vertex.size());
  const Index* const twins = topology.twin.data();
  Index* const vertices = faces.vertex.data();
  topology.valence.assign(vertex_count, 0);
  topology.vertex_of.resize(vertex_count);
  for (Index v = 0; v < vertex_count; ++v) topology.vertex_of[v] = v;
  std::vector<uint8_t> names(corners, 0);
  uint8_t* const named = names.data();
  for (Index c = 0; c < corners; ++c) {
    if (named[c]) continue;
    Index umbrella = vertices[c];
    if (topology.valence[umbrella] != 0) {
      topology.vertex_of.push_back(umbrella);
      umbrella = static_cast<Index>(topology.valence.size());
      topology.valence.push_back(0);
    }
    Index valence = 0;
    const auto name = [&](Index corner) {
      named[corner] = 1;
      vertices[corner] = umbrella;
      ++valence;
    };
    Index at = c;
    do {
      name(at);
      at = twins[faces.prev(at)];
    } while (at != kNone && at != c);
    if (at == kNone) {
      for (Index twin = twins[c]; twin != kNone; twin = twins[at]) name(at = faces.next(twin));
      ++valence;  // the dummy face's
    }
    topology.valence[umbrella] = valence;
  }
}

// Closes every hole with a dummy face. The dummy's edge along the open edge of corner c starts at that edge's far end.
void closeHoles(Topology& topology) {
  FaceCorners& faces = topology.faces;
  const Index real_corners = static_cast<Index>(faces.vertex.size());
  for (Index seed = 0; seed < real_corners; ++seed) {
    if (topology.twin[seed] != kNone) continue;
    if (faces.triangles) faces.listFaces();
    Index open = seed;
    do {
      const Index dummy = static_cast<Index>(faces.vertex.size());
      faces.vertex.push_back(faces.vertex[faces.next(open)]);
      faces.face.push_back(faces.faceCount());
      topology.twin.push_back(open);
      topology.twin[open] = dummy;
      // The open edge that ends where this one starts: round the umbrella, away from the hole.
      for (open = faces.prev(open);
           open != seed && topology.twin[open] != kNone && topology.twin[open] < real_corners;) {
        open = faces.prev(topology.twin[open]);
      }
    } while (topology.twin[open] == kNone);
    faces.first.push_back(static_cast<Index>(faces.vertex.size()));
  }
}

}  // namespace

Result<Topology> buildTopology(PolygonView mesh) {
  if (const Error error = check(mesh); error != Error::kNone) return error;
  Topology topology;
  collectFaces(mesh, topology);
  pairFaces(topology, mesh.vertex_count);
  nameUmbrellas(topology, mesh.vertex_count);
  closeHoles(topology);
  return topology;
}

}  // namespace tutte
