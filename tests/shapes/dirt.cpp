#include "tests/shapes/shapes.h"

namespace tutte::shapes {

Shape book(Index pages) {
  Shape shape;
  const Index a = shape.addVertex({0, 0, 0}), b = shape.addVertex({0, 0, 1});
  for (Index i = 0; i < pages; ++i) shape.addFace({a, b, shape.addVertex({1, float(i), 0})});
  return shape;
}

Shape bowTie(Index pieces) {
  Shape shape;
  const Index top = shape.addVertex({0, 0, 0});
  for (Index i = 0; i < pieces; ++i) {
    const float x = 3 * float(i);
    const Index a = shape.addVertex({x, 0, 1}), b = shape.addVertex({x + 1, 0, 1}), c = shape.addVertex({x, 1, 1});
    shape.addFace({a, b, c});
    shape.addFace({b, a, top});
    shape.addFace({c, b, top});
    shape.addFace({a, c, top});
  }
  return shape;
}

Shape triangleHub(Index triangles) {
  Shape shape;
  const Index hub = shape.addVertex({0, 0, 0});
  for (Index i = 0; i < triangles; ++i) {
    const Index a = shape.addVertex({float(i), 1, 0});
    shape.addFace({hub, a, shape.addVertex({float(i), 1, 1})});
  }
  return shape;
}

Shape fan(Index triangles, bool closed) {
  Shape shape;
  const Index hub = shape.addVertex({0, 0, 0});
  const Index rim = triangles + (closed ? 0 : 1);
  for (Index i = 0; i < rim; ++i) shape.addVertex({float(i), float(i * i % 7), 1});
  for (Index i = 0; i < triangles; ++i) shape.addFace({hub, 1 + i, 1 + (i + 1) % rim});
  return shape;
}

Shape orientationConflict() {
  Shape shape;
  for (Index i = 0; i < 4; ++i) shape.addVertex({float(i & 1), float(i >> 1), 0});
  shape.addFace({0, 1, 2});
  shape.addFace({1, 2, 3});
  return shape;
}

Shape duplicateFaces(bool opposite) {
  Shape shape = tetrahedron();
  const std::vector<Index> first(shape.mesh.corners.begin(), shape.mesh.corners.begin() + 3);
  shape.addFace(opposite ? std::vector<Index>(first.rbegin(), first.rend()) : first);
  return shape;
}

Shape twoSided(const Shape& shape) {
  Shape result;
  result.positions = shape.positions;
  result.mesh.vertex_count = shape.mesh.vertex_count;
  auto corner = shape.mesh.corners.begin();
  for (const Index degree : shape.mesh.face_degrees) {
    const std::vector<Index> face(corner, corner + degree);
    result.addFace(face);
    result.addFace(std::vector<Index>(face.rbegin(), face.rend()));
    corner += degree;
  }
  return result;
}

Shape repeatedVertex(bool adjacent) {
  Shape shape = quadGrid(3, 3);
  if (adjacent) {
    shape.addFace({0, 0, 1});
    shape.addFace({2, 3, 3, 3, 7});
    shape.addFace({5, 5, 5});
  } else {
    shape.addFace({0, 4, 0, 1});
    shape.addFace({1, 2, 3, 1, 5, 6});
    shape.addFace({7, 8, 7, 8});
  }
  return shape;
}

Shape smallFaces() {
  Shape shape = disc(4);
  shape.addFace({});
  shape.addFace({2});
  shape.addFace({1, 2});
  shape.addFace({});
  shape.addFace({3, 3});
  shape.addFace({shape.addVertex({5, 5, 5}), 0});
  return shape;
}

Shape isolatedVertices() {
  const Shape solid = cube();
  Shape shape;
  for (Index i = 0; i < 3 * solid.mesh.vertex_count; ++i) shape.addVertex({float(i), 0, 0});
  shape.mesh.face_degrees = solid.mesh.face_degrees;
  for (Index vertex : solid.mesh.corners) shape.mesh.corners.push_back(3 * vertex + 1);
  return shape;
}

Shape doubleEdges() {
  Shape shape;
  for (Index i = 0; i < 6; ++i) shape.addVertex({float(i % 3), float(i / 3), 0});
  shape.addFace({0, 1, 2, 3});
  shape.addFace({1, 0, 4});
  shape.addFace({3, 2, 1, 0, 5});
  return shape;
}

Shape selfGluedFace() {
  Shape shape;
  for (Index i = 0; i < 5; ++i) shape.addVertex({float(i), float(i * i), 0});
  shape.addFace({0, 1, 2, 1, 3});
  shape.addFace({3, 1, 0, 4});
  return shape;
}

}  // namespace tutte::shapes
