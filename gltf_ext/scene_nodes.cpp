#include "gltf_ext/scene_nodes.h"

namespace tutte {
namespace {

template <size_t N>
void readNumbers(const Json& object, const char* key, std::array<double, N>& values) {
  const Json* list = member(object, key);
  if (!list || !list->is_array() || list->size() != N) return;
  for (const Json& value : *list) {
    if (!value.is_number()) return;
  }
  for (size_t i = 0; i < N; ++i) values[i] = (*list)[i].get<double>();
}

/// Translation times rotation times scale.
Matrix compose(const std::array<double, 3>& t, const std::array<double, 4>& q, const std::array<double, 3>& s) {
  const auto [x, y, z, w] = q;
  return {s[0] * (1 - 2 * (y * y + z * z)),
          s[0] * 2 * (x * y + z * w),
          s[0] * 2 * (x * z - y * w),
          0,
          s[1] * 2 * (x * y - z * w),
          s[1] * (1 - 2 * (x * x + z * z)),
          s[1] * 2 * (y * z + x * w),
          0,
          s[2] * 2 * (x * z + y * w),
          s[2] * 2 * (y * z - x * w),
          s[2] * (1 - 2 * (x * x + y * y)),
          0,
          t[0],
          t[1],
          t[2],
          1};
}

Matrix matrixOf(const Json& node) {
  Matrix matrix = kIdentity;
  if (member(node, "matrix")) {
    readNumbers(node, "matrix", matrix);
    return matrix;
  }
  std::array<double, 3> translation = {0, 0, 0}, scale = {1, 1, 1};
  std::array<double, 4> rotation = {0, 0, 0, 1};
  readNumbers(node, "translation", translation);
  readNumbers(node, "rotation", rotation);
  readNumbers(node, "scale", scale);
  return compose(translation, rotation, scale);
}

Outcome<Done> readChildren(const Json& node, size_t index, size_t node_count, std::vector<Index>& parents,
                           SceneNode& result) {
  const Json* children = member(node, "children");
  if (!children || !children->is_array()) return Done{};
  for (const Json& child : *children) {
    const auto number = asInteger(child);
    const std::string where = pointerTo("nodes", index) + "/children";
    if (!number || *number >= node_count) return invalid(where, "a child does not exist");
    if (parents[*number] != kNone) return invalid(where, "a node has two parents");
    parents[*number] = static_cast<Index>(index);
    result.children.push_back(static_cast<Index>(*number));
  }
  return Done{};
}

/// With one parent at most for each node, a cycle is what cannot be reached from a root.
bool hasCycle(const std::vector<Index>& parents, const Scene& scene) {
  std::vector<Index> reached;
  for (Index i = 0; i < parents.size(); ++i) {
    if (parents[i] == kNone) reached.push_back(i);
  }
  for (size_t i = 0; i < reached.size(); ++i) {
    const auto& children = scene.nodes[reached[i]].children;
    reached.insert(reached.end(), children.begin(), children.end());
  }
  return reached.size() != parents.size();
}

}  // namespace

Outcome<Done> readNodes(const Json& json, const std::map<size_t, std::vector<Index>>& meshes_of, Scene& scene) {
  const size_t count = countOf(json, "nodes");
  std::vector<Index> parents(count, kNone);
  for (size_t i = 0; i < count; ++i) {
    const auto node = elementOf(json, "nodes", i);
    if (!node) return node.error();
    SceneNode result;
    result.name = stringMember(**node, "name");
    result.matrix = matrixOf(**node);
    const auto mesh = integerMember(**node, "mesh", "");
    const auto meshes = mesh ? meshes_of.find(*mesh) : meshes_of.end();
    if (meshes != meshes_of.end()) result.meshes = meshes->second;
    const auto children = readChildren(**node, i, count, parents, result);
    if (!children) return children;
    scene.nodes.push_back(std::move(result));
  }
  if (hasCycle(parents, scene)) return invalid("/nodes", "the nodes form a cycle");
  return Done{};
}

}  // namespace tutte
