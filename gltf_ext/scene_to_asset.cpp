// A scene to a compressed asset, without an uncompressed one in between.

#include <algorithm>
#include <map>

#include "gltf_ext/accessors.h"
#include "gltf_ext/buffers.h"
#include "gltf_ext/emit.h"
#include "gltf_ext/pack.h"
#include "gltf_ext/scene.h"
#include "gltf_ext/welding.h"

namespace tutte {
namespace {

/// Per group: whether it has a triangle. A glTF accessor cannot be empty, so that others get no primitive; their faces
/// are in the payload all the same.
std::vector<bool> drawnGroups(const PolygonMesh& mesh) {
  std::vector<bool> drawn(mesh.group_count);
  const ArraySource source = arraySourceOf(mesh);
  for (Index face = 0; face < mesh.polygons.face_degrees.size(); ++face) {
    if (source.triangleCount(face) > 0) drawn[mesh.groups.empty() ? 0 : mesh.groups[face]] = true;
  }
  return drawn;
}

bool hasPolygons(const PolygonMesh& mesh) {
  const auto& degrees = mesh.polygons.face_degrees;
  return !mesh.ring_owners.empty() ||
         std::any_of(degrees.begin(), degrees.end(), [](Index degree) { return degree != 3; });
}

class SceneWriter {
 public:
  SceneWriter(const Scene& scene, const CompressOptions& options)
      : scene_(scene), options_(options), emitter_(result_.asset, options.fallback) {}

  Outcome<Compressed> run() {
    result_.asset.json = {{"asset", {{"version", "2.0"}, {"generator", "tutte"}}}};
    addMaterials();
    const auto grids = planGrids(boxes(), options_.pack, options_.grid);
    if (!grids) return grids.error();
    for (size_t i = 0; i < scene_.meshes.size(); ++i) {
      const auto added = addMesh(i, (*grids)[i]);
      if (!added) return added.error();
    }
    addNodes();
    emitter_.finish();
    const auto merged = mergeBuffers(result_.asset);
    if (!merged) return merged.error();
    return std::move(result_);
  }

 private:
  Json& json() { return result_.asset.json; }

  void addMaterials() {
    for (const SceneMaterial& material : scene_.materials) {
      Json object = {{"pbrMetallicRoughness", {{"baseColorFactor", material.base_color}, {"metallicFactor", 0.0}}}};
      if (!material.name.empty()) object["name"] = material.name;
      if (material.base_color[3] < 1) object["alphaMode"] = "BLEND";
      appendElement(json(), "materials", std::move(object));
    }
  }

  std::vector<PositionBox> boxes() const {
    std::vector<PositionBox> result;
    for (const SceneMesh& mesh : scene_.meshes) {
      const auto& attributes = mesh.mesh.attributes;
      const bool used = !mesh.mesh.polygons.face_degrees.empty() && !attributes.empty();
      result.push_back(used ? boxOf(attributes[0], result.size()) : PositionBox{});
    }
    return result;
  }

  Outcome<Done> addMesh(size_t index, const std::optional<PositionGrid>& grid) {
    const SceneMesh& source = scene_.meshes[index];
    PolygonMesh mesh = source.mesh;
    keepAttributes(mesh, options_.attributes);
    if (mesh.polygons.face_degrees.empty()) {
      result_.report.warnings.push_back(unsupported(source.name, "a mesh without faces is left out"));
      return Done{};
    }
    PackOptions pack_options = options_.pack;
    pack_options.grid = grid;
    auto packed = pack(mesh, pack_options);
    if (!packed) return at(source, packed.error());
    const auto decoded = unpack(packed->bytes);
    if (!decoded) return at(source, decoded.error());
    const std::vector<bool> drawn = drawnGroups(*decoded);
    if (std::find(drawn.begin(), drawn.end(), true) == drawn.end()) {
      return at(source, unsupported("", "no face has three corners: glTF has no primitive for such a mesh"));
    }
    const std::vector<GroupWish> wishes(mesh.group_count, GroupWish{wishOf(*decoded)});
    const auto emitted = emitter_.add(packed->bytes, *decoded, wishes, 2);
    if (!emitted) return at(source, emitted.error());
    result_.report.payloads.push_back({source.name, mesh.polygons.vertex_count, mesh.wedge_count,
                                       mesh.polygons.face_degrees.size(), mesh.polygons.corners.size(),
                                       mesh.group_count, *std::move(packed)});
    addPrimitives(index, mesh, *emitted, drawn);
    return Done{};
  }

  static Failure at(const SceneMesh& mesh, Failure failure) {
    failure.where = "mesh '" + mesh.name + "'" + (failure.where.empty() ? "" : " " + failure.where);
    return failure;
  }

  PolygonNotation wishOf(const PolygonMesh& mesh) const {
    if (!hasPolygons(mesh)) return PolygonNotation::kTriangles;
    switch (options_.polygons) {
      case PolygonOutput::kExt: return PolygonNotation::kExt;
      case PolygonOutput::kBoth: return PolygonNotation::kBoth;
      default: return PolygonNotation::kFb;
    }
  }

  void addPrimitives(size_t index, const PolygonMesh& mesh, const EmittedPayload& emitted,
                     const std::vector<bool>& drawn) {
    Json attributes = Json::object(), targets = Json::array();
    for (size_t i = 0; i < mesh.attributes.size(); ++i) {
      const std::string& name = mesh.attributes[i].name;
      const size_t at = name.find('@');
      Json accessor = emitted.attributes[i];
      if (name.substr(0, at) != "POSITION") {
        accessor.erase("min");
        accessor.erase("max");
      }
      const uint64_t number = appendElement(json(), "accessors", std::move(accessor));
      if (at == std::string::npos) {
        attributes[name] = number;
      } else {
        targets[std::stoul(name.substr(at + 1))][name.substr(0, at)] = number;
      }
    }
    Json primitives = Json::array();
    for (size_t g = 0; g < emitted.groups.size(); ++g) {
      if (!drawn[g]) continue;
      primitives.push_back(makePrimitive(scene_.meshes[index], g, emitted.groups[g], attributes));
      if (!targets.empty()) primitives.back()["targets"] = targets;
    }
    Json object = {{"primitives", std::move(primitives)}};
    if (!scene_.meshes[index].name.empty()) object["name"] = scene_.meshes[index].name;
    mesh_numbers_[index] = appendElement(json(), "meshes", std::move(object));
  }

  Json makePrimitive(const SceneMesh& mesh, size_t g, const EmittedGroup& group, const Json& attributes) {
    Json primitive = {{"attributes", attributes}, {"indices", appendElement(json(), "accessors", group.indices)}};
    const int material = g < mesh.group_materials.size() ? mesh.group_materials[g] : -1;
    if (material >= 0) primitive["material"] = material;
    if (group.fans) {
      primitive["extensions"]["FB_ngon_encoding"] = Json::object();
      addExtension(json(), "extensionsUsed", "FB_ngon_encoding");
    }
    if (group.polygons > 0) {
      primitive["extensions"]["EXT_mesh_polygon"] = {
          {"count", group.polygons},
          {"indicesOffsets", appendElement(json(), "accessors", group.index_offsets)},
          {"loopIndices", appendElement(json(), "accessors", group.loops)},
          {"loopIndicesOffsets", appendElement(json(), "accessors", group.loop_offsets)}};
      addExtension(json(), "extensionsUsed", "EXT_mesh_polygon");
    }
    return primitive;
  }

  /// A glTF node shows one mesh, so that further ones get child nodes.
  void addNodes() {
    std::vector<SceneNode> nodes = scene_.nodes;
    if (nodes.empty()) {
      for (Index i = 0; i < scene_.meshes.size(); ++i) nodes.push_back({scene_.meshes[i].name, {i}, kIdentity, {}});
    }
    std::vector<uint8_t> is_child(nodes.size());
    std::vector<Json> extra;
    Json list = Json::array(), roots = Json::array();
    for (const SceneNode& node : nodes) {
      for (const Index child : node.children) is_child[child] = 1;
      list.push_back(makeNode(node, nodes.size(), extra));
    }
    for (size_t i = 0; i < nodes.size(); ++i) {
      if (!is_child[i]) roots.push_back(i);
    }
    for (Json& node : extra) list.push_back(std::move(node));
    if (list.empty()) return;
    json()["nodes"] = std::move(list);
    json()["scenes"] = Json::array({{{"nodes", std::move(roots)}}});
    json()["scene"] = 0;
  }

  Json makeNode(const SceneNode& node, size_t first_extra, std::vector<Json>& extra) const {
    Json object = Json::object();
    if (!node.name.empty()) object["name"] = node.name;
    if (node.matrix != kIdentity) object["matrix"] = node.matrix;
    Json children(node.children);
    for (const Index mesh : node.meshes) {
      const auto number = mesh_numbers_.find(mesh);
      if (number == mesh_numbers_.end()) continue;
      if (!object.contains("mesh")) {
        object["mesh"] = number->second;
      } else {
        children.push_back(first_extra + extra.size());
        extra.push_back({{"mesh", number->second}});
      }
    }
    if (!children.empty()) object["children"] = std::move(children);
    return object;
  }

  const Scene& scene_;
  const CompressOptions& options_;
  Compressed result_;
  PayloadEmitter emitter_;
  std::map<size_t, uint64_t> mesh_numbers_;
};

}  // namespace

Outcome<Compressed> sceneToAsset(const Scene& scene, const CompressOptions& options) {
  return guarded<Compressed>([&] { return SceneWriter(scene, options).run(); });
}

}  // namespace tutte
