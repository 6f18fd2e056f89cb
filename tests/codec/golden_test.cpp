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
      {"icosahedron", "131340c0"},
      {"dodecahedron", "15134020"},
      {"pyramid_5", "10176807a0"},
      {"triangle", "03135ef720"},
      {"quad_torus_3x3", "141301e2bcf4"},
      {"triangle_torus", "13130382908e8080"},
      {"random_polygons_1", "10175eba4c3e8a2c920a2b02cbd7caa0"},
      {"bow_tie_2", "d3135838f7e0"},
      {"book_3", "c3135ef6c0ac33"},
      {"orientation_conflict", "43135ec1b2e0"},
      {"moebius_5", "441341030c6b05580ed19d"},
      {"klein_bottle", "44130571084bef04e8f1d805414fac89e8732b2980"},
      {"duplicate_faces", "43134b33abc980"},
      {"repeated_vertex", "c017565d2ac6d2d3d2cc780497c6b871769c8d6a2f1986d8"},
      {"small_faces", "44135b65f3aa3666202240"},
      {"isolated_vertices", "5413408709"},
      {"double_edges", "4017534d8d4e44e7"},
      {"self_glued_face", "40176b6c834c7389678a"},
      {"sponge_1", "14134ddaa80d80789d03a9bfc168cda07e41518256865a4a80"},
      {"perforated_grid", "041359734f9ae6e1c1754d56663b858c1bf32692356828"},
      {"polygon_1000", "00177f4505fa7a6860293e"}};
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
