// Writes test vectors for decoders: per shape the encoder's connectivity section and, as text, the mesh that it means;
// for small shapes also streams of attribute values and of lossless floats and, as text, the numbers that they mean,
// and payloads with seams.
//
//   vectors FOLDER

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <utility>

#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/payload.h"
#include "codec/seams.h"
#include "codec/values.h"
#include "codec/wedges.h"
#include "tests/shapes/shapes.h"
#include "tests/spec/numbers_over.h"
#include "tests/spec/numeral_vectors.h"

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
  // What is written is what decodes, here too: so all platforms whose vectors are equal decode alike.
  const Result<Connectivity> decoded = decode(encoded->bytes);
  if (!decoded) return false;
  std::ofstream section(folder / (named.name + suffix + ".section"), std::ios::binary);
  for (uint8_t byte : encoded->bytes) section.put(static_cast<char>(byte));
  std::ofstream mesh(folder / (named.name + suffix + ".mesh"));
  describe(*decoded, mesh);
  return section.good() && mesh.good();
}

/// One stream per line: components, max, head, bytes, numbers, and for some the vertices' places.
class ValueVectors {
 public:
  ValueVectors(const Connectivity& mesh, std::ostream& out) : mesh_(mesh), out_(out) {
    for (Index corner = 0; corner < mesh.umbrellas.size(); ++corner) vertices_.push_back(mesh.vertexOf(corner));
  }

  void write() {
    places_ = numbersOver(mesh_, 3, 4095, 60);
    for (const ValueProfile profile : {ValueProfile::kFast, ValueProfile::kDefault, ValueProfile::kSmall}) {
      write({3, 4095, profile, ValueKind::kPoints}, 60);
      write({3, 4095, profile, ValueKind::kAngular}, 60);
      write({3, (1 << 20) - 1, profile, ValueKind::kAngular, false, true, true}, 200000);
      write({3, 4095, profile, ValueKind::kPoints, true}, 0);
      write({3, (1 << 20) - 1, profile, ValueKind::kPoints, false, true}, 0);
      write({2, (1 << 18) - 1, profile, ValueKind::kTexcoord}, 300);
      write({2, 510, profile, ValueKind::kDirection}, 20);
      write({2, 1022, profile, ValueKind::kLabel}, 1);
      write({1, (1 << 27) - 1, profile, ValueKind::kPlain}, 1 << 26);
      write({4, 255, profile, ValueKind::kPlain, true, true}, 2);
      write({3, 4095, profile, ValueKind::kPoints, false, false, true}, 3);
      write({3, (1 << 20) - 1, profile, ValueKind::kPoints, false, false, true}, 3000);
      write({2, 4095, profile, ValueKind::kTexcoord, false, true, true}, 3);
      write({1, 255, profile, ValueKind::kPlain, true, false, true}, 2);
      write({4, 255, profile, ValueKind::kPlain}, 2);
    }
  }

 private:
  void write(const ValueFormat& format, Index noise) {
    const ValueGraph graph(mesh_, vertices_, mesh_.vertex_count);
    const bool placed = format.kind == ValueKind::kTexcoord || format.kind == ValueKind::kDirection;
    const std::vector<int32_t> numbers = numbersOver(mesh_, format.components, format.max, noise);
    ByteWriter bytes;
    const ValueSites sites{graph, placed ? std::span<const int32_t>(places_) : std::span<const int32_t>()};
    if (!encodeValues(sites, format, numbers, bytes)) return;
    const Result<std::vector<int32_t>> decoded = decodeValues(sites, format, bytes.bytes());
    if (!decoded || *decoded != numbers) out_.setstate(std::ios::failbit);
    out_ << format.components << ' ' << format.max << ' '
         << static_cast<int>(format.profile) + 4 * static_cast<int>(format.kind) + 32 * format.ranked +
                64 * format.echoes + 128 * format.copies
         << ' ' << std::hex;
    for (const uint8_t byte : bytes.bytes()) out_ << byte / 16 << byte % 16;
    out_ << std::dec << ' ';
    list(numbers);
    if (placed) list(places_);
    out_ << '\n';
  }

  void list(std::span<const int32_t> numbers) {
    for (size_t i = 0; i < numbers.size(); ++i) out_ << (i == 0 ? "" : ",") << numbers[i];
    out_ << ' ';
  }

  const Connectivity& mesh_;
  std::ostream& out_;
  std::vector<Index> vertices_;
  std::vector<int32_t> places_;
};

bool writeValues(const std::filesystem::path& folder, const shapes::Named& named) {
  const Result<Encoded> encoded = encode(named.shape.mesh);
  if (!encoded) return false;
  const Index vertices = encoded->connectivity.vertex_count;
  if (vertices == 0 || vertices > 64) return true;
  std::ofstream values(folder / (named.name + ".values")), numerals(folder / (named.name + ".numerals"));
  ValueVectors(encoded->connectivity, values).write();
  NumeralVectors(encoded->connectivity, numerals).write();
  return values.good() && numerals.good();
}

/// Parts of wholes: corners of faces that happen to get the same one of `colours` colours stay together.
PartNumbering partsOf(const Connectivity& mesh, const std::vector<Index>& wholes, Index whole_count, Index colours,
                      uint64_t seed) {
  shapes::Random random(seed);
  std::map<std::pair<Index, Index>, Index> number;
  std::vector<Index> raw;
  for (const Index degree : mesh.face_degrees) {
    const Index colour = random.below(colours);
    for (Index i = 0; i < degree; ++i) {
      const auto part = std::pair(wholes[raw.size()], colour);
      raw.push_back(number.try_emplace(part, static_cast<Index>(number.size())).first->second);
    }
  }
  return *numberParts(wholes, whole_count, raw, static_cast<Index>(number.size()));
}

void list(const char* name, std::span<const Index> values, std::ostream& out) {
  out << name;
  for (const Index value : values) out << ' ' << value;
  out << '\n';
}

/// Vertices and wedges per coded corner, and per attribute but the first the corners whose edge is a seam.
void describe(const PayloadCounts& counts, const std::vector<Index>& vertices, const Seams& seams, std::ostream& out) {
  list("counts", std::vector<Index>{counts.vertices, counts.points(), counts.wedges}, out);
  list("vertices", vertices, out);
  list("wedges", seams.wedges, out);
  for (size_t slot = 1; slot < seams.attribute_seams.size(); ++slot) {
    std::vector<Index> corners;
    for (Index c = 0; c < seams.attribute_seams[slot].size(); ++c) {
      if (seams.attribute_seams[slot][c]) corners.push_back(c);
    }
    list("seam", corners, out);
  }
}

/// `vertex_colours` 1: not welded; `wedge_colours` 1: wedges are vertices.
bool writePayload(const std::filesystem::path& file, const Encoded& encoded, Index vertex_colours,
                  Index wedge_colours) {
  const Connectivity& mesh = encoded.connectivity;
  const PartNumbering vertices = partsOf(mesh, verticesOf(mesh), mesh.vertex_count, vertex_colours, 1);
  const auto vertex_count = static_cast<Index>(vertices.order.size());
  const PartNumbering wedges = partsOf(mesh, vertices.parts, vertex_count, wedge_colours, 2);
  if (wedges.order.size() == mesh.vertex_count) return true;  // no seams
  PayloadParts parts;
  parts.counts = {vertex_count,
                  static_cast<Index>(wedges.order.size()),
                  static_cast<Index>(mesh.face_degrees.size()),
                  static_cast<Index>(mesh.umbrellas.size()),
                  0,
                  1,
                  4,
                  vertex_count - mesh.vertex_count};
  const bool welded = parts.counts.welded > 0;
  shapes::Random random(3);
  std::vector<std::vector<uint8_t>> values(4, std::vector<uint8_t>(wedges.order.size()));
  for (size_t w = 0; w < wedges.order.size(); ++w) {
    values[2][w] = static_cast<uint8_t>(random.below(2));
    values[3][w] = static_cast<uint8_t>(w);
  }
  std::vector<ValueView> attributes;
  for (const auto& bytes : values) attributes.push_back({bytes, 1});
  const std::vector<Index> coded_vertices = welded ? vertices.parts : std::vector<Index>();
  parts.set(Section::kConnectivity, encoded.bytes);
  parts.set(Section::kSeams, encodeSeams(mesh, coded_vertices, wedges.parts, attributes));
  parts.set(Section::kAttributes, {});
  const Result<Seams> seams = decodeSeams(mesh, welded, parts.sections[1], parts.counts.attributes);
  if (!seams || seams->wedges != wedges.parts) return false;
  std::ofstream payload(std::filesystem::path(file) += ".payload", std::ios::binary);
  for (const uint8_t byte : writePayload(parts)) payload.put(static_cast<char>(byte));
  std::ofstream text(std::filesystem::path(file) += ".seams");
  describe(parts.counts, vertices.parts, *seams, text);
  return payload.good() && text.good();
}

bool writePayloads(const std::filesystem::path& folder, const shapes::Named& named) {
  const Result<Encoded> encoded = encode(named.shape.mesh);
  if (!encoded) return false;
  if (encoded->connectivity.umbrellas.size() > 500) return true;
  return writePayload(folder / (named.name + ".wedges"), *encoded, 1, 3) &&
         writePayload(folder / (named.name + ".welded"), *encoded, 9, 1) &&
         writePayload(folder / (named.name + ".both"), *encoded, 2, 2);
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
         write(".default", Profile::kDefault, 0) && write(".small", Profile::kSmall, 2) && writeValues(folder, named) &&
         writePayloads(folder, named);
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
  std::vector<tutte::shapes::Named> all = tutte::shapes::allShapes();
  // Long enough for valences that are as good as certain, and for their exceptions.
  all.push_back({"merged_torus", tutte::shapes::mergeFaces(tutte::shapes::quadTorus(50, 60), 9, 1)});
  all.push_back({"long_plate", tutte::shapes::plate(60, 50)});
  for (const tutte::shapes::Named& named : all) {
    if (tutte::writeVectors(argv[1], named)) continue;
    std::fprintf(stderr, "%s: not written\n", named.name.c_str());
    return 1;
  }
  return 0;
}
