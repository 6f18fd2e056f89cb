// OBJ through tinyobjloader's callbacks: its ready-made mesh would lose faces of more than 255 corners, and of fewer
// than three, and the place of an error.

#include <tiny_obj_loader.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>

#include "tools/import.h"
#include "tools/indexed_mesh.h"
#include "tools/obj_lines.h"
#include "tools/text.h"
#include "tools/values.h"

namespace tutte {
namespace {

namespace fs = std::filesystem;

/// Looks for material libraries beside the model, nowhere else.
class Materials : public tinyobj::MaterialReader {
 public:
  Materials(const ObjLines& lines, fs::path folder) : lines_(lines), folder_(std::move(folder)) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials, std::map<std::string, int>* map,
                  std::string* warnings, std::string* errors) override {
    std::string_view line = trimmed(lines_.line());
    nextWord(line);
    if (read(std::string(trimmed(line)), materials, map, warnings, errors)) return true;  // a name with spaces
    return read(name, materials, map, warnings, errors);
  }

  std::vector<tinyobj::material_t> loaded;
  std::vector<std::string> missing;

 private:
  bool read(const std::string& name, std::vector<tinyobj::material_t>* materials, std::map<std::string, int>* map,
            std::string* warnings, std::string* errors) {
    const fs::path path = fs::path(name).lexically_normal();
    std::ifstream file;
    if (!name.empty() && path.is_relative() && *path.begin() != "..") file.open(folder_ / path);
    if (!file.is_open()) {
      if (missing.empty() || missing.back() != name) missing.push_back(name);
      return false;
    }
    missing.clear();
    tinyobj::LoadMtl(map, materials, &file, warnings, errors);
    loaded = *materials;
    return true;
  }

  const ObjLines& lines_;
  fs::path folder_;
};

/// Collects what the callbacks report.
class ObjReader {
 public:
  ObjReader(std::span<const uint8_t> bytes, const fs::path& folder) : lines_(bytes), materials_(lines_, folder) {}

  Outcome<Imported> run() {
    tinyobj::callback_t callback;
    callback.vertex_cb = [](void* self, float, float, float, float) { as(self).addVertex(); };
    callback.normal_cb = [](void* self, float, float, float) { as(self).addNumbers(as(self).normals_, 3, 3); };
    callback.texcoord_cb = [](void* self, float, float, float) { as(self).addTexcoord(); };
    callback.index_cb = [](void* self, tinyobj::index_t* indices, int count) {
      as(self).addFace({indices, static_cast<size_t>(count)});
    };
    callback.usemtl_cb = [](void* self, const char* name, int) { as(self).useMaterial(name); };
    std::istream stream(&lines_);
    std::string warnings, errors;
    tinyobj::LoadObjWithCallback(stream, callback, this, &materials_, &warnings, &errors);
    if (lines_.empty_faces && !failure_) fail(lines_.empty_faces, "the face names no vertex; remove the line");
    if (!failure_) checkIndices();
    if (failure_) return *failure_;
    return finish();
  }

 private:
  static ObjReader& as(void* self) { return *static_cast<ObjReader*>(self); }

  void fail(size_t line, std::string what) {
    if (!failure_) failure_ = {FailureKind::kInvalid, "line " + std::to_string(line), std::move(what)};
    lines_.stop();
  }

  /// Appends the numbers of the line: `least` at least, zeros up to `count`; what goes beyond is returned.
  std::string_view addNumbers(std::vector<float>& values, int count, int least) {
    std::string_view rest = lines_.line();
    nextWord(rest);
    for (int i = 0; i < count; ++i) {
      const std::string_view word = nextWord(rest);
      const std::optional<float> value = word.empty() && i >= least ? 0.0f : parseFloat(word);
      if (!value) {
        fail(lines_.number(), word.empty() ? "a number is missing; give " + std::to_string(least)
                                           : "'" + std::string(word) + "' is not a finite number; correct it");
      }
      values.push_back(value.value_or(0));
    }
    return trimmed(rest);
  }

  /// x y z, then nothing, a weight, or a colour (with or without a weight before it).
  void addVertex() {
    std::vector<float> more;
    for (std::string_view rest = addNumbers(positions_, 3, 3); !rest.empty();) {
      const std::optional<float> value = parseFloat(nextWord(rest));
      if (!value) return fail(lines_.number(), "a vertex has something else than numbers; correct it");
      more.push_back(*value);
    }
    const size_t vertex = positions_.size() / 3 - 1;
    if (more.size() < 3) return;
    if (colors_.empty()) first_color_ = vertex;
    colors_.resize(3 * vertex, 1.0f);
    colors_.insert(colors_.end(), more.end() - 3, more.end());
  }

  void addTexcoord() {
    std::vector<float> values;
    addNumbers(values, 2, 1);
    texcoords_.push_back(values[0]);
    texcoords_.push_back(1 - values[1]);  // OBJ counts from the lower edge of the picture, glTF from the upper
  }

  void addFace(std::span<const tinyobj::index_t> indices) {
    const std::string_view line = trimmed(lines_.line());
    if (line.find_first_not_of("0123456789+-/ \t", 1) != line.npos) {
      return fail(lines_.number(), "a face has something else than vertex numbers; correct it");
    }
    mesh_.face_degrees.push_back(static_cast<Index>(indices.size()));
    face_lines_.push_back(lines_.number());
    mesh_.groups.push_back(group_);
    for (const tinyobj::index_t& index : indices) {
      if (index.vertex_index == 0) return fail(lines_.number(), "a corner names no vertex; they count from 1");
      mesh_.corners.push_back(absolute(index.vertex_index, positions_.size() / 3));
      corner_texcoords_.push_back(absolute(index.texcoord_index, texcoords_.size() / 2));
      corner_normals_.push_back(absolute(index.normal_index, normals_.size() / 3));
    }
  }

  /// From OBJ's numbers, which count from 1 or backwards from -1, to ours; kNone for 0. What is out of range stays so.
  static Index absolute(int index, size_t count) {
    if (index == 0) return kNone;
    const int64_t result = index > 0 ? int64_t{index} - 1 : static_cast<int64_t>(count) + index;
    return result < 0 ? kNone - 1 : static_cast<Index>(result);
  }

  void useMaterial(const char* name) {
    const std::string trimmed_name(trimmed(name));
    const auto [found, added] = group_of_.try_emplace(trimmed_name, static_cast<Index>(group_names_.size()));
    if (added) group_names_.push_back(trimmed_name);
    group_ = found->second;
  }

  /// A face may name a vertex that comes after it, so this is done at the end.
  void checkIndices() {
    size_t corner = 0;
    for (size_t face = 0; face < face_lines_.size(); ++face) {
      for (Index i = 0; i < mesh_.face_degrees[face]; ++i, ++corner) {
        check(face, "vertex", mesh_.corners[corner], positions_.size() / 3);
        check(face, "texture coordinate", corner_texcoords_[corner], texcoords_.size() / 2);
        check(face, "normal", corner_normals_[corner], normals_.size() / 3);
        if (failure_) return;
      }
    }
  }

  void check(size_t face, const char* what, Index index, size_t count) {
    if (index == kNone || index < count) return;
    fail(face_lines_[face], std::string("the face names a ") + what + " that does not exist (there are " +
                                std::to_string(count) + "); correct the number or add what is missing");
  }

  Imported finish() {
    Imported result;
    warn(result.warnings);
    mesh_.vertex_count = static_cast<Index>(positions_.size() / 3);
    mesh_.vertex_attributes.push_back(floatAttribute("POSITION", 3, positions_));
    if (!colors_.empty()) {
      colors_.resize(positions_.size(), 1.0f);
      mesh_.vertex_attributes.push_back(floatAttribute("COLOR_0", 3, colors_));
    }
    mesh_.corner_attributes.push_back({floatAttribute("NORMAL", 3, normals_), std::move(corner_normals_)});
    mesh_.corner_attributes.push_back({floatAttribute("TEXCOORD_0", 2, texcoords_), std::move(corner_texcoords_)});
    SceneMesh mesh;
    finishGroups(result.scene, mesh);
    mesh.mesh = buildMesh(std::move(mesh_), result.warnings);
    result.scene.meshes.push_back(std::move(mesh));
    return result;
  }

  void warn(std::vector<std::string>& warnings) const {
    for (const std::string& name : materials_.missing) {
      warnings.push_back("material library '" + name + "' was not found beside the model; materials have no colour");
    }
    if (lines_.points_and_lines) {
      warnings.push_back(std::to_string(lines_.points_and_lines) + " points, lines and curves are not carried over");
    }
    if (lines_.groups) warnings.push_back("names of groups and objects are not carried over");
    if (!colors_.empty() && (first_color_ > 0 || colors_.size() < positions_.size())) {
      warnings.push_back("some vertices have no colour; they become white");
    }
  }

  /// Numbers the groups that have faces, in order, and makes a material of each that has a name.
  void finishGroups(Scene& scene, SceneMesh& mesh) {
    std::vector<Index> numbers(group_names_.size(), kNone);
    for (Index group : mesh_.groups) numbers[group] = 0;
    mesh_.group_count = 0;
    for (size_t group = 0; group < numbers.size(); ++group) {
      if (numbers[group] == kNone) continue;
      numbers[group] = mesh_.group_count++;
      mesh.group_materials.push_back(group_names_[group].empty() ? -1 : addMaterial(scene, group_names_[group]));
    }
    mesh_.group_count = std::max(mesh_.group_count, 1u);
    for (Index& group : mesh_.groups) group = numbers[group];
    if (mesh_.group_count == 1) mesh_.groups.clear();
    if (scene.materials.empty()) mesh.group_materials.clear();
  }

  int addMaterial(Scene& scene, const std::string& name) const {
    SceneMaterial material{.name = name};
    for (const tinyobj::material_t& loaded : materials_.loaded) {
      if (loaded.name != name) continue;
      for (int i = 0; i < 3; ++i) material.base_color[i] = std::clamp<double>(loaded.diffuse[i], 0, 1);
      material.base_color[3] = std::clamp<double>(loaded.dissolve, 0, 1);
    }
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size() - 1);
  }

  ObjLines lines_;
  Materials materials_;
  std::optional<Failure> failure_;
  IndexedMesh mesh_;
  std::vector<float> positions_, colors_, texcoords_, normals_;
  std::vector<Index> corner_texcoords_, corner_normals_;
  std::vector<size_t> face_lines_;
  size_t first_color_ = 0;
  std::map<std::string, Index> group_of_ = {{"", 0}};
  std::vector<std::string> group_names_ = {""};
  Index group_ = 0;
};

}  // namespace

Outcome<Imported> importObj(std::span<const uint8_t> bytes, const fs::path& folder) {
  if (bytes.size() >= 2 && ((bytes[0] == 0xFE && bytes[1] == 0xFF) || (bytes[0] == 0xFF && bytes[1] == 0xFE))) {
    return Failure{FailureKind::kUnsupported, "byte 0", "the text is UTF-16; convert it to UTF-8"};
  }
  if (const auto zero = std::find(bytes.begin(), bytes.end(), 0); zero != bytes.end()) {
    return Failure{FailureKind::kInvalid, "byte " + std::to_string(zero - bytes.begin()),
                   "this is not text; give an OBJ file"};
  }
  return ObjReader(bytes, folder).run();
}

}  // namespace tutte
