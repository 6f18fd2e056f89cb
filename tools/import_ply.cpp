// PLY, read here because Assimp takes a triangle strip for one large face, and cannot tell where a file is wrong.

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "tools/import.h"
#include "tools/indexed_mesh.h"
#include "tools/ply_header.h"
#include "tools/ply_values.h"
#include "tools/ply_vertices.h"
#include "tools/values.h"

namespace tutte {
namespace {

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
    if (!vertices_.columns.empty() || element.count >= kNone) {
      fail(element, 0, "there is a second list of vertices, or too many of them; split the file");
      return;
    }
    vertices_.properties = element.properties;
    vertices_.columns.resize(element.properties.size());
    for (auto& column : vertices_.columns) column.reserve(element.count);
    for (uint64_t vertex = 0; vertex < element.count && !failure_; ++vertex) {
      for (size_t i = 0; i < element.properties.size() && !failure_; ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.is_list)
          readList(element, vertex, property);
        else
          vertices_.columns[i].push_back(static_cast<float>(value(element, vertex, property.type)));
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
    addVertexAttributes(vertices_, mesh_, warnings_);
    if (!texcoords_.empty()) addCornerTexcoords();
    Imported result;
    result.warnings = std::move(warnings_);
    SceneMesh mesh;
    mesh.mesh = buildMesh(std::move(mesh_), result.warnings);
    result.scene.meshes.push_back(std::move(mesh));
    return result;
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
  PlyVertices vertices_;
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
