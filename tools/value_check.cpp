#include "tools/value_check.h"

#include <algorithm>
#include <cmath>

namespace tutte {
namespace {

const FlatAttribute* find(const FlatScene& scene, const std::string& name) {
  for (const FlatAttribute& attribute : scene.attributes) {
    if (attribute.name == name) return &attribute;
  }
  return nullptr;
}

}  // namespace

ValueCheck::ValueCheck(const FlatScene& a, const FlatScene& b, const std::set<std::string>& names) : a_(a), b_(b) {
  const auto wanted = [&](const FlatAttribute& attribute) { return names.empty() || names.count(attribute.name); };
  for (const FlatAttribute& attribute : a.attributes) {
    if (!wanted(attribute)) continue;
    if (const FlatAttribute* other = find(b, attribute.name)) {
      pairs_.push_back({attribute, *other});
    } else {
      missing_ = attribute.name + " is in the first file only";
    }
  }
  for (const FlatAttribute& attribute : b.attributes) {
    if (wanted(attribute) && !find(a, attribute.name)) missing_ = attribute.name + " is in the second file only";
  }
}

bool ValueCheck::samePlace(Index vertex_a, Index vertex_b) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double x = a_.positions[vertex_a][axis], y = b_.positions[vertex_b][axis];
    if (!(std::abs(x - y) <= a_.tolerances[vertex_a]) && x != y && !(std::isnan(x) && std::isnan(y))) return false;
  }
  return true;
}

const char* ValueCheck::differing(Index wedge_a, Index wedge_b) const {
  const Index mesh_a = a_.wedge_meshes[wedge_a], mesh_b = b_.wedge_meshes[wedge_b];
  for (const Pair& pair : pairs_) {
    const bool same_meshes = pair.a.given[mesh_a] == pair.b.given[mesh_b];
    const bool exact = !pair.a.bits.empty() && pair.a.given[mesh_a] && same_meshes;
    if (exact && (pair.a.types[mesh_a] != pair.b.types[mesh_b] || !sameBits(pair, wedge_a, wedge_b))) {
      return pair.a.name.c_str();
    }
    if (!same_meshes || !sameValue(pair, wedge_a, wedge_b, pair.a.tolerances[mesh_a])) return pair.a.name.c_str();
  }
  return nullptr;
}

std::vector<std::string> ValueCheck::names() const {
  std::vector<std::string> result{"POSITION"};
  for (const Pair& pair : pairs_) result.push_back(pair.a.name);
  return result;
}

void ValueCheck::gauge(Index vertex_a, Index vertex_b, Index wedge_a, Index wedge_b,
                       std::vector<double>& errors) const {
  const auto raise = [](double& error, double x, double y) {
    if (const double off = std::abs(x - y); off > error) error = off;
  };
  for (int axis = 0; axis < 3; ++axis) raise(errors[0], a_.positions[vertex_a][axis], b_.positions[vertex_b][axis]);
  for (size_t p = 0; p < pairs_.size(); ++p) {
    const Pair& pair = pairs_[p];
    for (int i = 0; i < std::min(pair.a.components, pair.b.components); ++i) {
      raise(errors[p + 1], pair.a.values[size_t{wedge_a} * pair.a.components + i],
            pair.b.values[size_t{wedge_b} * pair.b.components + i]);
    }
  }
}

bool ValueCheck::sameBits(const Pair& pair, Index wedge_a, Index wedge_b) {
  return pair.a.components == pair.b.components &&
         std::equal(pair.a.bits.begin() + ptrdiff_t{wedge_a} * pair.a.components,
                    pair.a.bits.begin() + ptrdiff_t{wedge_a + 1} * pair.a.components,
                    pair.b.bits.begin() + ptrdiff_t{wedge_b} * pair.b.components);
}

bool ValueCheck::sameValue(const Pair& pair, Index wedge_a, Index wedge_b, double tolerance) {
  const int most = std::max(pair.a.components, pair.b.components);
  for (int i = 0; i < most; ++i) {
    // A fourth component that is not there is 1: OBJ has no opacity.
    const float x = i < pair.a.components ? pair.a.values[size_t{wedge_a} * pair.a.components + i] : 1.0f;
    const float y = i < pair.b.components ? pair.b.values[size_t{wedge_b} * pair.b.components + i] : 1.0f;
    if (!(std::abs(x - y) <= tolerance) && x != y && !(std::isnan(x) && std::isnan(y))) return false;
  }
  return true;
}

}  // namespace tutte
