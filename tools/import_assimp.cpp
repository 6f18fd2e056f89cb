// Everything that Assimp knows and we do not read ourselves.

#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <set>

#include "tools/import.h"
#include "tools/indexed_mesh.h"
#include "tools/values.h"

namespace tutte {
namespace {

std::string nameOf(const aiString& name) { return {name.data, name.length}; }

/// Faces that use some of an Assimp mesh's vertices: without points, lines and the vertices that only they use.
class MeshImporter {
 public:
  MeshImporter(const aiMesh& source, std::vector<std::string>& warnings) : source_(source), warnings_(warnings) {}

  PolygonMesh run() {
    addFaces();
    addFloats("POSITION", source_.mVertices);
    if (source_.HasNormals()) addFloats("NORMAL", source_.mNormals);
    for (unsigned set = 0; set < source_.GetNumUVChannels(); ++set) addTexcoords(set);
    for (unsigned set = 0; set < source_.GetNumColorChannels(); ++set) addColors(set);
    return weld(std::move(mesh_), warnings_);
  }

 private:
  void addFaces() {
    std::vector<Index> numbers(source_.mNumVertices, kNone);
    for (unsigned face = 0; face < source_.mNumFaces; ++face) {
      const aiFace& polygon = source_.mFaces[face];
      if (polygon.mNumIndices < 3) continue;
      mesh_.polygons.face_degrees.push_back(polygon.mNumIndices);
      for (unsigned i = 0; i < polygon.mNumIndices; ++i) {
        Index& number = numbers[polygon.mIndices[i]];
        if (number == kNone) number = static_cast<Index>(vertices_.size()), vertices_.push_back(polygon.mIndices[i]);
        mesh_.polygons.corners.push_back(number);
      }
    }
    mesh_.wedge_count = mesh_.polygons.vertex_count = static_cast<Index>(vertices_.size());
  }

  void addFloats(const char* name, const aiVector3D* source) {
    std::vector<float> values;
    for (unsigned vertex : vertices_) {
      for (const float value : {source[vertex].x, source[vertex].y, source[vertex].z}) values.push_back(value);
    }
    mesh_.attributes.push_back(floatAttribute(name, 3, values));
  }

  void addTexcoords(unsigned set) {
    std::vector<float> values;
    for (unsigned vertex : vertices_) {
      values.push_back(source_.mTextureCoords[set][vertex].x);
      values.push_back(1 - source_.mTextureCoords[set][vertex].y);
    }
    mesh_.attributes.push_back(floatAttribute("TEXCOORD_" + std::to_string(set), 2, values));
  }

  void addColors(unsigned set) {
    std::vector<float> values;
    for (unsigned vertex : vertices_) {
      const aiColor4D& color = source_.mColors[set][vertex];
      for (const float value : {color.r, color.g, color.b, color.a}) values.push_back(value);
    }
    mesh_.attributes.push_back(floatAttribute("COLOR_" + std::to_string(set), 4, values));
  }

  const aiMesh& source_;
  std::vector<std::string>& warnings_;
  std::vector<unsigned> vertices_;  ///< the source's, in order of first use
  PolygonMesh mesh_;
};

SceneMaterial materialOf(const aiMaterial& source) {
  SceneMaterial material;
  aiString name;
  if (source.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) material.name = nameOf(name);
  aiColor4D color(1, 1, 1, 1);
  if (source.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) {
    source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    float opacity = 1;
    if (source.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS) color.a = opacity;
  }
  material.base_color = {color.r, color.g, color.b, color.a};
  for (double& channel : material.base_color) channel = std::isfinite(channel) ? std::clamp(channel, 0.0, 1.0) : 1.0;
  return material;
}

class SceneImporter {
 public:
  explicit SceneImporter(const aiScene& source) : source_(source) {}

  Outcome<Imported> run() {
    for (unsigned i = 0; i < source_.mNumMaterials; ++i) {
      result_.scene.materials.push_back(materialOf(*source_.mMaterials[i]));
    }
    std::vector<std::string> mesh_warnings;
    for (unsigned i = 0; i < source_.mNumMeshes; ++i) addMesh(*source_.mMeshes[i], mesh_warnings);
    if (std::none_of(mesh_numbers_.begin(), mesh_numbers_.end(), [](Index number) { return number != kNone; })) {
      return Failure{FailureKind::kUnsupported, "", "there are no polygons in it; give a file with a mesh"};
    }
    for (const std::string& warning : std::set(mesh_warnings.begin(), mesh_warnings.end())) {
      result_.warnings.push_back(warning);
    }
    if (source_.mRootNode) addNodes();
    warn();
    return std::move(result_);
  }

 private:
  void addMesh(const aiMesh& source, std::vector<std::string>& warnings) {
    SceneMesh mesh;
    mesh.name = nameOf(source.mName);
    mesh.mesh = MeshImporter(source, warnings).run();
    const bool empty = mesh.mesh.polygons.face_degrees.empty();
    mesh_numbers_.push_back(empty ? kNone : static_cast<Index>(result_.scene.meshes.size()));
    points_ += source.mPrimitiveTypes & (aiPrimitiveType_POINT | aiPrimitiveType_LINE) ? 1 : 0;
    if (empty) return;
    mesh.group_materials = {static_cast<int>(source.mMaterialIndex)};
    result_.scene.meshes.push_back(std::move(mesh));
  }

  /// Breadth first, so that depth is no danger.
  void addNodes() {
    std::vector<const aiNode*> nodes = {source_.mRootNode};
    for (size_t i = 0; i < nodes.size(); ++i) {
      const aiNode& node = *nodes[i];
      SceneNode out{.name = nameOf(node.mName), .meshes = {}, .children = {}};
      const aiMatrix4x4& m = node.mTransformation;
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) out.matrix[4 * column + row] = m[row][column];
      }
      for (unsigned mesh = 0; mesh < node.mNumMeshes; ++mesh) {
        if (mesh_numbers_[node.mMeshes[mesh]] != kNone) out.meshes.push_back(mesh_numbers_[node.mMeshes[mesh]]);
      }
      for (unsigned child = 0; child < node.mNumChildren; ++child) {
        out.children.push_back(static_cast<Index>(nodes.size()));
        nodes.push_back(node.mChildren[child]);
      }
      result_.scene.nodes.push_back(std::move(out));
    }
  }

  void warn() {
    const auto note = [&](size_t count, const char* what) {
      if (count) result_.warnings.push_back(std::to_string(count) + " " + what + " are not carried over");
    };
    size_t bones = 0, shapes = 0, textures = source_.mNumTextures;
    for (unsigned i = 0; i < source_.mNumMeshes; ++i) {
      bones += source_.mMeshes[i]->mNumBones;
      shapes += source_.mMeshes[i]->mNumAnimMeshes;
    }
    for (unsigned i = 0; i < source_.mNumMaterials; ++i) {
      for (int type = 1; type < AI_TEXTURE_TYPE_MAX; ++type) {
        textures += source_.mMaterials[i]->GetTextureCount(static_cast<aiTextureType>(type));
      }
    }
    note(source_.mNumAnimations, "animations");
    note(bones, "bones");
    note(shapes, "morph targets");
    note(textures, "textures");
    note(source_.mNumLights, "lights");
    note(source_.mNumCameras, "cameras");
    note(points_, "meshes of points or lines");
  }

  const aiScene& source_;
  Imported result_;
  std::vector<Index> mesh_numbers_;  ///< Assimp's -> ours
  size_t points_ = 0;
};

}  // namespace

Outcome<Imported> importAssimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (!scene) return Failure{FailureKind::kInvalid, "", importer.GetErrorString() + std::string("; give another file")};
  return SceneImporter(*scene).run();
}

}  // namespace tutte
