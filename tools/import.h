#pragma once
// Any supported file to a Scene.

#include <filesystem>
#include <string>
#include <vector>

#include "gltf_ext/scene.h"

namespace tutte {

enum class FileFormat {
  kGltf,  ///< .glb, .gltf
  kObj,   ///< .obj, .smf
  kPly,
  kOff,
  kOther,  ///< whatever Assimp knows
};

struct Imported {
  Scene scene;
  std::vector<std::string> warnings;  ///< what the scene does not carry over
};

/// Tells the format by the first bytes where they are clear, else by the extension of the name.
FileFormat formatOf(const std::filesystem::path& path, std::span<const uint8_t> bytes);

/// Reads any supported file but glTF. Polygons and the file's vertices are kept; nothing is triangulated or merged,
/// except that formats without shared vertices (STL, FBX, ...) are welded where positions are equal to the bit.
/// Errors name the file and the place in it.
Outcome<Imported> importScene(const std::filesystem::path& path);

// --- One reader per format; `bytes` may be anything. Failures give the place, but not the file's name.

/// Wavefront OBJ and its dialect SMF, by tinyobjloader. Material libraries are looked for in `folder` and below only.
Outcome<Imported> importObj(std::span<const uint8_t> bytes, const std::filesystem::path& folder);

/// PLY: text, little and big endian; faces and triangle strips.
Outcome<Imported> importPly(std::span<const uint8_t> bytes);

/// Geomview's OFF with normals, colours and texture coordinates; text and binary, of either byte order.
Outcome<Imported> importOff(std::span<const uint8_t> bytes);

/// Everything else, by Assimp.
Outcome<Imported> importAssimp(const std::filesystem::path& path);

}  // namespace tutte
