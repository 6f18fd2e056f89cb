#pragma once
// How a polygon's triangles are told: the symbols of the triangulation section.

#include <algorithm>
#include <array>
#include <vector>

#include "codec/diagonal_model.h"
#include "codec/mesh.h"
#include "codec/model.h"
#include "codec/polygon_table.h"
#include "codec/triangulation_shape.h"

namespace tutte {

/// The symbols of the section, for both directions: what the port reads replaces what it is given.
template <class Port>
class TriangulationScript {
 public:
  TriangulationScript(Port& port, const Connectivity& mesh) : port_(port), diagonals_(mesh) {}

  /// Are there lists among polygons without holes? To be coded first.
  void header(bool lists) { lists_ = port_.code(32768, lists); }

  /// The kind of a polygon's triangulation, and what tells a fan or a tree. The triangles of a list follow by
  /// `listLength()` and `listTriangle()`.
  void polygon(const Polygon& polygon, Shape& shape) {
    shape.kind = kindOf(polygon, shape.kind);
    if (shape.kind == Kind::kFan) {
      shape.apex = fan(polygon.exterior, shape.apex);
    } else if (shape.kind == Kind::kTree) {
      tree(polygon.exterior.degree, shape.triangles);
    }
  }

  /// Of quads without holes nothing but the diagonal is coded.
  bool hasPlainQuads() const { return !lists_; }
  /// The corner at which a plain quad's fan starts.
  Index quad(Index first_corner, Index apex) { return diagonals_.code(port_, first_corner, apex); }

  /// The number of triangles of a list; then each of them.
  Index listLength(Index value) { return length_.code(port_, value); }
  void listTriangle(Index corner_count, Triangle& t) {
    for (Index& corner : t) corner = port_.uniform(corner_count, corner);
  }

 private:
  Kind kindOf(const Polygon& polygon, Kind kind) {
    const Index degree = polygon.exterior.degree;
    if (!polygon.holes.empty()) return Kind::kList;
    if (lists_ && list_[std::min(degree, 5u) - 3].code(port_, kind == Kind::kList)) return Kind::kList;
    if (degree < 5) return Kind::kFan;
    return fan_.code(port_, kind == Kind::kFan) ? Kind::kFan : Kind::kTree;
  }

  Index fan(const Ring& ring, Index apex) {
    if (ring.degree == 3) return 0;
    if (ring.degree == 4) return quad(ring.first, apex);
    return elsewhere_.code(port_, apex != 0) ? 1 + port_.uniform(ring.degree - 1, apex - 1) : 0;
  }

  void tree(Index degree, std::vector<Triangle>& triangles) {
    size_t next = 0;
    triangles.resize(degree - 2);
    walkTree(degree, stack_, [&](Index i, Index j) {
      Triangle& t = triangles[next++];
      t = {i, i + 1 + port_.uniform(j - i - 1, t[1] - i - 1), j};
      return t[1];
    });
  }

  Port& port_;
  DiagonalModel diagonals_;
  bool lists_ = false;
  std::array<Bit, 3> list_;
  Bit fan_, elsewhere_;
  NumberModel length_;
  std::vector<std::array<Index, 2>> stack_;
};

}  // namespace tutte
