#include "gltf_ext/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "gltf_ext/ear_clipping.h"

namespace tutte {
namespace {

using Point3 = std::array<double, 3>;

template <class T>
double load(const uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

/// POSITION of a wedge, from whatever type it is stored in. (Normalisation is a scale, which does not matter here.)
class Positions {
 public:
  explicit Positions(const PolygonMesh& mesh) {
    for (const Attribute& attribute : mesh.attributes) {
      const bool whole = attribute.data.size() >= size_t{mesh.wedge_count} * attribute.stride();
      if (attribute.name == "POSITION" && attribute.components == 3 && whole) attribute_ = &attribute;
    }
  }

  bool given() const { return attribute_ != nullptr; }

  Point3 operator[](Index wedge) const {
    const uint32_t size = sizeOf(attribute_->type);
    const uint8_t* bytes = attribute_->data.data() + size_t{wedge} * 3 * size;
    return {component(bytes), component(bytes + size), component(bytes + 2 * size)};
  }

 private:
  double component(const uint8_t* bytes) const {
    switch (attribute_->type) {
      case ComponentType::kInt8: return load<int8_t>(bytes);
      case ComponentType::kUint8: return load<uint8_t>(bytes);
      case ComponentType::kInt16: return load<int16_t>(bytes);
      case ComponentType::kUint16: return load<uint16_t>(bytes);
      case ComponentType::kUint32: return load<uint32_t>(bytes);
      default: return load<float>(bytes);
    }
  }

  const Attribute* attribute_ = nullptr;
};

/// Newell's normal of a ring: its length is twice the area, for a ring that is not planar too.
Point3 normalOf(std::span<const Point3> ring) {
  Point3 normal{};
  const Point3& origin = ring[0];
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const int y = (axis + 1) % 3, z = (axis + 2) % 3;
      normal[axis] += (ring[i][y] - origin[y]) * (ring[i + 1][z] - origin[z]) -
                      (ring[i][z] - origin[z]) * (ring[i + 1][y] - origin[y]);
    }
  }
  return normal;
}

class FaceTriangulator {
 public:
  explicit FaceTriangulator(PolygonMesh& mesh) : mesh_(mesh), positions_(mesh) {
    const auto& degrees = mesh.polygons.face_degrees;
    starts_.resize(degrees.size());
    Index start = 0;
    for (size_t face = 0; face < degrees.size(); start += degrees[face++]) starts_[face] = start;
    linkHoles();
  }

  void run() {
    const auto faces = static_cast<Index>(mesh_.polygons.face_degrees.size());
    mesh_.triangulation.counts.assign(faces, 0);
    mesh_.triangulation.corners.reserve(mesh_.polygons.corners.size() * 3);
    for (Index face = 0; face < faces; ++face) {
      if (isHole(face)) continue;
      const size_t before = mesh_.triangulation.corners.size();
      triangulateFace(face);
      mesh_.triangulation.counts[face] = static_cast<Index>((mesh_.triangulation.corners.size() - before) / 3);
    }
  }

 private:
  bool isHole(Index face) const { return !mesh_.ring_owners.empty() && mesh_.ring_owners[face] != kNone; }

  void linkHoles() {
    for (Index face = 0; face < mesh_.ring_owners.size(); ++face) {
      if (mesh_.ring_owners[face] != kNone) holes_.push_back({mesh_.ring_owners[face], face});
    }
    std::sort(holes_.begin(), holes_.end());
  }

  std::span<const std::pair<Index, Index>> holesOf(Index face) const {
    const auto first = std::lower_bound(holes_.begin(), holes_.end(), std::pair{face, Index{0}});
    const auto last = std::find_if(first, holes_.end(), [&](const auto& hole) { return hole.first != face; });
    return {first, last};
  }

  void triangulateFace(Index face) {
    const Index degree = mesh_.polygons.face_degrees[face];
    if (degree < 3) return;
    const auto holes = holesOf(face);
    if (degree == 3 && holes.empty()) return addFan(starts_[face], degree, 0);
    corners_.clear();
    ring_sizes_.clear();
    addRing(face);
    for (const auto& [owner, hole] : holes) addRing(hole);
    if (!project(degree) && holes.empty()) return addFan(starts_[face], degree, 0);
    const Index apex = holes.empty() ? findApex() : kNone;
    if (apex != kNone) return addFan(starts_[face], degree, apex);
    ears_.clear();
    clipEars(flat_, ring_sizes_, tolerance_, ears_);
    for (Index point : ears_) mesh_.triangulation.corners.push_back(corners_[point]);
  }

  void addRing(Index face) {
    const Index degree = mesh_.polygons.face_degrees[face];
    if (degree < 3) return;
    for (Index i = 0; i < degree; ++i) corners_.push_back(starts_[face] + i);
    ring_sizes_.push_back(degree);
  }

  void addFan(Index start, Index degree, Index apex) {
    auto& corners = mesh_.triangulation.corners;
    for (Index i = 1; i + 1 < degree; ++i) {
      corners.insert(corners.end(), {start + apex, start + (apex + i) % degree, start + (apex + i + 1) % degree});
    }
  }

  /// Lays the face's rings into the plane across which they are widest, the exterior ring (`degree` points) turning
  /// left. False when there is no such plane.
  bool project(Index degree) {
    flat_.assign(corners_.size(), {});
    tolerance_ = 0;
    if (!positions_.given()) return false;
    ring_.clear();
    for (Index corner : corners_) ring_.push_back(positions_[mesh_.wedgeOf(corner)]);
    const Point3 normal = normalOf(std::span(ring_).first(degree));
    int drop = 0;
    for (int axis = 1; axis < 3; ++axis) drop = std::abs(normal[axis]) > std::abs(normal[drop]) ? axis : drop;
    if (!std::isfinite(normal[0] + normal[1] + normal[2]) || normal[drop] == 0) return false;
    int x = (drop + 1) % 3, y = (drop + 2) % 3;
    if (normal[drop] < 0) std::swap(x, y);
    double size = 0, extent = 0;
    for (size_t i = 0; i < ring_.size(); ++i) {
      flat_[i] = {ring_[i][x] - ring_[0][x], ring_[i][y] - ring_[0][y]};
      size = std::max({size, std::abs(ring_[i][x]), std::abs(ring_[i][y])});
      extent = std::max({extent, std::abs(flat_[i].x), std::abs(flat_[i].y)});
    }
    tolerance_ = kRounding * size * extent;
    return std::isfinite(size);
  }

  /// The first corner whose fan covers the (only) ring, or kNone.
  Index findApex() const {
    const auto degree = static_cast<Index>(flat_.size());
    int64_t budget = kApexSteps + 8 * int64_t{degree};
    for (Index apex = 0; apex < degree && budget > 0; ++apex) {
      Index i = 1;
      while (i + 1 < degree && isCovered(apex, i)) ++i;
      if (i + 1 == degree) return apex;
      budget -= i;
    }
    return kNone;
  }

  /// Whether triangle i of the fan lies the right way up, or is flat within rounding.
  bool isCovered(Index apex, Index i) const {
    const auto degree = static_cast<Index>(flat_.size());
    const auto at = [&](Index k) { return flat_[(apex + k) % degree]; };
    return cross(at(0), at(i), at(i + 1)) >= -tolerance_;
  }

  // Doubled areas are off by about this much for float coordinates of unit size.
  static constexpr double kRounding = 4.0 / (1 << 24);
  static constexpr int64_t kApexSteps = 100'000;

  PolygonMesh& mesh_;
  Positions positions_;
  std::vector<Index> starts_;
  std::vector<std::pair<Index, Index>> holes_;  // owner, interior ring; sorted

  // The face at hand; kept to save allocations.
  std::vector<Index> corners_;
  std::vector<Index> ring_sizes_;
  std::vector<Point3> ring_;
  std::vector<Point2> flat_;
  std::vector<Index> ears_;
  double tolerance_ = 0;
};

}  // namespace

void triangulate(PolygonMesh& mesh) {
  if (mesh.triangulation.counts.empty()) FaceTriangulator(mesh).run();
}

}  // namespace tutte
