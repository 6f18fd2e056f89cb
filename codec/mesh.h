#pragma once
// The meshes that go into and come out of the codec.

#include <cstdint>
#include <span>
#include <vector>

namespace tutte {

using Index = uint32_t;

/// "No vertex", "no corner", "no face".
inline constexpr Index kNone = 0xFFFFFFFFu;

/// A polygon mesh that somebody else owns. Face i has `face_degrees[i]` corners; the corners of all faces
/// follow each other in `corners`, each naming a vertex below `vertex_count`. Any degree is allowed, 0 to 2 too,
/// and any kind of dirt: repeated vertices, non-manifold edges, isolated vertices.
struct PolygonView {
  std::span<const Index> face_degrees;
  std::span<const Index> corners;
  Index vertex_count = 0;
};

/// The same, owned.
struct Polygons {
  std::vector<Index> face_degrees;
  std::vector<Index> corners;
  Index vertex_count = 0;

  operator PolygonView() const { return {face_degrees, corners, vertex_count}; }
};

/// What a decoder may build at most. Decoding stops with kLimitExceeded before it allocates more.
struct Limits {
  Index max_vertices = 1u << 28;
  Index max_faces = 1u << 28;
  Index max_corners = 1u << 30;
};

/// A component whose connectivity is an earlier one's: corner by corner, its `count` corners from `corner` on repeat
/// those from `original` on.
struct ComponentCopy {
  Index corner = 0, original = 0, count = 0;
};

/// The connectivity as both sides know it after the walk, in coded order: attributes are coded over it.
///
/// A vertex that is not manifold in the input is cut into several *umbrellas*, each with one fan of corners; a
/// manifold vertex has one umbrella. Umbrellas are numbered in the order in which the walk meets them, faces and
/// corners in the order in which it completes them. Faces with a conflicting orientation are turned round
/// (`flipped`), so that all edges that have two faces are manifold and consistently oriented.
///
/// Faces of degree below 3 come after all others; each of their corners is an umbrella of its own.
struct Connectivity {
  std::vector<Index> face_degrees;    ///< per face
  std::vector<Index> umbrellas;       ///< per corner: its umbrella, in coded orientation
  std::vector<Index> twins;           ///< per corner c: the corner at the far end's side of the edge from c to the next
                                      ///< corner of its face, i.e. the edge of the other face that runs backwards along
                                      ///< it; kNone on a boundary
  std::vector<Index> vertices;        ///< per umbrella: its vertex (numbered by first appearance); empty: the identity
  std::vector<uint8_t> flipped;       ///< per face: 1 when the input has it the other way round; empty: none is
  std::vector<ComponentCopy> copies;  ///< those that the streams name as such, by their first corners
  Index umbrella_count = 0;
  Index vertex_count = 0;  ///< isolated vertices included: they come last

  Index vertexOf(Index corner) const {
    const Index umbrella = umbrellas[corner];
    return vertices.empty() ? umbrella : vertices[umbrella];
  }
};

}  // namespace tutte
