#pragma once
// A handful of meshes with names, places and colours: what importers make and exporters write.

#include <array>
#include <string>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/compress.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// A column-major 4x4 matrix, as in glTF.
using Matrix = std::array<double, 16>;
inline constexpr Matrix kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// A surface as far as exchange formats agree on it.
struct SceneMaterial {
  std::string name;
  std::array<double, 4> base_color = {1, 1, 1, 1};  ///< linear RGBA, 0 to 1
};

/// One mesh; each of its face groups may have a material.
struct SceneMesh {
  std::string name;
  PolygonMesh mesh;
  std::vector<int> group_materials;  ///< per group: an index into Scene::materials or -1; may be empty: none
};

/// One place in the scene.
struct SceneNode {
  std::string name;
  std::vector<Index> meshes;    ///< indices into Scene::meshes; one node may show several
  Matrix matrix = kIdentity;    ///< relative to the parent node
  std::vector<Index> children;  ///< indices into Scene::nodes; a node has one parent at most
};

/// Meshes and where they stand. Without nodes, every mesh stands at the origin.
struct Scene {
  std::vector<SceneMesh> meshes;
  std::vector<SceneNode> nodes;
  std::vector<SceneMaterial> materials;
};

/// A compressed glTF asset of the scene: one payload per mesh, one primitive per group. Meshes
/// without a triangulation get one from pack(). Meshes without faces become no primitive.
Outcome<Compressed> sceneToAsset(const Scene& scene, const CompressOptions& options = {});

/// The triangle and polygon meshes of a plain or compressed asset, for exporters and comparison.
///
/// Primitives that share their vertices become one mesh with groups. The polygons of compressed primitives are exactly
/// those that were stored; plain ones are welded where their positions are equal to the bit. Points and lines are left
/// out. Any asset may be passed: damaged ones give a Failure.
Outcome<Scene> assetToScene(const Asset& asset);

}  // namespace tutte
