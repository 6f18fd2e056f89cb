#include "tools/export.h"

#include <algorithm>

#include "tools/places.h"
#include "tools/text.h"
#include "tools/values.h"

namespace tutte {
namespace {

using Vector = std::array<double, 3>;

void transform(Attribute& attribute, const Matrix& matrix, Vector (*apply)(const Matrix&, const Vector&)) {
  std::vector<float> values = floatsOf(attribute);
  for (size_t i = 0; i + 2 < values.size(); i += 3) {
    const Vector result = apply(matrix, {values[i], values[i + 1], values[i + 2]});
    for (int axis = 0; axis < 3; ++axis) values[i + axis] = static_cast<float>(result[axis]);
  }
  attribute = floatAttribute(attribute.name, 3, values);
}

}  // namespace

Outcome<Exported> exportScene(const Scene& scene, const std::filesystem::path& path) {
  const std::string extension = lowerCase(path.extension().string());
  if (extension == ".obj") return exportObj(scene, path);
  if (extension == ".ply") return exportPly(scene, path);
  return Failure{FailureKind::kUsage, path.string(),
                 "cannot write files of this kind; name a .glb, .gltf, .obj or .ply file"};
}

std::vector<SceneMesh> placedMeshes(const Scene& scene) {
  std::vector<SceneMesh> placed;
  for (const Place& place : placesOf(scene)) {
    placed.push_back(scene.meshes[place.mesh]);
    if (place.matrix == kIdentity) continue;
    for (Attribute& attribute : placed.back().mesh.attributes) {
      if (attribute.name == "POSITION") transform(attribute, place.matrix, transformPoint);
      if (attribute.name == "NORMAL") transform(attribute, place.matrix, transformNormal);
    }
  }
  return placed;
}

Index replaceHoles(PolygonMesh& mesh) {
  if (mesh.ring_owners.empty()) return 0;
  const auto faces = static_cast<Index>(mesh.polygons.face_degrees.size());
  std::vector<uint8_t> has_holes(faces);
  for (Index owner : mesh.ring_owners) {
    if (owner != kNone) has_holes[owner] = 1;
  }
  PolygonMesh out = mesh;
  out.polygons.face_degrees.clear();
  out.polygons.corners.clear();
  out.wedges.clear();
  out.groups.clear();
  out.triangulation = {};
  out.ring_owners.clear();
  Index start = 0, triangle_corner = 0;
  const auto add = [&](Index face, Index degree, auto cornerAt) {
    out.polygons.face_degrees.push_back(degree);
    if (!mesh.groups.empty()) out.groups.push_back(mesh.groups[face]);
    for (Index i = 0; i < degree; ++i) {
      out.polygons.corners.push_back(mesh.polygons.corners[cornerAt(i)]);
      if (!mesh.wedges.empty()) out.wedges.push_back(mesh.wedges[cornerAt(i)]);
    }
  };
  for (Index face = 0; face < faces; ++face) {
    const Index triangles = mesh.triangulation.counts[face], degree = mesh.polygons.face_degrees[face];
    if (has_holes[face]) {
      for (Index i = 0; i < triangles; ++i) {
        add(face, 3, [&](Index k) { return mesh.triangulation.corners[triangle_corner + 3 * i + k]; });
      }
    } else if (mesh.ring_owners[face] == kNone) {
      add(face, degree, [&](Index k) { return start + k; });
    }
    triangle_corner += 3 * triangles;
    start += degree;
  }
  mesh = std::move(out);
  return static_cast<Index>(std::count(has_holes.begin(), has_holes.end(), 1));
}

}  // namespace tutte
