#include "tests/shapes/shapes.h"

namespace tutte::shapes {

Index Shape::addVertex(Position position) {
  positions.push_back(position);
  return mesh.vertex_count++;
}

void Shape::addFace(const std::vector<Index>& corners) {
  mesh.face_degrees.push_back(static_cast<Index>(corners.size()));
  mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
}

uint64_t Random::next() {
  uint64_t z = state_ += 0x9E3779B97F4A7C15u;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
  z = (z ^ z >> 27) * 0x94D049BB133111EBu;
  return z ^ z >> 31;
}

std::vector<Named> cleanShapes() {
  std::vector<Named> list = {
      {"tetrahedron", tetrahedron()},
      {"cube", cube()},
      {"octahedron", octahedron()},
      {"dodecahedron", dodecahedron()},
      {"icosahedron", icosahedron()},
      {"prism_3", prism(3)},
      {"prism_100", prism(100)},
      {"pyramid_5", pyramid(5)},
      {"pyramid_1000", pyramid(1000)},
      {"triangle", disc(3)},
      {"polygon_1000", disc(1000)},
      {"quad_grid", quadGrid(9, 7)},
      {"triangle_grid", triangleGrid(8, 8)},
      {"hex_grid", hexGrid(10, 6)},
      {"quad_torus", quadTorus(12, 5)},
      {"quad_torus_3x3", quadTorus(3, 3)},
      {"triangle_torus", triangleTorus(7, 11)},
      {"hex_torus", hexTorus(6, 8)},
      {"sponge_1", sponge(1)},
      {"sponge_3", sponge(3)},
      {"plate", plate(6, 5)},
      {"perforated_grid", perforatedGrid(5, 4)},
      {"cubes", copies(cube(), 50)},
      {"tori", copies(triangleTorus(4, 5), 7)},
      {"islands", islands(200)},
      {"comb", comb(60)},
      {"fan_open", fan(40, false)},
      {"fan_closed", fan(40, true)},
      {"perforated_dual", dual(perforatedGrid(6, 6))},
  };
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const Shape triangles = randomTriangulation(static_cast<Index>(20 * seed), seed);
    const std::string tag = "_" + std::to_string(seed);
    list.push_back({"random_triangles" + tag, triangles});
    list.push_back({"random_cubic" + tag, dual(triangles)});
    list.push_back({"random_polygons" + tag, mergeFaces(triangles, static_cast<Index>(10 * seed), seed)});
    list.push_back({"shuffled_sponge" + tag, shuffle(sponge(2), seed)});
  }
  return list;
}

std::vector<Named> dirtyShapes() {
  std::vector<Named> list = {
      {"empty", Shape{}},
      {"dihedron", dihedron(3)},
      {"dihedron_50", dihedron(50)},
      {"book_3", book(3)},
      {"book_4", book(4)},
      {"book_101", book(101)},
      {"bow_tie_2", bowTie(2)},
      {"bow_tie_30", bowTie(30)},
      {"triangle_hub", triangleHub(300)},
      {"orientation_conflict", orientationConflict()},
      {"moebius_5", moebiusStrip(5)},
      {"moebius_40", moebiusStrip(40)},
      {"klein_bottle", kleinBottle(6, 5)},
      {"duplicate_faces", duplicateFaces(false)},
      {"opposite_faces", duplicateFaces(true)},
      {"two_sided_torus", twoSided(triangleTorus(7, 5))},
      {"two_sided_sheet", twoSided(perforatedGrid(2, 2))},
      {"repeated_vertex", repeatedVertex(false)},
      {"repeated_vertex_adjacent", repeatedVertex(true)},
      {"small_faces", smallFaces()},
      {"isolated_vertices", isolatedVertices()},
      {"pinched_torus", pinchedTorus(8, 6)},
      {"voxels", voxelsTouchingAtEdges(4)},
      {"double_edges", doubleEdges()},
      {"self_glued_face", selfGluedFace()},
  };
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const std::string tag = "_" + std::to_string(seed);
    list.push_back({"flipped_sponge" + tag, flipFaces(sponge(1), static_cast<Index>(seed), seed)});
    list.push_back({"torn" + tag, removeFaces(randomTriangulation(80, seed), static_cast<Index>(6 * seed), seed)});
    list.push_back({"soup" + tag, soup(10, static_cast<Index>(5 * seed), 0, 6, seed)});
    list.push_back({"triangle_soup" + tag, soup(static_cast<Index>(4 + seed), 40, 3, 3, seed)});
  }
  return list;
}

std::vector<Named> allShapes() {
  std::vector<Named> list = cleanShapes();
  for (Named& shape : dirtyShapes()) list.push_back(std::move(shape));
  return list;
}

}  // namespace tutte::shapes
