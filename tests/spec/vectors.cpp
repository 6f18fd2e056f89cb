// Writes test vectors for decoders: per shape the encoder's connectivity section and, as text, the mesh that it means.
//
//   vectors FOLDER

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "codec/decode.h"
#include "codec/encode.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

void describe(const Connectivity& mesh, std::ostream& out) {
  const Polygons polygons = polygonsOf(mesh);
  out << "vertices " << polygons.vertex_count << '\n';
  size_t corner = 0;
  for (Index degree : polygons.face_degrees) {
    out << "face";
    for (Index i = 0; i < degree; ++i) out << ' ' << polygons.corners[corner++];
    out << '\n';
  }
  out << "twins";
  for (Index twin : mesh.twins) out << ' ' << (twin == kNone ? -1 : static_cast<int64_t>(twin));
  out << '\n';
}

bool writeVector(const std::filesystem::path& folder, const shapes::Named& named, const char* suffix,
                 const EncodeOptions& options) {
  const Result<Encoded> encoded = encode(named.shape.mesh, options);
  if (!encoded) return false;
  std::ofstream section(folder / (named.name + suffix + ".section"), std::ios::binary);
  for (uint8_t byte : encoded->bytes) section.put(static_cast<char>(byte));
  std::ofstream mesh(folder / (named.name + suffix + ".mesh"));
  describe(encoded->connectivity, mesh);
  return section.good() && mesh.good();
}

/// One by the encoder's own choice, and one for each profile.
bool writeVectors(const std::filesystem::path& folder, const shapes::Named& named) {
  const auto write = [&](const char* suffix, std::optional<Profile> profile, int effort) {
    EncodeOptions options;
    options.profile = profile;
    options.effort = effort;
    return writeVector(folder, named, suffix, options);
  };
  return write("", std::nullopt, 1) && write(".paper", Profile::kPaper, 0) && write(".fast", Profile::kFast, 1) &&
         write(".default", Profile::kDefault, 0) && write(".small", Profile::kSmall, 2);
}

}  // namespace
}  // namespace tutte

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: vectors FOLDER\n", stderr);
    return 1;
  }
  std::filesystem::remove_all(argv[1]);
  std::filesystem::create_directories(argv[1]);
  for (const tutte::shapes::Named& named : tutte::shapes::allShapes()) {
    if (tutte::writeVectors(argv[1], named)) continue;
    std::fprintf(stderr, "%s: not written\n", named.name.c_str());
    return 1;
  }
  return 0;
}
