#include "gltf_ext/draco_mesh.h"

#include <draco/compression/mesh/traverser/depth_first_traverser.h>

#include <algorithm>

#include "gltf_ext/polygon_order.h"
#include "gltf_ext/site_layouts.h"

namespace tutte {
namespace {

using draco::CornerIndex;
using draco::FaceIndex;
using draco::VertexIndex;

constexpr size_t kMaxCorners = 0x7FFFFFFF;  // Draco counts corners in int

bool consistent(const AttributeTopology& topology) {
  const std::vector<Index>& twins = topology.connectivity.twins;
  if (!isConsistent(topology)) return false;
  for (size_t c = 0; c < twins.size(); ++c) {
    if (twins[c] != kNone && twins[twins[c]] != c) return false;
  }
  return true;
}

/// Wedges that no face of degree 3 or more uses, in order.
std::vector<Index> looseWedges(const AttributeTopology& topology) {
  std::vector<bool> used(topology.wedge_count, false);
  size_t corner = 0;
  for (const Index degree : topology.connectivity.face_degrees) {
    for (Index i = 0; i < degree; ++i, ++corner) {
      if (degree >= 3) used[topology.wedges[corner]] = true;
    }
  }
  std::vector<Index> loose;
  for (Index w = 0; w < topology.wedge_count; ++w) {
    if (!used[w]) loose.push_back(w);
  }
  return loose;
}

size_t fanTriangles(const Connectivity& mesh) {
  size_t count = 0;
  for (const Index degree : mesh.face_degrees) count += degree >= 3 ? degree - 2 : 0;
  return count;
}

void glue(draco::CornerTable& table, Index a, Index b) {
  table.SetOppositeCorner(CornerIndex(a), CornerIndex(b));
  table.SetOppositeCorner(CornerIndex(b), CornerIndex(a));
}

/// Fills one table from the topology, face by face.
class TableBuilder {
 public:
  TableBuilder(const AttributeTopology& topology, TriangleTable& out)
      : topology_(topology), mesh_(topology.connectivity), out_(out) {}

  bool build() {
    const std::vector<Index> loose = looseWedges(topology_);
    const size_t loose_triangles = (loose.size() + 2) / 3;
    const size_t triangles = fanTriangles(mesh_) + loose_triangles;
    const size_t vertices = mesh_.umbrella_count + 3 * loose_triangles;
    if (3 * triangles > kMaxCorners || vertices > kMaxCorners) return false;
    if (!out_.table.Reset(static_cast<int>(triangles), static_cast<int>(vertices))) return false;
    out_.table.SetNumVertices(static_cast<int>(vertices));
    out_.wedges.reserve(3 * triangles);
    out_.edge_corners.assign(mesh_.umbrellas.size(), kNone);
    addFans();
    addLoose(loose);
    glueTwins();
    setLeftMostCorners();
    return everyVertexIsOneFan();
  }

 private:
  Index nextCorner() const { return static_cast<Index>(out_.wedges.size()); }

  void addCorner(Index vertex, Index wedge) {
    out_.table.MapCornerToVertex(CornerIndex(nextCorner()), VertexIndex(vertex));
    out_.wedges.push_back(wedge);
  }

  void addFans() {
    const PolygonOrder order = orderPolygons(mesh_);
    std::vector<Index> starts;  // per face: the first corner of its fan
    Index first = 0, face = 0;
    for (const Index degree : mesh_.face_degrees) {
      starts.push_back(nextCorner());
      if (degree >= 3) addFan(first, degree, order.anchors[face]);
      first += degree;
      ++face;
    }
    out_.grown.reserve(mesh_.umbrellas.size());
    for (const Index grown : order.faces) listGrown(starts[grown], mesh_.face_degrees[grown]);
  }

  void addFan(Index first, Index degree, Index anchor) {
    const Index start = nextCorner();
    const auto coded = [&](Index i) { return first + (i < degree - anchor ? anchor + i : anchor + i - degree); };
    for (Index i = 1; i + 1 < degree; ++i) {
      for (const Index corner : {coded(0), coded(i), coded(i + 1)}) {
        addCorner(mesh_.umbrellas[corner], topology_.wedges[corner]);
      }
      out_.edge_corners[coded(i)] = start + 3 * (i - 1);
      if (i > 1) glue(out_.table, start + 3 * (i - 2) + 1, start + 3 * (i - 1) + 2);
    }
    out_.edge_corners[coded(0)] = start + 2;
    out_.edge_corners[coded(degree - 1)] = start + 3 * (degree - 3) + 1;
  }

  void listGrown(Index start, Index degree) {
    out_.grown.push_back(start);
    out_.grown.push_back(start + 1);
    for (Index i = 2; i < degree; ++i) out_.grown.push_back(start + 3 * (i - 2) + 2);
  }

  void addLoose(const std::vector<Index>& loose) {
    Index vertex = mesh_.umbrella_count;
    for (size_t i = 0; i < (loose.size() + 2) / 3 * 3; ++i) {
      out_.grown.push_back(nextCorner());
      addCorner(vertex++, loose[std::min(i, loose.size() - 1)]);
    }
  }

  void glueTwins() {
    for (size_t c = 0; c < mesh_.twins.size(); ++c) {
      const Index twin = mesh_.twins[c];
      if (twin == kNone || twin < c) continue;
      const Index a = out_.edge_corners[c], b = out_.edge_corners[twin];
      if (a != kNone && b != kNone) glue(out_.table, a, b);
    }
  }

  void setLeftMostCorners() {
    draco::CornerTable& table = out_.table;
    for (CornerIndex c(0); c < nextCorner(); ++c) {
      const VertexIndex vertex = table.Vertex(c);
      const bool open = table.Opposite(table.Next(c)) == draco::kInvalidCornerIndex;
      if (open || table.LeftMostCorner(vertex) == draco::kInvalidCornerIndex) table.SetLeftMostCorner(vertex, c);
    }
  }

  // Draco trusts this: a corner outside its vertex's fan would have no value.
  bool everyVertexIsOneFan() const {
    const draco::CornerTable& table = out_.table;
    size_t reached = 0;
    for (VertexIndex v(0); v < static_cast<uint32_t>(table.num_vertices()); ++v) {
      const CornerIndex first = table.LeftMostCorner(v);
      for (CornerIndex c = first; c != draco::kInvalidCornerIndex;) {
        if (table.Vertex(c) != v) return false;
        ++reached;
        c = table.SwingRight(c);
        if (c == first) break;
      }
    }
    return reached == out_.cornerCount();
  }

  const AttributeTopology& topology_;
  const Connectivity& mesh_;
  TriangleTable& out_;
};

/// Notes where Draco's traversal meets a vertex first.
struct Collector {
  std::vector<CornerIndex>* corners = nullptr;
  void OnNewFaceVisited(FaceIndex) {}
  void OnNewVertexVisited(VertexIndex, CornerIndex corner) { corners->push_back(corner); }
};

template <class Table>
std::vector<CornerIndex> depthFirst(const Table& table) {
  std::vector<CornerIndex> corners;
  draco::DepthFirstTraverser<Table, Collector> traverser;
  traverser.Init(&table, Collector{&corners});
  traverser.OnTraversalStart();
  for (int face = 0; face < table.num_faces(); ++face) traverser.TraverseFromCorner(CornerIndex(3 * face));
  traverser.OnTraversalEnd();
  return corners;
}

template <class Table>
std::vector<CornerIndex> asGrown(const Table& table, const TriangleTable& triangles) {
  std::vector<bool> met(table.num_vertices(), false);
  std::vector<CornerIndex> corners;
  for (const Index corner : triangles.grown) {
    const uint32_t vertex = table.Vertex(CornerIndex(corner)).value();
    if (!met[vertex]) corners.push_back(CornerIndex(corner));
    met[vertex] = true;
  }
  return corners;
}

/// Numbers the values in the given order.
template <class Table>
void number(const Table& table, const TriangleTable& triangles, ValueOrder order, ValueLayout& out) {
  std::vector<CornerIndex> corners = order == ValueOrder::kGrown ? asGrown(table, triangles) : depthFirst(table);
  out.data.vertex_to_encoded_attribute_value_index_map.assign(table.num_vertices(), -1);
  out.points.reserve(corners.size());
  for (const CornerIndex& corner : corners) {
    out.data.vertex_to_encoded_attribute_value_index_map[table.Vertex(corner).value()] = out.data.num_values++;
    out.points.push_back(draco::PointIndex(triangles.wedges[corner.value()]));
  }
  out.data.encoded_attribute_value_index_to_corner_map = std::move(corners);
}

std::unique_ptr<draco::MeshAttributeCornerTable> cutAlong(std::span<const uint8_t> seams,
                                                          const TriangleTable& triangles) {
  auto table = std::make_unique<draco::MeshAttributeCornerTable>();
  if (seams.size() != triangles.edge_corners.size() || !table->InitEmpty(&triangles.table)) return nullptr;
  for (size_t c = 0; c < seams.size(); ++c) {
    if (seams[c] != 0 && triangles.edge_corners[c] != kNone) {
      table->AddSeamEdge(CornerIndex(triangles.edge_corners[c]));
    }
  }
  return table->RecomputeVertices(nullptr, nullptr) ? std::move(table) : nullptr;
}

bool anySeam(std::span<const uint8_t> seams) {
  return std::any_of(seams.begin(), seams.end(), [](uint8_t seam) { return seam != 0; });
}

}  // namespace

std::unique_ptr<TriangleTable> buildTriangleTable(const AttributeTopology& topology) {
  if (!consistent(topology)) return nullptr;
  auto triangles = std::make_unique<TriangleTable>();
  return TableBuilder(topology, *triangles).build() ? std::move(triangles) : nullptr;
}

const ValueLayout* ValueLayouts::get(std::span<const uint8_t> seams, ValueOrder order) {
  if (!anySeam(seams)) seams = {};
  for (const Entry& entry : entries_) {
    if (entry.order == order && std::ranges::equal(entry.seams, seams)) return entry.layout.get();
  }
  entries_.push_back({seams, order, make(seams, order)});
  return entries_.back().layout.get();
}

std::unique_ptr<ValueLayout> ValueLayouts::make(std::span<const uint8_t> seams, ValueOrder order) const {
  auto layout = std::make_unique<ValueLayout>();
  layout->data.num_values = 0;
  if (seams.empty()) {
    number(triangles_.table, triangles_, order, *layout);
    return layout;
  }
  layout->seams = cutAlong(seams, triangles_);
  if (!layout->seams) return nullptr;
  number(*layout->seams, triangles_, order, *layout);
  return layout;
}

int ValueLayouts::valueAt(const ValueLayout& layout, Index corner) const {
  const CornerIndex c(corner);
  const VertexIndex vertex = layout.seams ? layout.seams->Vertex(c) : triangles_.table.Vertex(c);
  const auto& values = layout.data.vertex_to_encoded_attribute_value_index_map;
  return vertex.value() < values.size() ? values[vertex.value()] : -1;
}

}  // namespace tutte
