#pragma once
// The mesh that travels through every tool: what an importer makes, what a payload stores, what an exporter writes.

#include <cstdint>
#include <string>
#include <vector>

#include "codec/mesh.h"
#include "codec/triangulation.h"

namespace tutte {

/// glTF's accessor component types, by their glTF numbers.
enum class ComponentType : uint16_t {
  kInt8 = 5120,
  kUint8 = 5121,
  kInt16 = 5122,
  kUint16 = 5123,
  kUint32 = 5125,
  kFloat = 5126,
};

/// Bytes of one component.
constexpr uint32_t sizeOf(ComponentType type) {
  switch (type) {
    case ComponentType::kInt8:
    case ComponentType::kUint8: return 1;
    case ComponentType::kInt16:
    case ComponentType::kUint16: return 2;
    default: return 4;
  }
}

/// One attribute of all wedges, tightly packed: `components` values of type `type` per wedge.
struct Attribute {
  std::string name;        ///< POSITION, NORMAL, TEXCOORD_0, _MINE ...; a morph target's are "POSITION@0"
  uint8_t components = 3;  ///< 1 to 4 (MAT types are not attributes)
  ComponentType type = ComponentType::kFloat;
  bool normalized = false;    ///< integers that stand for 0..1 or -1..1
  std::vector<uint8_t> data;  ///< wedge_count * components * sizeOf(type) bytes, little-endian

  uint32_t stride() const { return components * sizeOf(type); }
};

/// One mesh: polygons over welded vertices, and attributes over wedges.
///
/// A *vertex* is an end of edges; a *wedge* is what glTF calls a vertex: one set of attribute values. A vertex on a
/// seam of texture coordinates or normals has several wedges. All wedges of a vertex share its POSITION.
struct PolygonMesh {
  Polygons polygons;
  std::vector<Index> wedges;  ///< per corner: its wedge; empty: the corner's vertex is its wedge
  Index wedge_count = 0;      ///< unused wedges are isolated vertices: vertex and wedge both come last, in order
  std::vector<Index> groups;  ///< per face: its group (the glTF primitive); empty: all 0
  Index group_count = 1;
  std::vector<Index> ring_owners;  ///< per face: kNone for a polygon; for an interior ring (a hole in a polygon, which
                                   ///< EXT_mesh_polygon allows) the face that is its exterior ring; empty: all kNone
  Triangulation triangulation;     ///< where unpack() leaves it empty, all faces are triangles
  std::vector<Attribute> attributes;

  Index wedgeOf(Index corner) const { return wedges.empty() ? polygons.corners[corner] : wedges[corner]; }
};

}  // namespace tutte
