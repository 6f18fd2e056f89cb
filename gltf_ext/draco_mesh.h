#pragma once
// The triangles that Draco's predictors walk over, and the orders in which they meet the values. Private to the Draco
// files: the only ones that may include Draco.

#include <draco/compression/attributes/mesh_attribute_indices_encoding_data.h>
#include <draco/mesh/corner_table.h>
#include <draco/mesh/mesh_attribute_corner_table.h>

#include <memory>
#include <span>
#include <vector>

#include "gltf_ext/attributes.h"

namespace tutte {

/// The polygons of a topology as triangles: fans from their anchors (polygon_order.h). Vertices of the table are the
/// umbrellas. Wedges that no triangle uses (isolated vertices, faces of degree below 3) follow three by three as
/// triangles of their own with three new vertices; the last of them repeats its last wedge.
struct TriangleTable {
  draco::CornerTable table;
  std::vector<Index> wedges;        ///< per corner of the table: its wedge
  std::vector<Index> edge_corners;  ///< per coded corner: the table's corner opposite to the edge that leaves it;
                                    ///< kNone in faces of degree below 3
  std::vector<Index> grown;         ///< one corner of the table per coded corner, face by face as they were grown, from
                                    ///< the anchor on, in the triangle of which it is the last; then all loose ones

  size_t cornerCount() const { return wedges.size(); }
};

/// Null when the topology contradicts itself (twins that are not mutual, umbrellas that are not one fan, indices out
/// of range) or has too many corners for Draco. O(corners).
std::unique_ptr<TriangleTable> buildTriangleTable(const AttributeTopology& topology);

/// How values follow each other.
enum class ValueOrder {
  kGrown,       ///< as their corners are first met in TriangleTable::grown: most parallelograms are known
  kDepthFirst,  ///< by Draco's depth-first traversal of the triangles, begun at each in turn
};

/// One attribute's value per vertex and side of its seams, and the order in which these values are coded.
struct ValueLayout {
  std::unique_ptr<draco::MeshAttributeCornerTable> seams;  ///< null without seams
  draco::MeshAttributeIndicesEncodingData data;            ///< value -> corner, vertex -> value
  std::vector<draco::PointIndex> points;                   ///< value -> wedge

  size_t valueCount() const { return points.size(); }
};

/// The layouts of one mesh, made when they are first asked for; attributes with equal seams share one.
class ValueLayouts {
 public:
  explicit ValueLayouts(const TriangleTable& triangles) : triangles_(triangles) {}

  /// Null when the seams do not fit the table. `seams` must outlive this object.
  const ValueLayout* get(std::span<const uint8_t> seams, ValueOrder order);

  /// The number of the value that a corner of the table has; negative when it has none.
  int valueAt(const ValueLayout& layout, Index corner) const;

 private:
  struct Entry {
    std::span<const uint8_t> seams;
    ValueOrder order;
    std::unique_ptr<ValueLayout> layout;
  };

  std::unique_ptr<ValueLayout> make(std::span<const uint8_t> seams, ValueOrder order) const;

  const TriangleTable& triangles_;
  std::vector<Entry> entries_;
};

}  // namespace tutte
