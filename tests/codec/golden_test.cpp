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
      {"quad_torus_3x3", "1413019580bc"},
      {"triangle_torus", "33130479ab59e215"},
      {"random_polygons_1", "101704963a709473520342ae186f7a2c"},
      {"bow_tie_2", "d31358367168"},
      {"book_3", "c253484b13019f"},
      {"orientation_conflict", "405701805ad7c0"},
      {"moebius_5", "4413010d4538d75535b608"},
      {"klein_bottle", "441303b3e38001932e165ac0f1f8d0f8eaf3215257b223a4"},
      {"duplicate_faces", "431301c0584e6448"},
      {"repeated_vertex", "e057045fa637803ff2b21ad9ba05ff9602431446e96f406b86"},
      {"small_faces", "4253236d195d218c0cc4"},
      {"isolated_vertices", "54134070c280"},
      {"double_edges", "405701654f9b225fe0"},
      {"self_glued_face", "4253686efdf01d6f80"},
      {"sponge_1", "141323a663315fda6e48ba50fd4da0be75f3990bc8fcf970"},
      {"perforated_grid", "24130a027ca56b8d6334db4cf2250a48e5e3d0124f"},
      {"polygon_1000", "001705fffe63f7805adb"}};
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
