#include <cmath>
#include <numbers>

#include "tests/shapes/shapes.h"

namespace tutte::shapes {
namespace {

/// A lattice of (columns + 1) x (rows + 1) points, or of columns x rows points when it closes to a torus.
struct Lattice {
  Index columns, rows;
  bool torus;

  Index width() const { return torus ? columns : columns + 1; }
  Index height() const { return torus ? rows : rows + 1; }
  Index at(Index x, Index y) const { return y % height() * width() + x % width(); }

  Position position(Index x, Index y) const {
    if (!torus) return {static_cast<float>(x), static_cast<float>(y), static_cast<float>((x * x + y) % 5) * 0.1f};
    const double u = 2 * std::numbers::pi * x / columns, v = 2 * std::numbers::pi * y / rows;
    const double radius = 2 + std::cos(v);
    return {static_cast<float>(radius * std::cos(u)), static_cast<float>(radius * std::sin(u)),
            static_cast<float>(std::sin(v))};
  }
};

Shape grid(Lattice lattice, bool triangles) {
  Shape shape;
  for (Index y = 0; y < lattice.height(); ++y) {
    for (Index x = 0; x < lattice.width(); ++x) shape.addVertex(lattice.position(x, y));
  }
  for (Index y = 0; y < lattice.rows; ++y) {
    for (Index x = 0; x < lattice.columns; ++x) {
      const Index a = lattice.at(x, y), b = lattice.at(x + 1, y), c = lattice.at(x + 1, y + 1),
                  d = lattice.at(x, y + 1);
      if (triangles) {
        shape.addFace({a, b, c});
        shape.addFace({a, c, d});
      } else {
        shape.addFace({a, b, c, d});
      }
    }
  }
  return shape;
}

}  // namespace

Shape quadGrid(Index columns, Index rows) { return grid({columns, rows, false}, false); }
Shape triangleGrid(Index columns, Index rows) { return grid({columns, rows, false}, true); }
Shape hexGrid(Index columns, Index rows) { return dual(triangleGrid(columns + 1, rows + 1)); }
Shape quadTorus(Index columns, Index rows) { return grid({columns, rows, true}, false); }
Shape triangleTorus(Index columns, Index rows) { return grid({columns, rows, true}, true); }
Shape hexTorus(Index columns, Index rows) { return dual(triangleTorus(columns, rows)); }

Shape moebiusStrip(Index quads) {
  Shape shape;
  shape.mesh.vertex_count = 2 * quads;
  for (Index i = 0; i < quads; ++i) {
    const bool last = i + 1 == quads;
    const Index a = 2 * i, b = 2 * i + 1;
    shape.addFace({a, last ? 1 : a + 2, last ? 0 : b + 2, b});
  }
  return shape;
}

Shape kleinBottle(Index columns, Index rows) {
  Shape shape;
  shape.mesh.vertex_count = columns * rows;
  const auto at = [&](Index x, Index y) {
    return y < rows ? y * columns + x % columns : (columns - x % columns) % columns;
  };
  for (Index y = 0; y < rows; ++y) {
    for (Index x = 0; x < columns; ++x) shape.addFace({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
  }
  return shape;
}

Shape pinchedTorus(Index columns, Index rows) {
  Shape shape;
  shape.mesh.vertex_count = columns * (rows - 1) + 1;
  const auto at = [&](Index x, Index y) { return y % rows == 0 ? 0 : 1 + (y - 1) * columns + x % columns; };
  for (Index y = 0; y < rows; ++y) {
    for (Index x = 0; x < columns; ++x) {
      if (y == 0) {
        shape.addFace({at(x, 0), at(x + 1, 1), at(x, 1)});
      } else if (y + 1 == rows) {
        shape.addFace({at(x, y), at(x + 1, y), at(x, y + 1)});
      } else {
        shape.addFace({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
      }
    }
  }
  return shape;
}

}  // namespace tutte::shapes
