#include "tools/flat_scene.h"

#include <algorithm>
#include <cmath>

#include "gltf_ext/attribute_words.h"
#include "tools/places.h"
#include "tools/values.h"

namespace tutte {
namespace {

int bitsOf(const std::string& name, const PackOptions& options) {
  if (name == "POSITION" || name.starts_with("POSITION@")) return options.position_bits;
  if (name == "NORMAL" || name == "TANGENT") return options.normal_bits;
  if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) return 0;
  if (name.find('@') != name.npos) return options.generic_bits;
  if (name.starts_with("TEXCOORD_")) return options.texcoord_bits;
  if (name.starts_with("COLOR_")) return options.color_bits;
  return options.generic_bits;
}

double extentOf(const std::vector<float>& values, int components) {
  double extent = 0;
  for (int i = 0; i < components; ++i) {
    double low = INFINITY, high = -INFINITY;
    for (size_t at = static_cast<size_t>(i); at < values.size(); at += static_cast<size_t>(components)) {
      low = std::min<double>(low, values[at]);
      high = std::max<double>(high, values[at]);
    }
    if (low <= high) extent = std::max(extent, high - low);
  }
  return extent;
}

/// Half a step of the quantiser: the largest extent of a component, which is at least `extent`, in 2^bits - 1 steps.
double quantizationError(const std::vector<float>& values, int components, int bits, double extent) {
  double largest = 0;
  for (const float value : values) largest = std::max<double>(largest, std::abs(value));
  return 0.5 * std::max(extent, extentOf(values, components)) / (std::exp2(bits) - 1) * 1.0001 +
         largest * std::exp2(-22);
}

/// OBJ and PLY count texture coordinates from the other edge of the picture; going there and back costs rounding.
double flippingError(const std::vector<float>& values) {
  double largest = 1;
  for (float value : values) largest = std::max<double>(largest, std::abs(value));
  return largest * std::exp2(-23);
}

/// `extent` is that of the scene's largest mesh.
double toleranceOf(const Attribute& attribute, const std::vector<float>& values, const Tolerances& tolerances,
                   double extent) {
  if (tolerances.exact) return 0;
  const double flipping = attribute.name.starts_with("TEXCOORD_") ? flippingError(values) : 0;
  if (attribute.type != ComponentType::kFloat) return attribute.normalized ? 1e-6 : 0;
  if (const auto known = tolerances.bounds.find(attribute.name); known != tolerances.bounds.end()) {
    return known->second + flipping;
  }
  const int bits = bitsOf(attribute.name, tolerances.bits);
  if (bits == 0) return flipping;
  // A unit vector on the octahedron: steps are wider where it is stretched most.
  if (attribute.name == "NORMAL" || attribute.name == "TANGENT") return 4 / std::exp2(bits);
  const bool position = attribute.name.starts_with("POSITION");
  const double error = quantizationError(values, attribute.components, bits, position ? extent : 0);
  // Colors are stored on a grid from 0 to 1, however little of it they use.
  return attribute.name.starts_with("COLOR_") ? std::max(error, 0.5001 / (std::exp2(bits) - 1)) : error;
}

class Flattener {
 public:
  Flattener(const Scene& scene, const Tolerances& tolerances) : scene_(scene), tolerances_(tolerances) {
    for (const SceneMesh& mesh : scene.meshes) {
      if (const Attribute* positions = findAttribute(mesh.mesh, "POSITION")) {
        extent_ = std::max(extent_, extentOf(floatsOf(*positions), positions->components));
      }
    }
  }

  FlatScene run() {
    for (const Place& place : placesOf(scene_)) addMesh(scene_.meshes[place.mesh].mesh, place.matrix);
    flat_.face_starts.push_back(static_cast<Index>(flat_.corners.size()));
    for (FlatAttribute& attribute : flat_.attributes) fill(attribute);
    return std::move(flat_);
  }

 private:
  void addMesh(const PolygonMesh& mesh, const Matrix& matrix) {
    const auto vertex_base = static_cast<Index>(flat_.positions.size());
    const auto wedge_base = static_cast<Index>(flat_.wedge_meshes.size());
    const auto face_base = static_cast<Index>(flat_.face_starts.size());
    flat_.mesh_faces.push_back(face_base);
    flat_.wedge_meshes.resize(wedge_base + mesh.wedge_count, mesh_number_);
    addFaces(mesh, vertex_base, wedge_base, face_base);
    addVertices(mesh, wedge_base, matrix);
    for (const Attribute& attribute : mesh.attributes) {
      if (attribute.name != "POSITION" || tolerances_.exact) addAttribute(attribute, wedge_base, matrix);
    }
    ++mesh_number_;
  }

  void addFaces(const PolygonMesh& mesh, Index vertex_base, Index wedge_base, Index face_base) {
    auto corner = static_cast<Index>(flat_.corners.size());
    for (size_t face = 0; face < mesh.polygons.face_degrees.size(); ++face) {
      flat_.face_starts.push_back(corner);
      corner += mesh.polygons.face_degrees[face];
      const Index owner = mesh.ring_owners.empty() ? kNone : mesh.ring_owners[face];
      flat_.owners.push_back(owner == kNone ? kNone : face_base + owner);
      flat_.face_meshes.push_back(mesh_number_);
    }
    for (Index i = 0; i < mesh.polygons.corners.size(); ++i) {
      flat_.corners.push_back(vertex_base + mesh.polygons.corners[i]);
      flat_.wedges.push_back(wedge_base + mesh.wedgeOf(i));
    }
  }

  void addVertices(const PolygonMesh& mesh, Index wedge_base, const Matrix& matrix) {
    std::vector<Index> wedge_of(mesh.polygons.vertex_count, kNone);
    for (Index i = 0; i < mesh.polygons.corners.size(); ++i) wedge_of[mesh.polygons.corners[i]] = mesh.wedgeOf(i);
    Index isolated = mesh.wedge_count;  // they come last, vertices as well as wedges
    for (size_t vertex = wedge_of.size(); vertex-- > 0;) {
      if (wedge_of[vertex] == kNone) wedge_of[vertex] = --isolated;
    }
    const Attribute* attribute = findAttribute(mesh, "POSITION");
    const std::vector<float> values = attribute ? floatsOf(*attribute) : std::vector<float>(3 * mesh.wedge_count);
    const bool given = tolerances_.position >= 0 || !attribute;
    const double own =
        given ? std::max(tolerances_.position, 0.0) : toleranceOf(*attribute, values, tolerances_, extent_);
    double largest = 0;
    for (Index wedge : wedge_of) {
      const auto at = transformPoint(matrix, {values[3 * wedge], values[3 * wedge + 1], values[3 * wedge + 2]});
      flat_.positions.push_back(at);
      flat_.vertex_wedges.push_back(wedge_base + wedge);
      for (double coordinate : at) largest = std::max(largest, std::abs(coordinate));
    }
    const double rounding = matrix == kIdentity || tolerances_.exact ? 0 : largest * std::exp2(-20);
    flat_.tolerances.resize(flat_.positions.size(), own * largestScale(matrix) + rounding);
  }

  void addAttribute(const Attribute& attribute, Index wedge_base, const Matrix& matrix) {
    auto found = std::find_if(flat_.attributes.begin(), flat_.attributes.end(),
                              [&](const FlatAttribute& other) { return other.name == attribute.name; });
    if (found == flat_.attributes.end()) {
      flat_.attributes.push_back({attribute.name, attribute.components, {}, {}, {}, {}, {}});
      found = flat_.attributes.end() - 1;
    }
    std::vector<float> values = floatsOf(attribute);
    found->given.resize(mesh_number_ + 1);
    found->given[mesh_number_] = 1;
    found->tolerances.resize(mesh_number_ + 1);
    if (tolerances_.exact) addBits(attribute, wedge_base, *found);
    const double rounding = matrix == kIdentity || tolerances_.exact ? 0 : 1e-6;
    found->tolerances[mesh_number_] = toleranceOf(attribute, values, tolerances_, extent_) + rounding;
    if (attribute.name == "NORMAL") turn(values, matrix);
    found->values.resize(size_t{wedge_base} * found->components);
    for (size_t i = 0; i < values.size() / attribute.components; ++i) {
      for (int c = 0; c < found->components; ++c) {
        found->values.push_back(c < attribute.components ? values[i * attribute.components + c] : 1.0f);
      }
    }
  }

  void addBits(const Attribute& attribute, Index wedge_base, FlatAttribute& flat) const {
    flat.types.resize(mesh_number_ + 1);
    flat.types[mesh_number_] = attribute.components | static_cast<uint32_t>(attribute.type) << 8 |
                               static_cast<uint32_t>(attribute.normalized) << 31;
    flat.bits.resize(size_t{wedge_base} * flat.components);
    for (size_t i = 0; i < attribute.data.size() / attribute.stride(); ++i) {
      for (uint32_t c = 0; c < flat.components; ++c) {
        const uint32_t size = sizeOf(attribute.type);
        const uint8_t* const data = &attribute.data[i * attribute.stride()];
        flat.bits.push_back(c < attribute.components ? loadBytes(data + c * size, size) : 0);
      }
    }
  }

  static void turn(std::vector<float>& values, const Matrix& matrix) {
    for (size_t i = 0; i + 2 < values.size() && matrix != kIdentity; i += 3) {
      const auto turned = transformNormal(matrix, {values[i], values[i + 1], values[i + 2]});
      for (int axis = 0; axis < 3; ++axis) values[i + axis] = static_cast<float>(turned[axis]);
    }
  }

  void fill(FlatAttribute& attribute) const {
    attribute.given.resize(mesh_number_);
    attribute.tolerances.resize(mesh_number_);
    attribute.types.resize(mesh_number_);
    if (tolerances_.exact) attribute.bits.resize(flat_.wedge_meshes.size() * attribute.components);
    attribute.values.resize(flat_.wedge_meshes.size() * attribute.components);
  }

  const Scene& scene_;
  const Tolerances& tolerances_;
  double extent_ = 0;  ///< of the largest mesh
  Index mesh_number_ = 0;
  FlatScene flat_;
};

}  // namespace

FlatScene flatten(const Scene& scene, const Tolerances& tolerances) { return Flattener(scene, tolerances).run(); }

}  // namespace tutte
