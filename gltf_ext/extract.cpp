#include "gltf_ext/extract.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace tutte {
namespace {

bool keepsAll(const PolygonMesh& mesh, std::span<const Index> groups) {
  if (groups.size() != mesh.group_count) return false;
  for (Index i = 0; i < groups.size(); ++i) {
    if (groups[i] != i) return false;
  }
  return true;
}

/// Numbers things in the order in which they are first asked for.
class Numbering {
 public:
  explicit Numbering(size_t count) : numbers_(count, kNone) {}

  Index of(Index old) {
    Index& number = numbers_[old];
    if (number == kNone) {
      number = static_cast<Index>(order_.size());
      order_.push_back(old);
    }
    return number;
  }
  const std::vector<Index>& order() const { return order_; }

 private:
  std::vector<Index> numbers_, order_;
};

class Extractor {
 public:
  Extractor(const PolygonMesh& mesh, std::span<const Index> groups)
      : mesh_(mesh),
        group_numbers_(mesh.group_count, kNone),
        vertices_(mesh.polygons.vertex_count),
        wedges_(mesh.wedge_count),
        faces_(mesh.polygons.face_degrees.size(), kNone),
        corners_(mesh.polygons.corners.size(), kNone) {
    for (Index i = 0; i < groups.size(); ++i) group_numbers_[groups[i]] = i;
    part_.group_count = static_cast<Index>(groups.size());
  }

  PolygonMesh run() {
    addFaces();
    addTriangles();
    part_.polygons.vertex_count = static_cast<Index>(vertices_.order().size());
    part_.wedge_count = static_cast<Index>(wedges_.order().size());
    for (const Attribute& attribute : mesh_.attributes) addAttribute(attribute);
    return std::move(part_);
  }

 private:
  Index groupOf(size_t face) const { return mesh_.groups.empty() ? 0 : mesh_.groups[face]; }

  void addFaces() {
    Index corner = 0;
    for (size_t face = 0; face < faces_.size(); ++face) {
      const Index degree = mesh_.polygons.face_degrees[face];
      if (group_numbers_[groupOf(face)] != kNone) addFace(static_cast<Index>(face), corner, degree);
      corner += degree;
    }
    // Owners may come after their holes, so that they are renumbered when all faces have their numbers.
    for (Index& owner : part_.ring_owners) owner = owner == kNone ? kNone : faces_[owner];
  }

  void addFace(Index face, Index first, Index degree) {
    faces_[face] = static_cast<Index>(part_.polygons.face_degrees.size());
    part_.polygons.face_degrees.push_back(degree);
    part_.groups.push_back(group_numbers_[groupOf(face)]);
    if (!mesh_.ring_owners.empty()) part_.ring_owners.push_back(mesh_.ring_owners[face]);
    for (Index corner = first; corner < first + degree; ++corner) {
      corners_[corner] = static_cast<Index>(part_.polygons.corners.size());
      part_.polygons.corners.push_back(vertices_.of(mesh_.polygons.corners[corner]));
      part_.wedges.push_back(wedges_.of(mesh_.wedgeOf(corner)));
    }
  }

  void addTriangles() {
    size_t next = 0;
    for (size_t face = 0; face < mesh_.triangulation.counts.size(); ++face) {
      const size_t count = size_t{mesh_.triangulation.counts[face]} * 3;
      if (faces_[face] != kNone) {
        part_.triangulation.counts.push_back(mesh_.triangulation.counts[face]);
        for (size_t i = next; i < next + count; ++i) {
          part_.triangulation.corners.push_back(corners_[mesh_.triangulation.corners[i]]);
        }
      }
      next += count;
    }
  }

  void addAttribute(const Attribute& attribute) {
    const size_t size = attribute.stride();
    Attribute part{attribute.name, attribute.components, attribute.type, attribute.normalized, {}};
    part.data.resize(wedges_.order().size() * size);
    for (size_t i = 0; i < wedges_.order().size(); ++i) {
      std::memcpy(part.data.data() + i * size, attribute.data.data() + wedges_.order()[i] * size, size);
    }
    part_.attributes.push_back(std::move(part));
  }

  const PolygonMesh& mesh_;
  PolygonMesh part_;
  std::vector<Index> group_numbers_;
  Numbering vertices_, wedges_;
  std::vector<Index> faces_, corners_;
};

}  // namespace

PolygonMesh extractGroups(const PolygonMesh& mesh, std::span<const Index> groups) {
  return keepsAll(mesh, groups) ? mesh : Extractor(mesh, groups).run();
}

}  // namespace tutte
