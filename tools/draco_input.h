#pragma once
// Our meshes as Draco's. For the files that include Draco.

#include <draco/compression/config/encoder_options.h>
#include <draco/mesh/mesh.h>

#include <array>
#include <memory>
#include <vector>

#include "gltf_ext/pack.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// The name of the attribute that marks added edges.
inline constexpr const char* kAddedEdges = "added_edges";

/// Triangles as indices into the mesh's corners, each with its added edges.
struct DracoTriangles {
  std::vector<std::array<Index, 3>> corners;
  std::vector<uint8_t> added_edge;  ///< per triangle: 1 when the edge opposite to its second corner was added
};

/// All polygons as fans, with their added edges.
DracoTriangles fanTriangles(const Polygons& polygons);

/// The mesh's own triangulation where it has one (then nothing is said about added edges), fans otherwise.
DracoTriangles givenTriangles(const PolygonMesh& mesh);

/// A point per triangle corner and the first `attributes` of the mesh, then everything equal merged. With
/// `mark_added_edges`, which needs fanTriangles(), one more attribute, kAddedEdges. Null when Draco cannot merge.
std::unique_ptr<draco::Mesh> dracoMesh(const PolygonMesh& mesh, const DracoTriangles& triangles, size_t attributes,
                                       bool mark_added_edges);

/// Draco's options for such a mesh; `level` as draco_encoder's -cl.
draco::EncoderOptions dracoOptions(const PolygonMesh& mesh, const PackOptions& options, int level);

}  // namespace tutte
