#pragma once
// Whether positions and attributes of two scenes agree.

#include <set>
#include <string>
#include <vector>

#include "tools/flat_scene.h"

namespace tutte {

/// Compares values within A's tolerances, or bit for bit where the scenes have bits. Refers to both scenes.
class ValueCheck {
 public:
  /// `names`: the attributes to compare; empty: all.
  ValueCheck(const FlatScene& a, const FlatScene& b, const std::set<std::string>& names);

  /// An attribute that only one scene has, as a sentence; or nothing.
  const std::string& missing() const { return missing_; }

  bool samePlace(Index vertex_a, Index vertex_b) const;

  /// The attributes that are compared: POSITION first.
  std::vector<std::string> names() const;

  /// Raises errors[i] to the largest difference of a component of attribute names()[i] between these.
  void gauge(Index vertex_a, Index vertex_b, Index wedge_a, Index wedge_b, std::vector<double>& errors) const;

  /// The first attribute in which two wedges differ, or nullptr.
  const char* differing(Index wedge_a, Index wedge_b) const;

 private:
  /// Attributes of A and B with the same name.
  struct Pair {
    const FlatAttribute& a;
    const FlatAttribute& b;
  };

  static bool sameValue(const Pair& pair, Index wedge_a, Index wedge_b, double tolerance);
  static bool sameBits(const Pair& pair, Index wedge_a, Index wedge_b);

  const FlatScene& a_;
  const FlatScene& b_;
  std::vector<Pair> pairs_;
  std::string missing_;
};

}  // namespace tutte
