#pragma once
// Small assets for tests, and what two meshes must share to be the same.

#include <string>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/compress.h"
#include "gltf_ext/json_access.h"
#include "gltf_ext/polygon_mesh.h"
#include "gltf_ext/scene.h"
#include "tests/shapes/shapes.h"

namespace tutte {

/// An asset with no content but what glTF demands.
Asset emptyAsset();

/// Adds tightly packed data as a view of its own; returns the accessor.
uint64_t addRawAccessor(Asset& asset, Bytes bytes, ComponentType type, const std::string& kind, uint64_t count,
                        Json view = Json::object());

uint64_t addFloats(Asset& asset, const std::vector<float>& values, uint64_t components);
uint64_t addShorts(Asset& asset, const std::vector<Index>& values);

/// Positions of a shape as an accessor; invented ones where it has none.
uint64_t addPositions(Asset& asset, const shapes::Shape& shape);

/// Triangle indices of all faces of degree 3 and more. Fans that follow each other begin at different vertices, as
/// FB_ngon_encoding wants, wherever a face offers one.
std::vector<Index> fanIndices(const Polygons& polygons);

/// Adds a mesh with one primitive, and a node that shows it.
void addMesh(Asset& asset, Json primitive);

/// The shape as plain triangles; as fans with FB_ngon_encoding; as polygons with EXT_mesh_polygon.
Asset triangleAsset(const shapes::Shape& shape);
Asset fanAsset(const shapes::Shape& shape);
Asset polygonAsset(const shapes::Shape& shape);

/// A square with a square hole, with EXT_mesh_polygon, and one polygon beside it.
Asset holeAsset();

/// Everything is kept to the bit.
CompressOptions lossless();

/// What does not depend on order: per face its group and the bytes of its corners' attributes, starting at the
/// smallest; holes follow their owner. Sorted.
std::vector<std::string> facesOf(const PolygonMesh& mesh);

/// The same for triangles. Sorted.
std::vector<std::string> trianglesOf(const PolygonMesh& mesh);

/// Expects that two scenes have the same meshes (with unchanged attributes), nodes and materials.
void expectSameScene(const Asset& a, const Asset& b);

/// The error of a result that must not be one, for messages.
template <class T>
std::string why(const Outcome<T>& outcome) {
  return outcome ? "" : outcome.error().where + ": " + outcome.error().what;
}

}  // namespace tutte
