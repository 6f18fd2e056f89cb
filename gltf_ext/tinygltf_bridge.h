#pragma once
// Compressed files for programs that use tinygltf.

#include <cstdint>
#include <filesystem>
#include <span>

#include "gltf_ext/failure.h"

namespace tinygltf {
class Model;
}

namespace tutte {

/// Loads a .glb or .gltf file, compressed or not, into a model without TUTTE_mesh_compression: its buffer views hold
/// the decoded bytes. Images that tinygltf can decode (PNG, JPEG) are decoded; others keep their file's bytes, with
/// `as_is` set. Include <tiny_gltf.h> to use the model.
///
/// The file may hold anything: what breaks glTF's rules is refused before tinygltf sees it, and no file outside the
/// asset's folder is opened. Errors: kIo, kInvalid, kUnsupported.
Outcome<Done> loadModel(const std::filesystem::path& path, tinygltf::Model& model);

/// The same from memory; external buffers need `folder`.
Outcome<Done> loadModel(std::span<const uint8_t> bytes, tinygltf::Model& model,
                        const std::filesystem::path& folder = {});

}  // namespace tutte
