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

const std::map<std::string, std::string>& goldenBytes() {
  static const std::map<std::string, std::string> bytes = {
      {"empty", "131380"},
      {"tetrahedron", "13135880"},
      {"cube", "14134060"},
      {"icosahedron", "131340c0"},
      {"dodecahedron", "15134018"},
      {"pyramid_5", "301701c040a0"},
      {"triangle", "025348c0"},
      {"quad_torus_3x3", "1413018548e4"},
      {"triangle_torus", "331304b8e90688e970"},
      {"random_polygons_1", "1017044f796dd0754ddfd3c7a779b218"},
      {"bow_tie_2", "d31358360ae4"},
      {"book_3", "c253484b13019f"},
      {"orientation_conflict", "405701805ad7c0"},
      {"moebius_5", "4413010d4538d7d94775da"},
      {"klein_bottle", "441302bd2f0198a2abaaf3ab54340fabcd01c270cc0d"},
      {"duplicate_faces", "431301c0584da77c"},
      {"repeated_vertex", "e0170483666e4059848907e01cfa1eb2bfd46b113c48d7cf0ace26"},
      {"small_faces", "4253236d195d218c0cc4"},
      {"isolated_vertices", "5413406de7"},
      {"double_edges", "401702c3802daef65020"},
      {"self_glued_face", "401701c35b689249468d76"},
      {"sponge_1", "14134ddaa7f7da296e101ef0f39f3cb22a93a8b0759305dc"},
      {"perforated_grid", "24130b027b4f92ae5edbbee33a105983fc446af935a6"},
      {"polygon_1000", "001705fffe6645a05af8"}};
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
    const Result<Encoded> encoded = encode(named.shape.mesh);
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
    const Result<Encoded> encoded = encode(named.shape.mesh);
    ASSERT_TRUE(encoded) << named.name;
    EXPECT_TRUE(isSameMesh(*encoded, *decoded, named.shape.mesh)) << named.name;
  }
}

}  // namespace
}  // namespace tutte
