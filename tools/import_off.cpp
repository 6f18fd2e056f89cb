// OFF, read here because Assimp refuses the binary kind and stumbles over some files of the other.

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

#include "tools/import.h"
#include "tools/indexed_mesh.h"
#include "tools/text.h"
#include "tools/values.h"

namespace tutte {
namespace {

/// What the keyword in front says: [ST][C][N]OFF [BINARY].
struct OffKind {
  bool texcoords = false;
  bool colors = false;
  bool normals = false;
  bool binary = false;
};

/// The mesh so far.
struct OffMesh {
  IndexedMesh mesh;
  std::vector<float> positions, normals, colors, texcoords;
  int color_components = 0;
  size_t ignored = 0;  ///< vertices and faces with values that we have no place for

  Imported finish(bool with_normals, bool with_texcoords) {
    Imported result;
    mesh.vertex_attributes.push_back(floatAttribute("POSITION", 3, positions));
    if (with_normals) mesh.vertex_attributes.push_back(floatAttribute("NORMAL", 3, normals));
    if (color_components) addColors();
    if (with_texcoords) mesh.vertex_attributes.push_back(floatAttribute("TEXCOORD_0", 2, texcoords));
    if (ignored) {
      result.warnings.push_back(std::to_string(ignored) +
                                " vertices and faces have further values (colours of faces, "
                                "for instance), which are not carried over");
    }
    SceneMesh scene_mesh;
    scene_mesh.mesh = buildMesh(std::move(mesh), result.warnings);
    result.scene.meshes.push_back(std::move(scene_mesh));
    return result;
  }

  /// Colours are 0 to 255 or 0 to 1; no file says which.
  void addColors() {
    const auto components = static_cast<uint8_t>(color_components);
    if (std::all_of(colors.begin(), colors.end(), [](float value) { return value <= 1; })) {
      return mesh.vertex_attributes.push_back(floatAttribute("COLOR_0", components, colors));
    }
    std::vector<uint8_t> bytes;
    for (size_t i = 0; i < colors.size(); ++i) {
      bytes.push_back(static_cast<uint8_t>(std::clamp(colors[i], 0.0f, 255.0f)));
      if (components == 3 && i % 3 == 2) bytes.push_back(255);
    }
    mesh.vertex_attributes.push_back(byteAttribute("COLOR_0", 4, bytes));
  }
};

class OffText {
 public:
  OffText(std::string_view text, OffKind kind, size_t line) : rest_(text), kind_(kind), line_(line) {}

  Outcome<Imported> run() {
    const auto vertices = word<Index>("a count of vertices"), faces = word<Index>("a count of faces");
    skipLine();  // a count of edges, which nobody keeps right
    if (vertices > rest_.size() || faces > rest_.size()) fail("the file is too short for its counts; correct them");
    if (failure_) return *failure_;
    out_.mesh.vertex_count = vertices;
    for (Index i = 0; i < vertices && !failure_; ++i) readVertex();
    for (Index i = 0; i < faces && !failure_; ++i) readFace();
    if (failure_) return *failure_;
    return out_.finish(kind_.normals, kind_.texcoords);
  }

 private:
  void fail(std::string what) {
    if (!failure_) failure_ = {FailureKind::kInvalid, "line " + std::to_string(line_), std::move(what)};
    rest_ = {};
  }

  /// Takes words until the end of the line.
  std::string_view wordOfLine() {
    const size_t end = std::min(rest_.find_first_of("\n#"), rest_.size());
    std::string_view line = rest_.substr(0, end);
    const std::string_view found = nextWord(line);
    rest_.remove_prefix(end - line.size());
    return found;
  }

  bool skipLine() {
    const bool empty = wordOfLine().empty();
    const size_t end = rest_.find('\n');
    rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
    ++line_;
    return empty;
  }

  std::string_view word() {
    while (!rest_.empty()) {
      if (const std::string_view found = wordOfLine(); !found.empty()) return found;
      skipLine();
    }
    return {};
  }

  template <class T>
  T word(const char* what) {
    const std::string_view found = word();
    const auto value = parseInteger<T>(found);
    if (!value)
      fail(std::string(what) + " is missing; " +
           (found.empty() ? "the file ends too early, get it once more" : "correct it"));
    return value.value_or(0);
  }

  void numbers(std::vector<float>& values, int count) {
    for (int i = 0; i < count; ++i) {
      const auto value = parseFloat(word());
      if (!value) fail("a finite number is missing; correct it");
      values.push_back(value.value_or(0));
    }
  }

  void readVertex() {
    numbers(out_.positions, 3);
    if (kind_.normals) numbers(out_.normals, 3);
    if (kind_.colors) readColor();
    if (kind_.texcoords) numbers(out_.texcoords, 2);
    if (!failure_) out_.ignored += !skipLine();
  }

  /// Three or four numbers: the line of the first vertex decides.
  void readColor() {
    if (out_.color_components == 0) {
      const std::string_view saved = rest_;
      int words = 0;
      while (!wordOfLine().empty()) ++words;
      rest_ = saved;
      out_.color_components = words - (kind_.texcoords ? 2 : 0) >= 4 ? 4 : 3;
    }
    numbers(out_.colors, out_.color_components);
  }

  void readFace() {
    const auto degree = word<Index>("the number of corners of a face");
    out_.mesh.face_degrees.push_back(degree);
    for (Index i = 0; i < degree && !failure_; ++i) {
      const auto vertex = word<Index>("a vertex number of a face");
      if (vertex >= out_.mesh.vertex_count) {
        fail("the face names vertex " + std::to_string(vertex) + ", but there are only " +
             std::to_string(out_.mesh.vertex_count) + "; correct the number");
      }
      out_.mesh.corners.push_back(vertex);
    }
    if (!failure_) out_.ignored += !skipLine();
  }

  std::string_view rest_;
  OffKind kind_;
  size_t line_;
  std::optional<Failure> failure_;
  OffMesh out_;
};

/// Binary OFF is big-endian by definition and little-endian in the wild; the number of colour values behind each face
/// is there by definition and often left out. The reading that uses the file up exactly, with all vertex numbers in
/// range, is the right one.
class OffBinary {
 public:
  OffBinary(std::span<const uint8_t> bytes, OffKind kind) : bytes_(bytes), kind_(kind) {}

  Outcome<Imported> run() {
    for (const bool big : {true, false}) {
      for (const bool counts : {true, false}) {
        out_ = {};
        rest_ = bytes_;
        big_ = big;
        face_colors_ = counts;
        if (read()) return out_.finish(kind_.normals, kind_.texcoords);
      }
    }
    return Failure{
        FailureKind::kInvalid, "after the keyword",
        "the counts and the faces fit together in neither byte order; the file is damaged, get it once more"};
  }

 private:
  bool take(uint32_t& value) {
    if (rest_.size() < 4) return false;
    value = 0;
    for (int i = 0; i < 4; ++i) value |= uint32_t{rest_[i]} << 8 * (big_ ? 3 - i : i);
    rest_ = rest_.subspan(4);
    return true;
  }

  bool takeFloats(std::vector<float>& values, int count) {
    for (int i = 0; i < count; ++i) {
      uint32_t bits = 0;
      if (!take(bits)) return false;
      values.push_back(std::bit_cast<float>(bits));
      if (!std::isfinite(values.back())) return false;
    }
    return true;
  }

  bool read() {
    uint32_t vertices = 0, faces = 0, edges = 0;
    if (!take(vertices) || !take(faces) || !take(edges)) return false;
    if (vertices > rest_.size() / 12 || faces > rest_.size() / 4) return false;
    out_.mesh.vertex_count = vertices;
    out_.color_components = kind_.colors ? 4 : 0;
    for (uint32_t i = 0; i < vertices; ++i) {
      if (!takeFloats(out_.positions, 3) || (kind_.normals && !takeFloats(out_.normals, 3)) ||
          (kind_.colors && !takeFloats(out_.colors, 4)) || (kind_.texcoords && !takeFloats(out_.texcoords, 2))) {
        return false;
      }
    }
    for (uint32_t i = 0; i < faces; ++i) {
      if (!readFace()) return false;
    }
    return rest_.empty();
  }

  bool readFace() {
    uint32_t degree = 0, colors = 0;
    if (!take(degree) || degree == 0 || degree > rest_.size() / 4) return false;
    out_.mesh.face_degrees.push_back(degree);
    for (uint32_t i = 0; i < degree; ++i) {
      uint32_t vertex = 0;
      if (!take(vertex) || vertex >= out_.mesh.vertex_count) return false;
      out_.mesh.corners.push_back(vertex);
    }
    if (!face_colors_) return true;
    if (!take(colors) || colors > rest_.size() / 4) return false;
    out_.ignored += colors > 0;
    rest_ = rest_.subspan(size_t{4} * colors);
    return true;
  }

  std::span<const uint8_t> bytes_;
  std::span<const uint8_t> rest_;
  OffKind kind_;
  bool big_ = true;
  bool face_colors_ = true;
  OffMesh out_;
};

/// The keyword is optional; a file may begin with its counts. Takes it off the front of `text`.
std::optional<OffKind> takeKeyword(std::string_view& text, size_t& line) {
  while (!text.empty() && (isBlank(text[0]) || text[0] == '\n' || text[0] == '#')) {
    const size_t end = text[0] == '#' ? std::min(text.find('\n'), text.size() - 1) : 0;
    line += text[end] == '\n';
    text.remove_prefix(end + 1);
  }
  OffKind kind;
  std::string_view word = text.substr(0, text.find_first_of(" \t\r\n#"));
  const size_t length = word.size();
  if (parseInteger<Index>(word)) return kind;
  if (word.starts_with("ST")) kind.texcoords = true, word.remove_prefix(2);
  if (word.starts_with("C")) kind.colors = true, word.remove_prefix(1);
  if (word.starts_with("N")) kind.normals = true, word.remove_prefix(1);
  if (word != "OFF") return {};
  text.remove_prefix(length);
  std::string_view rest = text.substr(0, text.find('\n'));
  if (nextWord(rest) == "BINARY") {
    kind.binary = true;
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  return kind;
}

}  // namespace

Outcome<Imported> importOff(std::span<const uint8_t> bytes) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  size_t line = 1;
  const std::optional<OffKind> kind = takeKeyword(text, line);
  if (!kind) {
    return Failure{FailureKind::kUnsupported, "line " + std::to_string(line),
                   "the first word is not OFF (with ST, C or N before it); give a file in three dimensions"};
  }
  if (kind->binary) return OffBinary(bytes.last(text.size()), *kind).run();
  return OffText(text, *kind, line).run();
}

}  // namespace tutte
