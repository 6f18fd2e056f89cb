#pragma once
// Whether two scenes hold the same polygons and attributes, up to order.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "gltf_ext/pack.h"
#include "gltf_ext/scene.h"

namespace tutte {

struct CompareOptions {
  PackOptions bits;                        ///< how B was quantised; tolerances follow from A's extents
  std::map<std::string, double> bounds{};  ///< per attribute: how far a component may be off, instead
  double tolerance = -1;                   ///< of positions, in units of the scene; below 0: as `bits` says
  std::set<std::string> attributes;        ///< compare only these, and positions; empty: all
  bool exact = false;                      ///< attributes must have the same types and bits; nothing above counts
  bool vertices_matter = true;             ///< which corners share a vertex is compared, too; otherwise only places
};

/// How far the values of an attribute are apart.
struct AttributeError {
  std::string name;
  double largest = 0;  ///< difference of a component
};

struct Comparison {
  bool same = false;
  std::string difference;  ///< where they first differ, as a sentence
  size_t vertices = 0, faces = 0, wedges_a = 0, wedges_b = 0;
  std::vector<AttributeError> errors;  ///< (same) of every attribute, POSITION first; of positions in the scene's space
};

/// Looks for a one-to-one relation of A's and B's vertices and faces under which polygons have the same corners in the
/// same cyclic order, interior rings belong to the same polygons, and positions and attributes are within tolerance.
/// Vertices without polygons count. Order, first corners, wedges and materials do not.
///
/// Works for any mesh: coincident vertices, duplicate and degenerate faces are told apart by what is around them.
/// O(n log n) unless large parts are indistinguishable; then candidates are tried in turn, up to a bound.
Comparison compare(const Scene& a, const Scene& b, const CompareOptions& options);

}  // namespace tutte
