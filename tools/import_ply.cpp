// PLY, read here because Assimp takes a triangle strip for one large face, and cannot tell where a file is wrong.

#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "tools/import.h"
#include "tools/indexed_mesh.h"
#include "tools/ply_header.h"
#include "tools/ply_values.h"
#include "tools/values.h"

namespace tutte {
namespace {

/// What a vertex property is for us: an attribute and which of its components.
struct Target {
  const char* attribute = nullptr;
  uint8_t component = 0;
};

Target targetOf(const std::string& name) {
  static const std::map<std::string, Target> targets = {{"x", {"POSITION", 0}},
                                                        {"y", {"POSITION", 1}},
                                                        {"z", {"POSITION", 2}},
                                                        {"nx", {"NORMAL", 0}},
                                                        {"ny", {"NORMAL", 1}},
                                                        {"nz", {"NORMAL", 2}},
                                                        {"s", {"TEXCOORD_0", 0}},
                                                        {"t", {"TEXCOORD_0", 1}},
                                                        {"u", {"TEXCOORD_0", 0}},
                                                        {"v", {"TEXCOORD_0", 1}},
                                                        {"texture_u", {"TEXCOORD_0", 0}},
                                                        {"texture_v", {"TEXCOORD_0", 1}},
                                                        {"red", {"COLOR_0", 0}},
                                                        {"green", {"COLOR_0", 1}},
                                                        {"blue", {"COLOR_0", 2}},
                                                        {"alpha", {"COLOR_0", 3}},
                                                        {"r", {"COLOR_0", 0}},
                                                        {"g", {"COLOR_0", 1}},
                                                        {"b", {"COLOR_0", 2}},
                                                        {"a", {"COLOR_0", 3}},
                                                        {"diffuse_red", {"COLOR_0", 0}},
                                                        {"diffuse_green", {"COLOR_0", 1}},
                                                        {"diffuse_blue", {"COLOR_0", 2}}};
  const auto found = targets.find(name);
  return found == targets.end() ? Target{} : found->second;
}

class PlyReader {
 public:
  PlyReader(std::span<const uint8_t> bytes, PlyHeader header)
      : header_(std::move(header)), values_(bytes, header_), bytes_left_(bytes.size()) {}

  Outcome<Imported> run() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (element.count > bytes_left_)
        return fail(element, 0, "the file is too short for all of them; get it once more");
      if (element.name == "vertex")
        readVertices(element);
      else
        readOthers(element);
      if (failure_) return *failure_;
    }
    return finish();
  }

 private:
  Failure fail(const PlyElement& element, uint64_t number, std::string what) {
    failure_ = {FailureKind::kInvalid, element.name + " " + std::to_string(number), std::move(what)};
    return *failure_;
  }

  double value(const PlyElement& element, uint64_t number, PlyType type) {
    const auto next = values_.next(type);
    if (next && std::abs(*next) <= std::numeric_limits<float>::max()) return *next;
    if (!failure_) {
      fail(element, number,
           next || !values_.atEnd() ? "there is no finite number where one belongs; correct it"
                                    : "the file ends too early; get it once more");
    }
    return 0;
  }

  void readVertices(const PlyElement& element) {
    if (!columns_.empty() || element.count >= kNone) {
      fail(element, 0, "there is a second list of vertices, or too many of them; split the file");
      return;
    }
    columns_.resize(element.properties.size());
    for (auto& column : columns_) column.reserve(element.count);
    vertex_properties_ = element.properties;
    for (uint64_t vertex = 0; vertex < element.count && !failure_; ++vertex) {
      for (size_t i = 0; i < element.properties.size() && !failure_; ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.is_list)
          readList(element, vertex, property);
        else
          columns_[i].push_back(static_cast<float>(value(element, vertex, property.type)));
      }
    }
    mesh_.vertex_count = static_cast<Index>(element.count);
  }

  /// Faces and strips, and elements that we only pass over.
  void readOthers(const PlyElement& element) {
    const bool strips = element.name == "tristrips";
    bool used = false;
    for (uint64_t number = 0; number < element.count && !failure_; ++number) {
      for (const PlyProperty& property : element.properties) {
        if (!property.is_list) {
          value(element, number, property.type);
          continue;
        }
        readList(element, number, property);
        const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
        if (indices && (strips || element.name == "face")) {
          used = true;
          strips ? addStrip(element, number) : addFace(element, number);
        } else if (property.name == "texcoord" && element.name == "face") {
          addTexcoords(element, number);
        }
        if (failure_) return;
      }
    }
    if (!used && element.count > 0) warnings_.push_back("element '" + element.name + "' is not carried over");
    if (used && element.properties.size() > 1) warnAboutFaces(element);
  }

  void warnAboutFaces(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (property.is_list && (property.name.starts_with("vertex_ind") || property.name == "texcoord")) continue;
      warnings_.push_back("property '" + property.name + "' of faces is not carried over");
    }
  }

  void readList(const PlyElement& element, uint64_t number, const PlyProperty& property) {
    list_.clear();
    const double count = value(element, number, property.count_type);
    if (failure_) return;
    if (count < 0 || count != std::floor(count)) {
      fail(element, number, "a list has no proper length; correct it");
      return;
    }
    for (double i = 0; i < count && !failure_; ++i) list_.push_back(value(element, number, property.type));
  }

  void addFace(const PlyElement& element, uint64_t number) {
    mesh_.face_degrees.push_back(static_cast<Index>(list_.size()));
    for (double index : list_) addCorner(element, number, index);
  }

  void addCorner(const PlyElement& element, uint64_t number, double index) {
    if (index < 0 || index >= std::numeric_limits<Index>::max() || index != std::floor(index)) {
      if (!failure_) fail(element, number, "a corner names no vertex; indices count from 0");
      return;
    }
    mesh_.corners.push_back(static_cast<Index>(index));
    origins_.push_back({&element, number});
  }

  /// Triangles of a strip; -1 begins a new one. Every second triangle is turned, and those that repeat a vertex only
  /// lead to another place.
  void addStrip(const PlyElement& element, uint64_t number) {
    size_t start = 0;
    for (size_t i = 0; i < list_.size() && !failure_; ++i) {
      if (list_[i] == -1) {
        start = i + 1;
      } else if (i >= start + 2) {
        const bool odd = (i - start) % 2 == 1;
        const double a = list_[i - 2 + odd], b = list_[i - 1 - odd], c = list_[i];
        if (a == b || b == c || a == c) continue;
        mesh_.face_degrees.push_back(3);
        for (double index : {a, b, c}) addCorner(element, number, index);
      }
    }
  }

  /// Two numbers per corner of the face; they may come before or after its indices.
  void addTexcoords(const PlyElement& element, uint64_t number) {
    if (texcoord_starts_.size() <= number) texcoord_starts_.resize(number + 1, texcoords_.size());
    if (list_.size() % 2 != 0 && !failure_) {
      fail(element, number, "texture coordinates come in pairs; correct the list");
      return;
    }
    for (size_t i = 0; i < list_.size(); i += 2) {
      texcoords_.push_back(static_cast<float>(list_[i]));
      texcoords_.push_back(1 - static_cast<float>(list_[i + 1]));
    }
  }

  Outcome<Imported> finish() {
    for (size_t i = 0; i < mesh_.corners.size(); ++i) {
      if (mesh_.corners[i] < mesh_.vertex_count) continue;
      return fail(*origins_[i].first, origins_[i].second,
                  "it names vertex " + std::to_string(mesh_.corners[i]) + ", but there are only " +
                      std::to_string(mesh_.vertex_count) + "; correct the index");
    }
    addVertexAttributes();
    if (!texcoords_.empty()) addCornerTexcoords();
    Imported result;
    result.warnings = std::move(warnings_);
    SceneMesh mesh;
    mesh.mesh = buildMesh(std::move(mesh_), result.warnings);
    result.scene.meshes.push_back(std::move(mesh));
    return result;
  }

  void addVertexAttributes() {
    addAttribute("POSITION", 3, 3);
    addAttribute("NORMAL", 3, 3);
    addAttribute("TEXCOORD_0", 2, 2);
    addAttribute("COLOR_0", 3, 4);
    for (size_t i = 0; i < columns_.size(); ++i) {
      const PlyProperty& property = vertex_properties_[i];
      if (targetOf(property.name).attribute) continue;
      if (property.is_list) {
        warnings_.push_back("list '" + property.name + "' of vertices is not carried over");
      } else {
        mesh_.vertex_attributes.push_back(floatAttribute(customName(property.name), 1, columns_[i]));
      }
    }
  }

  static std::string customName(const std::string& name) {
    std::string result = "_";
    for (char c : name)
      result += static_cast<char>(std::isalnum(static_cast<unsigned char>(c)) ? std::toupper(c) : '_');
    return result;
  }

  /// The attribute, if the file has at least its first `least` components. Byte colours stay bytes, and opaque.
  void addAttribute(const char* name, uint8_t least, uint8_t most) {
    std::vector<const std::vector<float>*> columns(most);
    bool bytes = true;
    for (size_t i = 0; i < columns_.size(); ++i) {
      const Target target = targetOf(vertex_properties_[i].name);
      if (!target.attribute || target.attribute != std::string_view(name) || vertex_properties_[i].is_list) continue;
      columns[target.component] = &columns_[i];
      bytes = bytes && vertex_properties_[i].type == PlyType::kUint8;
    }
    uint8_t components = 0;
    while (components < most && columns[components]) ++components;
    const bool position = name == std::string_view("POSITION");
    if (components < least && !position) return;
    const bool byte_colors = bytes && name == std::string_view("COLOR_0");
    if (byte_colors) components = 4;
    if (position) components = 3;
    std::vector<float> values;
    for (size_t vertex = 0; vertex < mesh_.vertex_count; ++vertex) {
      for (int i = 0; i < components; ++i) {
        const float absent = i == 3 ? 255.0f : 0.0f;
        const float given = columns[i] ? (*columns[i])[vertex] : absent;
        values.push_back(name == std::string_view("TEXCOORD_0") && i == 1 ? 1 - given : given);
      }
    }
    mesh_.vertex_attributes.push_back(byte_colors
                                          ? byteAttribute(name, 4, std::vector<uint8_t>(values.begin(), values.end()))
                                          : floatAttribute(name, components, values));
  }

  /// Equal pairs get one number. Faces whose list has not as many pairs as the face has corners get none.
  void addCornerTexcoords() {
    std::vector<Index> indices(mesh_.corners.size(), kNone);
    std::map<std::pair<float, float>, Index> numbers;
    std::vector<float> values;
    texcoord_starts_.resize(mesh_.face_degrees.size() + 1, texcoords_.size());
    size_t corner = 0;
    for (size_t face = 0; face < mesh_.face_degrees.size(); corner += mesh_.face_degrees[face++]) {
      const size_t start = texcoord_starts_[face];
      if (texcoord_starts_[face + 1] - start != size_t{2} * mesh_.face_degrees[face]) continue;
      for (size_t i = 0; i < mesh_.face_degrees[face]; ++i) {
        const std::pair pair{texcoords_[start + 2 * i], texcoords_[start + 2 * i + 1]};
        const auto [found, added] = numbers.try_emplace(pair, static_cast<Index>(numbers.size()));
        if (added) values.insert(values.end(), {pair.first, pair.second});
        indices[corner + i] = found->second;
      }
    }
    std::erase_if(mesh_.vertex_attributes, [](const Attribute& attribute) { return attribute.name == "TEXCOORD_0"; });
    mesh_.corner_attributes.push_back({floatAttribute("TEXCOORD_0", 2, values), std::move(indices)});
  }

  PlyHeader header_;
  PlyValues values_;
  size_t bytes_left_;
  std::optional<Failure> failure_;
  std::vector<std::string> warnings_;
  IndexedMesh mesh_;
  std::vector<PlyProperty> vertex_properties_;
  std::vector<std::vector<float>> columns_;
  std::vector<double> list_;
  std::vector<std::pair<const PlyElement*, uint64_t>> origins_;  // per corner, for messages
  std::vector<float> texcoords_;
  std::vector<size_t> texcoord_starts_;
};

}  // namespace

Outcome<Imported> importPly(std::span<const uint8_t> bytes) {
  Outcome<PlyHeader> header = readPlyHeader(bytes);
  if (!header) return header.error();
  return PlyReader(bytes, *std::move(header)).run();
}

}  // namespace tutte
