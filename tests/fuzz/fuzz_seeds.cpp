// Writes an input per shape and fuzz target: fuzz_seeds DIRECTORY.

#include <filesystem>
#include <fstream>

#include "codec/encode.h"
#include "tests/shapes/shapes.h"

using namespace tutte;

namespace {

using Bytes = std::vector<uint8_t>;

void write(const std::filesystem::path& path, const Bytes& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Bytes soupOf(const Polygons& mesh, uint8_t choice) {
  Bytes bytes = {choice, static_cast<uint8_t>(mesh.vertex_count)};
  size_t corner = 0;
  for (const Index degree : mesh.face_degrees) {
    bytes.push_back(static_cast<uint8_t>(degree));
    for (Index i = 0; i < degree; ++i) bytes.push_back(static_cast<uint8_t>(mesh.corners[corner++]));
  }
  return bytes;
}

// All sections present, the others filled with bytes that are as good as any.
Bytes forgeryOf(const Bytes& section) {
  Bytes bytes = {1, 0x1E, 0, 0, 1, 2};
  bytes.push_back(static_cast<uint8_t>(section.size()));
  bytes.push_back(static_cast<uint8_t>(section.size() >> 8));
  bytes.insert(bytes.end(), section.begin(), section.end());
  for (int s = 0; s < 4; ++s) bytes.insert(bytes.end(), {3, 0, 0x12, 0x34, 0x56});
  return bytes;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 1;
  const std::filesystem::path directory = arguments[1];
  uint8_t choice = 0;
  for (const shapes::Named& named : shapes::allShapes()) {
    const Polygons& mesh = named.shape.mesh;
    const Result<Encoded> encoded = encode(mesh, {static_cast<Profile>(++choice % 4), choice / 4 % 2});
    if (!encoded || encoded->bytes.size() > 500) continue;
    write(directory / "section" / named.name, encoded->bytes);
    write(directory / "payload" / named.name, forgeryOf(encoded->bytes));
    const bool small = mesh.vertex_count < 256 && mesh.corners.size() < 500;
    if (small) write(directory / "mesh" / named.name, soupOf(mesh, choice));
  }
  return 0;
}
