#include <cmath>
#include <numbers>

#include "tests/shapes/shapes.h"

namespace tutte::shapes {
namespace {

Position onCircle(Index i, Index count, float z) {
  const double angle = 2 * std::numbers::pi * i / count;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), z};
}

std::vector<Index> range(Index first, Index count) {
  std::vector<Index> list(count);
  for (Index i = 0; i < count; ++i) list[i] = first + i;
  return list;
}

std::vector<Index> reversed(const std::vector<Index>& list) { return {list.rbegin(), list.rend()}; }

}  // namespace

Shape tetrahedron() {
  Shape shape;
  for (Position p : {Position{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}) shape.addVertex(p);
  for (auto face : {std::array<Index, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    shape.addFace({face[0], face[1], face[2]});
  }
  return shape;
}

Shape cube() { return prism(4); }

Shape octahedron() { return dual(cube()); }

Shape dodecahedron() { return dual(icosahedron()); }

Shape icosahedron() {
  Shape shape;
  const Index top = shape.addVertex({0, 0, 1.25f});
  for (Index i = 0; i < 5; ++i) shape.addVertex(onCircle(2 * i, 10, 0.5f));
  for (Index i = 0; i < 5; ++i) shape.addVertex(onCircle(2 * i + 1, 10, -0.5f));
  const Index bottom = shape.addVertex({0, 0, -1.25f});
  for (Index i = 0; i < 5; ++i) {
    const Index a = 1 + i, b = 1 + (i + 1) % 5, c = 6 + i, d = 6 + (i + 1) % 5;
    shape.addFace({top, a, b});
    shape.addFace({a, c, b});
    shape.addFace({b, c, d});
    shape.addFace({c, bottom, d});
  }
  return shape;
}

Shape prism(Index sides) {
  Shape shape;
  for (Index i = 0; i < sides; ++i) shape.addVertex(onCircle(i, sides, 0));
  for (Index i = 0; i < sides; ++i) shape.addVertex(onCircle(i, sides, 1));
  shape.addFace(reversed(range(0, sides)));
  shape.addFace(range(sides, sides));
  for (Index i = 0; i < sides; ++i) {
    const Index j = (i + 1) % sides;
    shape.addFace({i, j, sides + j, sides + i});
  }
  return shape;
}

Shape pyramid(Index sides) {
  Shape shape;
  for (Index i = 0; i < sides; ++i) shape.addVertex(onCircle(i, sides, 0));
  const Index top = shape.addVertex({0, 0, 1});
  shape.addFace(reversed(range(0, sides)));
  for (Index i = 0; i < sides; ++i) shape.addFace({i, (i + 1) % sides, top});
  return shape;
}

Shape dihedron(Index sides) {
  Shape shape = disc(sides);
  shape.addFace(reversed(range(0, sides)));
  return shape;
}

Shape disc(Index sides) {
  Shape shape;
  for (Index i = 0; i < sides; ++i) shape.addVertex(onCircle(i, sides, 0));
  shape.addFace(range(0, sides));
  return shape;
}

}  // namespace tutte::shapes
