#pragma once
// Whole files in and out. Output never leaves a partial file behind.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "gltf_ext/failure.h"

namespace tutte {

/// A regular file's bytes. Errors: kIo, with its name.
Outcome<std::vector<uint8_t>> readFile(const std::filesystem::path& path);

/// One file to be written.
struct NewFile {
  std::filesystem::path path;
  std::vector<uint8_t> bytes;
};

/// Writes all files under temporary names in their own folders, flushes them to disk and then renames them, the last
/// one last: so name the file that refers to the others last. Errors: kIo; no partial file remains.
Outcome<Done> writeFiles(const std::vector<NewFile>& files);

/// One file, in the same way.
Outcome<Done> writeFile(const std::filesystem::path& path, const std::vector<uint8_t>& bytes);

}  // namespace tutte
