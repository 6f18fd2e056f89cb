#pragma once
// The faces of a glTF primitive: triangles in all of their modes, and polygons in both notations.

#include <span>
#include <string>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/json_access.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// Faces over glTF vertices (wedges), as in PolygonMesh.
struct PrimitiveFaces {
  std::vector<Index> degrees;
  std::vector<Index> corners;      ///< wedges
  std::vector<Index> ring_owners;  ///< empty when there are no holes
  Triangulation triangulation;     ///< empty when all faces are triangles
};

/// glTF's primitive modes that have triangles.
inline constexpr uint64_t kModeTriangles = 4;
inline constexpr uint64_t kModeStrip = 5;
inline constexpr uint64_t kModeFan = 6;

/// Three indices per triangle. Strips alternate their orientation as glTF says; triangles that repeat an index, which
/// strips and fans have only to join their parts, are left out of these. An incomplete last triangle is ignored, as
/// loaders do.
std::vector<Index> triangleList(uint64_t mode, std::span<const Index> indices);

/// Every triangle a face.
PrimitiveFaces facesOfTriangles(std::span<const Index> triangles);

/// FB_ngon_encoding: consecutive triangles that start at the same vertex, each going on where the last one ended, are
/// one polygon.
PrimitiveFaces facesOfFans(std::span<const Index> triangles);

/// The arrays of EXT_mesh_polygon. kNone stands for the restart value.
struct PolygonArrays {
  std::vector<Index> index_offsets;
  std::vector<Index> loops;
  std::vector<Index> loop_offsets;
};

/// EXT_mesh_polygon: the polygons, their holes and their triangles. Any values may be passed. Errors (at `where`):
/// kInvalid when offsets do not rise or do not begin at 0, a polygon has no ring, or a triangle uses a vertex that its
/// polygon's rings do not have.
Outcome<PrimitiveFaces> facesOfPolygons(std::span<const Index> triangles, const PolygonArrays& arrays,
                                        const std::string& where);

/// How a primitive notes its polygons.
enum class PolygonNotation { kTriangles, kFb, kExt, kBoth };

/// `fb_everywhere`: the file uses FB_ngon_encoding without marking any primitive, as some exporters do.
PolygonNotation notationOf(const Json& primitive, bool fb_everywhere);

/// True when FB_ngon_encoding is in extensionsUsed and on no primitive.
bool usesUnmarkedFans(const Json& json);

/// Reads the faces of a primitive that has triangles, from uncompressed accessors. Every corner is below `wedge_count`.
/// Where both notations are present, EXT_mesh_polygon counts.
Outcome<PrimitiveFaces> readFaces(const Asset& asset, const Json& primitive, uint64_t wedge_count, bool fb_everywhere,
                                  const std::string& where);

}  // namespace tutte
