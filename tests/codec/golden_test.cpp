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
      {"empty", "1380"},
      {"tetrahedron", "1319b0"},
      {"cube", "1419a4"},
      {"icosahedron", "132aaf"},
      {"dodecahedron", "1519c0"},
      {"pyramid_5", "100251cc19d0"},
      {"triangle", "03001140"},
      {"quad_torus_3x3", "1421f8f580"},
      {"triangle_torus", "1333297e6839"},
      {"random_polygons_1", "10084334943c4bff896039dd687bc328a300f0c58820"},
      {"bow_tie_2", "5302d8a8199c"},
      {"book_3", "430004d56f0080111180"},
      {"orientation_conflict", "4301013e5c1198"},
      {"moebius_5", "44020483505ad850c0199972819c"},
      {"klein_bottle", "44020ad39d6c4362c1935e9030113021f6e7a67e76c31f98"},
      {"duplicate_faces", "430102b0da2019943d40"},
      {"repeated_vertex", "40050b421b2a70c0de61415eccb6d885fe28bd11c9c5c5b36dd956"},
      {"small_faces", "44000790c96a1918ee601130"},
      {"isolated_vertices", "5402e0e819a4"},
      {"double_edges", "400302451480dad01a0adf60"},
      {"self_glued_face", "4002045140d52982e0110710"},
      {"sponge_1", "141a506ceaad06d139acdcf02d560aef42efc2f66781821566628bcc902690"},
      {"perforated_grid", "0410027feadebbf1f16701eafa0eaa36008011c9c825bba8e66a717d27c764bdd8cf999098"},
      {"polygon_1000", "000310044c111150"}};
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
