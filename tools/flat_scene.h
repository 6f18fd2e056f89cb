#pragma once
// A scene as one mesh, in the form that comparison needs.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "gltf_ext/pack.h"
#include "gltf_ext/scene.h"

namespace tutte {

/// An attribute of all wedges of all meshes.
struct FlatAttribute {
  std::string name;
  uint8_t components = 0;
  std::vector<float> values;       ///< per wedge; zeros where the mesh lacks the attribute
  std::vector<uint8_t> given;      ///< per mesh
  std::vector<double> tolerances;  ///< per mesh: how far a component may be from the original
  std::vector<uint32_t> bits;      ///< (exact) per wedge: the components as they are stored
  std::vector<uint32_t> types;     ///< (exact) per mesh: components, their type, and whether they are normalised
};

/// All meshes of a scene at their places. Vertices, wedges, faces and meshes are numbered through.
struct FlatScene {
  std::vector<std::array<double, 3>> positions;  ///< per vertex
  std::vector<double> tolerances;                ///< per vertex: how far a coordinate may be from the original
  std::vector<Index> vertex_wedges;              ///< per vertex: one of its wedges
  std::vector<Index> wedge_meshes;               ///< per wedge
  std::vector<Index> face_starts;                ///< per face its first corner; one more at the end
  std::vector<Index> corners;                    ///< per corner: its vertex
  std::vector<Index> wedges;                     ///< per corner
  std::vector<Index> owners;                     ///< per face: kNone, or the polygon that it is a hole in
  std::vector<Index> face_meshes;                ///< per face
  std::vector<Index> mesh_faces;                 ///< per mesh: its first face
  std::vector<FlatAttribute> attributes;         ///< without POSITION, unless it was asked for exactly

  size_t faceCount() const { return face_starts.size() - 1; }
  Index degree(size_t face) const { return face_starts[face + 1] - face_starts[face]; }
};

/// How coarse the other scene may be.
struct Tolerances {
  PackOptions bits;                      ///< half a step of such a quantisation; positions by the largest mesh's extent
  std::map<std::string, double> bounds;  ///< what is known of attributes by name, instead
  double position = -1;                  ///< at least 0: of positions, instead of both
  bool exact = false;                    ///< none at all; bits are given, too
};

/// Tolerances also have what rounding to float costs where anything is quantised, moved, or turned upside down.
FlatScene flatten(const Scene& scene, const Tolerances& tolerances);

}  // namespace tutte
