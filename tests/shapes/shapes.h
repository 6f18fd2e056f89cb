#pragma once
// Procedural meshes for tests: every function makes one mesh, the same on every machine.

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "codec/mesh.h"

namespace tutte::shapes {

using Position = std::array<float, 3>;

/// A mesh under construction. `positions` has one entry per vertex, or none where the mesh lives in no space.
struct Shape {
  Polygons mesh;
  std::vector<Position> positions;

  Index addVertex() { return mesh.vertex_count++; }
  Index addVertex(Position position);
  void addFace(std::initializer_list<Index> corners) { addFace(std::vector<Index>(corners)); }
  void addFace(const std::vector<Index>& corners);
};

struct Named {
  std::string name;
  Shape shape;
};

/// A small generator of random numbers: SplitMix64.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t next();
  /// Below `count`, which is not 0.
  Index below(Index count) { return static_cast<Index>(next() % count); }

 private:
  uint64_t state_;
};

// solids.cpp: closed, genus 0.
Shape tetrahedron();
Shape cube();
Shape octahedron();
Shape dodecahedron();
Shape icosahedron();
Shape prism(Index sides);
Shape pyramid(Index sides);
/// Two polygons back to back: every vertex has valence 2.
Shape dihedron(Index sides);

// grids.cpp: sheets with one boundary, and tori.
Shape quadGrid(Index columns, Index rows);
Shape triangleGrid(Index columns, Index rows);
Shape hexGrid(Index columns, Index rows);
/// At least 3 columns and 3 rows.
Shape quadTorus(Index columns, Index rows);
Shape triangleTorus(Index columns, Index rows);
Shape hexTorus(Index columns, Index rows);

// topology.cpp: handles, holes, components.
/// A cube of (2 * holes + 1)^3 cells, with holes^2 shafts along each axis.
Shape sponge(Index holes);
/// A plate with columns * rows shafts: of that genus.
Shape plate(Index columns, Index rows);
/// A sheet of quads with columns * rows holes.
Shape perforatedGrid(Index columns, Index rows);
Shape copies(const Shape& shape, Index count);
Shape islands(Index triangles);
/// A long strip of quads with a tooth on every second one.
Shape comb(Index teeth);
/// One polygon alone.
Shape disc(Index sides);
/// Faces become vertices and inner vertices become faces; boundary vertices vanish.
Shape dual(const Shape& shape);

// random.cpp
/// A closed triangulation of the sphere without double edges; at least 4 vertices.
Shape randomTriangulation(Index vertices, uint64_t seed);
/// Removes up to `count` random edges, each time merging two faces that share nothing else.
Shape mergeFaces(const Shape& shape, Index count, uint64_t seed);
/// Removes `count` random faces; what is left may have bow-ties and isolated vertices.
Shape removeFaces(const Shape& shape, Index count, uint64_t seed);
/// Renames vertices, reorders faces and rotates corners at random; does not change the mesh.
Shape shuffle(const Shape& shape, uint64_t seed);
/// Turns random faces round.
Shape flipFaces(const Shape& shape, Index count, uint64_t seed);
/// Faces of degree `min_degree` to `max_degree` over random vertices, in any order and with any repetition.
Shape soup(Index vertices, Index faces, Index min_degree, Index max_degree, uint64_t seed);

// planar.cpp: uniform among all rooted ones of their size.
/// Of closed triangulations of the sphere without double edges; at least 4 vertices. O(vertices).
Shape uniformTriangulation(Index vertices, uint64_t seed);
/// Of polyhedra (3-connected planar maps); 6 edges or at least 8. O(edges) on average. No positions.
Shape uniformPolyhedron(Index edges, uint64_t seed);

// refinement.cpp: no positions.
/// Every triangle into four, again and again.
Shape subdivideTriangles(const Shape& shape, Index times);
/// The first step of Catmull-Clark subdivision: a quad for every corner.
Shape subdivideToQuads(const Shape& shape);
/// A closed mesh of quads, tessellated as a renderer does it with subdivision surfaces: grids of 4^deepest quads in
/// `features` random quads, coarser by one level every `width` steps away from them, conforming triangles in between.
Shape adaptiveTessellation(const Shape& quads, Index features, Index deepest, Index width, uint64_t seed);

// dirt.cpp: what real files hold although no surface does.
Shape book(Index pages);                  ///< `pages` triangles at one edge
Shape bowTie(Index pieces);               ///< `pieces` tetrahedra at one vertex
Shape triangleHub(Index triangles);       ///< triangles that share one vertex and nothing else
Shape fan(Index triangles, bool closed);  ///< triangles round one vertex
Shape orientationConflict();              ///< two triangles that run the same way along their edge
Shape moebiusStrip(Index quads);
Shape kleinBottle(Index columns, Index rows);
Shape duplicateFaces(bool opposite);            ///< a tetrahedron with one face twice
Shape twoSided(const Shape& shape);             ///< every face has a back, stored after it
Shape repeatedVertex(bool adjacent);            ///< faces with a vertex twice, among others
Shape smallFaces();                             ///< faces of degree 0, 1 and 2 beside a quad
Shape isolatedVertices();                       ///< a cube with vertices before, among and after its own
Shape pinchedTorus(Index columns, Index rows);  ///< a torus with one ring of vertices welded to a point
Shape voxelsTouchingAtEdges(Index size);        ///< a checkerboard of cubes: edges of four faces
Shape doubleEdges();                            ///< faces that share two separate edges
Shape selfGluedFace();                          ///< a face that meets itself along an edge

/// Meshes that are manifold, oriented and without repeated vertices in a face.
std::vector<Named> cleanShapes();
/// Meshes that are not, or hardly.
std::vector<Named> dirtyShapes();
/// Both.
std::vector<Named> allShapes();

}  // namespace tutte::shapes
