#pragma once
// A Scene to files of other formats.

#include <filesystem>
#include <string>
#include <vector>

#include "gltf_ext/files.h"
#include "gltf_ext/scene.h"

namespace tutte {

/// Files ready to be written, and what they do not hold of the scene.
struct Exported {
  std::vector<NewFile> files;
  std::vector<std::string> warnings;
};

/// By the extension of `path`: .obj or .ply. Errors: kUsage for any other.
Outcome<Exported> exportScene(const Scene& scene, const std::filesystem::path& path);

/// Wavefront OBJ: one `v` per vertex, texture coordinates and normals with numbers of their own, a material library
/// beside it when there are materials. Numbers are written so that they read back to the same float.
Exported exportObj(const Scene& scene, const std::filesystem::path& path);

/// Binary PLY: one vertex per vertex, texture coordinates per corner where they have seams. Where other attributes
/// differ within a vertex, one vertex per wedge, with a warning.
Exported exportPly(const Scene& scene, const std::filesystem::path& path);

/// A mesh without holes: polygons that have interior rings are replaced by their triangles, which must be given.
/// Returns the number of polygons replaced.
Index replaceHoles(PolygonMesh& mesh);

/// All meshes at their places, in the scene's space. Normals are turned, other attributes stay.
std::vector<SceneMesh> placedMeshes(const Scene& scene);

}  // namespace tutte
