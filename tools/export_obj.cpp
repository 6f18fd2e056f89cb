#include <algorithm>
#include <cstring>
#include <numeric>

#include "tools/export.h"
#include "tools/text.h"
#include "tools/values.h"

namespace tutte {
namespace {

/// Distinct values of an attribute, numbered in order of first use by a corner; per wedge its number from 1, 0 for
/// none.
struct Numbered {
  std::vector<float> values;
  std::vector<Index> numbers;
  int components = 0;
};

Numbered numberValues(const PolygonMesh& mesh, const Attribute& attribute, int components) {
  const std::vector<float> all = floatsOf(attribute);
  const size_t stride = attribute.components;
  const auto compare = [&](Index a, Index b) { return std::memcmp(&all[a * stride], &all[b * stride], stride * 4); };
  std::vector<Index> order(mesh.wedge_count), first(mesh.wedge_count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return compare(a, b) < 0; });
  for (size_t i = 0; i < order.size(); ++i) {
    first[order[i]] = i > 0 && compare(order[i - 1], order[i]) == 0 ? first[order[i - 1]] : order[i];
  }
  Numbered result{.values = {}, .numbers = std::vector<Index>(mesh.wedge_count), .components = components};
  for (Index corner = 0; corner < mesh.polygons.corners.size(); ++corner) {
    const Index wedge = mesh.wedgeOf(corner), source = first[wedge];
    if (result.numbers[source] == 0) {
      for (int i = 0; i < components; ++i) result.values.push_back(all[source * stride + i]);
      result.numbers[source] = static_cast<Index>(result.values.size() / components);
    }
    result.numbers[wedge] = result.numbers[source];
  }
  return result;
}

class ObjWriter {
 public:
  explicit ObjWriter(const Scene& scene) : scene_(scene) {}

  Exported run(const std::filesystem::path& path) {
    text_ = "# Written by tutte\n";
    if (!scene_.materials.empty()) addMaterials(path);
    for (SceneMesh& mesh : placedMeshes(scene_)) addMesh(mesh);
    if (holes_) warn(std::to_string(holes_) + " polygons have holes, which OBJ cannot hold; written as triangles");
    out_.files.push_back({path, {text_.begin(), text_.end()}});
    return std::move(out_);
  }

 private:
  void warn(const std::string& warning) {
    if (std::find(out_.warnings.begin(), out_.warnings.end(), warning) == out_.warnings.end()) {
      out_.warnings.push_back(warning);
    }
  }

  /// Names of materials are made distinct, as they are all that faces refer to them by.
  void addMaterials(const std::filesystem::path& path) {
    std::string library;
    for (const SceneMaterial& material : scene_.materials) {
      std::string name = material.name.empty() ? "material" : material.name;
      std::replace_if(
          name.begin(), name.end(), [](unsigned char c) { return c < ' '; }, '_');
      name = trimmed(name);
      if (std::find(names_.begin(), names_.end(), name) != names_.end()) name += "_" + std::to_string(names_.size());
      names_.push_back(name);
      library += "newmtl " + name + "\nKd";
      for (int i = 0; i < 3; ++i) library += ' ', appendNumber(library, static_cast<float>(material.base_color[i]));
      library += "\nd ";
      appendNumber(library, static_cast<float>(material.base_color[3]));
      library += "\n";
    }
    std::filesystem::path library_path = path;
    library_path.replace_extension(".mtl");
    text_ += "mtllib " + library_path.filename().string() + "\n";
    out_.files.push_back({library_path, {library.begin(), library.end()}});
  }

  void addMesh(SceneMesh& scene_mesh) {
    PolygonMesh& mesh = scene_mesh.mesh;
    holes_ += replaceHoles(mesh);
    addVertices(mesh);
    Numbered texcoords, normals;
    for (const Attribute& attribute : mesh.attributes) {
      if (attribute.name == "TEXCOORD_0") {
        texcoords = numberValues(mesh, attribute, 2);
        for (size_t i = 1; i < texcoords.values.size(); i += 2) texcoords.values[i] = 1 - texcoords.values[i];
      } else if (attribute.name == "NORMAL") {
        normals = numberValues(mesh, attribute, 3);
      } else if (attribute.name != "POSITION" && attribute.name != "COLOR_0") {
        warn("OBJ cannot hold " + attribute.name);
      }
    }
    addValues("vt", texcoords);
    addValues("vn", normals);
    addFaces(scene_mesh, texcoords, normals);
    vertex_base_ += mesh.polygons.vertex_count;
    texcoord_base_ += texcoords.values.size() / 2;
    normal_base_ += normals.values.size() / 3;
  }

  void addVertices(const PolygonMesh& mesh) {
    const Index vertices = mesh.polygons.vertex_count;
    std::vector<Index> wedge_of(vertices, kNone);
    for (Index corner = 0; corner < mesh.polygons.corners.size(); ++corner) {
      Index& wedge = wedge_of[mesh.polygons.corners[corner]];
      wedge = std::min(wedge, mesh.wedgeOf(corner));
    }
    Index isolated = mesh.wedge_count;  // they come last, vertices as well as wedges
    for (Index vertex = vertices; vertex-- > 0;) {
      if (wedge_of[vertex] == kNone) wedge_of[vertex] = --isolated;
    }
    const Attribute* position = findAttribute(mesh, "POSITION");
    const Attribute* color = findAttribute(mesh, "COLOR_0");
    const std::vector<float> positions = position ? floatsOf(*position) : std::vector<float>(3 * mesh.wedge_count);
    const std::vector<float> colors = color ? floatsOf(*color) : std::vector<float>();
    if (color && color->components == 4) warn("OBJ has no opacity of vertices");
    for (Index wedge : wedge_of) {
      text_ += "v";
      for (int i = 0; i < 3; ++i) addNumber(positions[3 * wedge + i]);
      for (int i = 0; color && i < 3; ++i) addNumber(colors[size_t{color->components} * wedge + i]);
      text_ += "\n";
    }
  }

  void addNumber(float value) { text_ += ' ', appendNumber(text_, value); }

  void addValues(const char* keyword, const Numbered& numbered) {
    for (size_t i = 0; i < numbered.values.size(); ++i) {
      if (i % numbered.components == 0) text_ += keyword;
      addNumber(numbered.values[i]);
      if ((i + 1) % numbered.components == 0) text_ += "\n";
    }
  }

  void addFaces(const SceneMesh& scene_mesh, const Numbered& texcoords, const Numbered& normals) {
    const PolygonMesh& mesh = scene_mesh.mesh;
    if (!scene_mesh.name.empty()) text_ += "o " + scene_mesh.name.substr(0, scene_mesh.name.find('\n')) + "\n";
    Index corner = 0;
    int material = -2;
    for (size_t face = 0; face < mesh.polygons.face_degrees.size(); ++face) {
      const Index group = mesh.groups.empty() ? 0 : mesh.groups[face];
      const int wanted = group < scene_mesh.group_materials.size() ? scene_mesh.group_materials[group] : -1;
      if (wanted != material && wanted >= 0) text_ += "usemtl " + names_[wanted] + "\n";
      material = wanted;
      text_ += "f";
      for (Index i = 0; i < mesh.polygons.face_degrees[face]; ++i) addCorner(mesh, corner++, texcoords, normals);
      text_ += "\n";
    }
  }

  void addCorner(const PolygonMesh& mesh, Index corner, const Numbered& texcoords, const Numbered& normals) {
    const Index wedge = mesh.wedgeOf(corner);
    text_ += ' ' + std::to_string(vertex_base_ + mesh.polygons.corners[corner] + 1);
    if (texcoords.components || normals.components) text_ += '/';
    if (texcoords.components) text_ += std::to_string(texcoord_base_ + texcoords.numbers[wedge]);
    if (normals.components) text_ += '/' + std::to_string(normal_base_ + normals.numbers[wedge]);
  }

  const Scene& scene_;
  Exported out_;
  std::string text_;
  std::vector<std::string> names_;
  size_t vertex_base_ = 0, texcoord_base_ = 0, normal_base_ = 0;
  Index holes_ = 0;
};

}  // namespace

Exported exportObj(const Scene& scene, const std::filesystem::path& path) { return ObjWriter(scene).run(path); }

}  // namespace tutte
