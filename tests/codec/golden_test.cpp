// The bytes of some small meshes. They are the format: when this test fails, either the change was a mistake, or
// EXTENSION_SPEC.md, its version and tests/spec/decode.py change with it.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "codec/decode.h"
#include "codec/encode.h"
#include "tests/codec/checks.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

// What the search finds is not the format.
const EncodeOptions kUnsearched{.effort = 0};

const std::map<std::string, std::string>& goldenBytes() {
  static const std::map<std::string, std::string> bytes = {
      {"empty", "131380"},
      {"tetrahedron", "13135880"},
      {"cube", "14134080"},
      {"icosahedron", "131341"},
      {"dodecahedron", "15134020"},
      {"pyramid_5", "101701c040a0"},
      {"triangle", "0313005ef780"},
      {"quad_torus_3x3", "141301e2bcf4"},
      {"triangle_torus", "13130538c5c1399cc9"},
      {"random_polygons_1", "1017048a529dcc7ae93c23ff5112da4f10"},
      {"bow_tie_2", "d3135838f7e0"},
      {"book_3", "c313005ef6ed8818"},
      {"orientation_conflict", "431301305ec8ea"},
      {"moebius_5", "441302844040693cc1fca16194"},
      {"klein_bottle", "441302bd2f0198a2abaaf3ab54340fabf46b3838e4"},
      {"duplicate_faces", "431301404b557502"},
      {"repeated_vertex", "c017048363494059848907f279f9a587dff223a8c33eba103af5"},
      {"small_faces", "4413005b6add80af294be3"},
      {"isolated_vertices", "5413408215"},
      {"double_edges", "401702b8904d216e0740"},
      {"self_glued_face", "401701c35b689249485b0c80"},
      {"sponge_1", "14134ddaa802e4e6e0eb8e7a4676dc808e2cdaa288aa6fe2"},
      {"perforated_grid", "04130c02784d03beb393774aa0b2d05983fc446af9362c08"},
      {"polygon_1000", "001704fe6bfdc05af8"}};
  return bytes;
}

std::string hexOf(const std::vector<uint8_t>& bytes) {
  std::string hex;
  for (uint8_t byte : bytes) {
    hex += "0123456789abcdef"[byte >> 4];
    hex += "0123456789abcdef"[byte & 15];
  }
  return hex;
}

std::vector<uint8_t> bytesOf(const std::string& hex) {
  std::vector<uint8_t> bytes;
  for (size_t i = 0; i < hex.size(); i += 2)
    bytes.push_back(static_cast<uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

TEST(Golden, EncoderWritesThem) {
  size_t found = 0;
  for (const shapes::Named& named : shapes::allShapes()) {
    const auto golden = goldenBytes().find(named.name);
    if (golden == goldenBytes().end()) continue;
    const Result<Encoded> encoded = encode(named.shape.mesh, kUnsearched);
    ASSERT_TRUE(encoded) << named.name;
    EXPECT_EQ(hexOf(encoded->bytes), golden->second) << named.name;
    ++found;
  }
  EXPECT_EQ(found, goldenBytes().size());
}

TEST(Golden, DecoderReadsThem) {
  for (const shapes::Named& named : shapes::allShapes()) {
    const auto golden = goldenBytes().find(named.name);
    if (golden == goldenBytes().end()) continue;
    const Result<Connectivity> decoded = decode(bytesOf(golden->second));
    ASSERT_TRUE(decoded) << named.name << ": " << describe(decoded.error());
    const Result<Encoded> encoded = encode(named.shape.mesh, kUnsearched);
    ASSERT_TRUE(encoded) << named.name;
    EXPECT_TRUE(isSameMesh(*encoded, *decoded, named.shape.mesh)) << named.name;
  }
}

}  // namespace
}  // namespace tutte
