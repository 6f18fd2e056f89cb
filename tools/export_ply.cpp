#include <algorithm>
#include <cctype>
#include <cstring>

#include "tools/export.h"
#include "tools/values.h"

namespace tutte {
namespace {

/// The names that PLY readers know for an attribute's components.
std::vector<std::string> propertiesOf(const Attribute& attribute) {
  if (attribute.name == "POSITION") return {"x", "y", "z"};
  if (attribute.name == "NORMAL") return {"nx", "ny", "nz"};
  if (attribute.name == "TEXCOORD_0") return {"s", "t"};
  if (attribute.name == "COLOR_0") {
    std::vector<std::string> names = {"red", "green", "blue", "alpha"};
    names.resize(attribute.components);
    return names;
  }
  if (attribute.components != 1 || !attribute.name.starts_with("_")) return {};
  std::string name = attribute.name.substr(1);
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return {name};
}

bool isByteColor(const Attribute& attribute) {
  return attribute.name == "COLOR_0" && attribute.type == ComponentType::kUint8;
}

class PlyWriter {
 public:
  explicit PlyWriter(const Scene& scene) : meshes_(placedMeshes(scene)) {
    if (!scene.materials.empty()) out_.warnings.push_back("PLY has no materials");
  }

  Exported run(const std::filesystem::path& path) {
    Index holes = 0;
    for (SceneMesh& mesh : meshes_) holes += replaceHoles(mesh.mesh);
    if (holes)
      out_.warnings.push_back(std::to_string(holes) +
                              " polygons have holes, which PLY cannot hold; written as triangles");
    chooseAttributes();
    chooseVertices();
    for (const SceneMesh& mesh : meshes_) {
      for (Index degree : mesh.mesh.polygons.face_degrees) wide_ = wide_ || degree > 127;
    }
    for (const SceneMesh& mesh : meshes_) addVertices(mesh.mesh);
    for (const SceneMesh& mesh : meshes_) addFaces(mesh.mesh);
    const std::string header = headerText();
    Bytes bytes(header.begin(), header.end());
    bytes.insert(bytes.end(), vertices_.begin(), vertices_.end());
    bytes.insert(bytes.end(), faces_.begin(), faces_.end());
    out_.files.push_back({path, std::move(bytes)});
    return std::move(out_);
  }

 private:
  /// What all meshes have, and PLY has a name for.
  void chooseAttributes() {
    for (const SceneMesh& mesh : meshes_) {
      for (const Attribute& attribute : mesh.mesh.attributes) {
        const auto known = [&](const Attribute& other) { return other.name == attribute.name; };
        if (std::any_of(attributes_.begin(), attributes_.end(), known)) continue;
        const bool everywhere = std::all_of(meshes_.begin(), meshes_.end(), [&](const SceneMesh& other) {
          const Attribute* found = findAttribute(other.mesh, attribute.name);
          return found && found->type == attribute.type && found->components == attribute.components;
        });
        if (everywhere && !propertiesOf(attribute).empty())
          attributes_.push_back(
              {.name = attribute.name, .components = attribute.components, .type = attribute.type, .data = {}});
        else
          out_.warnings.push_back(attribute.name +
                                  (everywhere ? " has no place in PLY" : " is not in all meshes; left out"));
      }
    }
  }

  void chooseVertices() {
    for (const SceneMesh& scene_mesh : meshes_) {
      const PolygonMesh& mesh = scene_mesh.mesh;
      if (mesh.wedges.empty()) continue;
      for (const Attribute& attribute : attributes_) {
        if (!hasSeams(mesh, *findAttribute(mesh, attribute.name))) continue;
        (attribute.name == "TEXCOORD_0" ? corner_texcoords_ : by_wedge_) = true;
      }
    }
    if (!by_wedge_) return;
    corner_texcoords_ = false;
    out_.warnings.push_back("attributes differ within vertices; the file gets one vertex for each combination");
  }

  static bool hasSeams(const PolygonMesh& mesh, const Attribute& attribute) {
    const size_t stride = attribute.stride();
    std::vector<Index> first(mesh.polygons.vertex_count, kNone);
    for (size_t corner = 0; corner < mesh.wedges.size(); ++corner) {
      Index& wedge = first[mesh.polygons.corners[corner]];
      if (wedge == kNone) wedge = mesh.wedges[corner];
      if (std::memcmp(&attribute.data[wedge * stride], &attribute.data[mesh.wedges[corner] * stride], stride))
        return true;
    }
    return false;
  }

  void addVertices(const PolygonMesh& mesh) {
    vertex_bases_.push_back(vertex_count_);
    vertex_count_ += by_wedge_ ? mesh.wedge_count : mesh.polygons.vertex_count;
    std::vector<std::vector<float>> values;
    for (const Attribute& attribute : attributes_) values.push_back(floatsOf(*findAttribute(mesh, attribute.name)));
    for (Index wedge : wedgesOfVertices(mesh)) {
      for (size_t i = 0; i < attributes_.size(); ++i)
        addValue(attributes_[i], &values[i][size_t{wedge} * attributes_[i].components]);
    }
  }

  /// Per vertex of the file, the wedge that its values come from.
  std::vector<Index> wedgesOfVertices(const PolygonMesh& mesh) const {
    std::vector<Index> result(by_wedge_ ? mesh.wedge_count : mesh.polygons.vertex_count, kNone);
    for (Index corner = 0; corner < mesh.polygons.corners.size() && !by_wedge_; ++corner) {
      result[mesh.polygons.corners[corner]] = mesh.wedgeOf(corner);
    }
    Index isolated = mesh.wedge_count;  // they come last, vertices as well as wedges
    for (size_t vertex = result.size(); vertex-- > 0;) {
      if (result[vertex] == kNone) result[vertex] = --isolated;
    }
    return result;
  }

  void addValue(const Attribute& attribute, const float* values) {
    if (isPerCorner(attribute)) return;
    for (int i = 0; i < attribute.components; ++i) {
      if (isByteColor(attribute))
        vertices_.push_back(static_cast<uint8_t>(values[i] * 255 + 0.5f));
      else
        addFloat(vertices_, attribute.name == "TEXCOORD_0" && i == 1 ? 1 - values[i] : values[i]);
    }
  }

  bool isPerCorner(const Attribute& attribute) const { return corner_texcoords_ && attribute.name == "TEXCOORD_0"; }

  static void addWord(Bytes& bytes, uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<uint8_t>(word >> shift));
  }

  static void addFloat(Bytes& bytes, float value) {
    uint32_t word;
    std::memcpy(&word, &value, sizeof word);
    addWord(bytes, word);
  }

  /// The length of a list, in a byte if all lists allow it: some readers know nothing else.
  void addCount(Index count) {
    if (wide_)
      addWord(faces_, count);
    else
      faces_.push_back(static_cast<uint8_t>(count));
  }

  void addFaces(const PolygonMesh& mesh) {
    const Index base = vertex_bases_[mesh_number_++];
    const std::vector<float> texcoords =
        corner_texcoords_ ? floatsOf(*findAttribute(mesh, "TEXCOORD_0")) : std::vector<float>();
    Index start = 0;
    for (Index degree : mesh.polygons.face_degrees) {
      addCount(degree);
      for (Index i = start; i < start + degree; ++i) {
        addWord(faces_, base + (by_wedge_ ? mesh.wedgeOf(i) : mesh.polygons.corners[i]));
      }
      if (corner_texcoords_) addCount(2 * degree);
      for (Index i = start; corner_texcoords_ && i < start + degree; ++i) {
        addFloat(faces_, texcoords[2 * mesh.wedgeOf(i)]);
        addFloat(faces_, 1 - texcoords[2 * mesh.wedgeOf(i) + 1]);
      }
      start += degree;
      ++face_count_;
    }
  }

  std::string headerText() const {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by tutte\nelement vertex " +
                       std::to_string(vertex_count_) + "\n";
    for (const Attribute& attribute : attributes_) {
      if (isPerCorner(attribute)) continue;
      for (const std::string& name : propertiesOf(attribute)) {
        text += std::string("property ") + (isByteColor(attribute) ? "uchar " : "float ") + name + "\n";
      }
    }
    const std::string list = wide_ ? "property list uint " : "property list uchar ";
    text += "element face " + std::to_string(face_count_) + "\n" + list + "int vertex_indices\n";
    if (corner_texcoords_) text += list + "float texcoord\n";
    return text + "end_header\n";
  }

  std::vector<SceneMesh> meshes_;
  Exported out_;
  std::vector<Attribute> attributes_;  ///< what is written, without data
  bool corner_texcoords_ = false;      ///< texture coordinates go to the faces
  bool by_wedge_ = false;              ///< a vertex of the file is a wedge
  bool wide_ = false;                  ///< lists have counts of four bytes
  Index vertex_count_ = 0;
  size_t face_count_ = 0;
  std::vector<Index> vertex_bases_;
  size_t mesh_number_ = 0;
  Bytes vertices_, faces_;
};

}  // namespace

Exported exportPly(const Scene& scene, const std::filesystem::path& path) { return PlyWriter(scene).run(path); }

}  // namespace tutte
