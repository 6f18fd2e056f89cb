#pragma once
// Plain glTF to compressed glTF.

#include <set>
#include <string>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/grid_plan.h"
#include "gltf_ext/pack.h"

namespace tutte {

/// How polygons are written beside the triangles.
enum class PolygonOutput {
  kAuto,  ///< as the input has them; FB_ngon_encoding for imported polygons if every one is a fan, else
          ///< EXT_mesh_polygon
  kFb,    ///< FB_ngon_encoding; primitives with a polygon that is no fan get EXT_mesh_polygon all the same, with a
          ///< warning
  kExt,   ///< EXT_mesh_polygon
  kBoth,  ///< both, where possible
};

struct CompressOptions {
  PackOptions pack;                   ///< its `grid` is set by `grid` below
  GridScope grid = GridScope::kFile;  ///< whose positions are quantised alike
  PolygonOutput polygons = PolygonOutput::kAuto;
  bool fallback = false;             ///< keep the decoded bytes too, so that loaders without the extension can read it
  std::set<std::string> attributes;  ///< keep only these (POSITION always); empty: keep all
};

/// What one payload holds and what it costs.
struct PayloadReport {
  std::string name;     ///< of the (first) mesh
  size_t vertices = 0;  ///< welded vertices
  size_t wedges = 0;    ///< glTF vertices
  size_t faces = 0;
  size_t corners = 0;
  size_t primitives = 0;  ///< face groups
  Packed packed;
};

/// What compress() did.
struct CompressReport {
  std::vector<Failure> warnings;  ///< what was left as it was and why, with JSON pointers
  std::vector<PayloadReport> payloads;
};

struct Compressed {
  Asset asset;
  CompressReport report;
};

/// Compresses every triangle primitive that can be compressed without breaking what refers to its vertices or faces.
/// Everything else (materials, animations, skins, images, extras, unknown extensions) stays as it is.
///
/// Primitives that share their attributes become one payload. Meshes compressed by TUTTE_mesh_compression,
/// EXT_meshopt_compression or KHR_draco_mesh_compression are decoded first.
/// The asset may be anything: what breaks the rules of glTF gives a Failure with a JSON pointer.
Outcome<Compressed> compress(const Asset& asset, const CompressOptions& options = {});

}  // namespace tutte
