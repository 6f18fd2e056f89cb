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
      {"triangle", "03135ef7"},
      {"quad_torus_3x3", "141301b1d046"},
      {"triangle_torus", "13130372046cef20"},
      {"random_polygons_1", "10175eba4c3e8d204be5a049a24c65e0"},
      {"bow_tie_2", "d3135838f7e0"},
      {"book_3", "c3135ef6a0cb75"},
      {"orientation_conflict", "43135ec1b2e0"},
      {"moebius_5", "441341035c7d5ce2e4cc45"},
      {"klein_bottle", "4413051e32602a02d5405c192eb96edf01bd9ca4"},
      {"duplicate_faces", "43134b37155d80"},
      {"repeated_vertex", "c017565d2b380ed1c68959337ed1d3e9c69a17fb71f8d1a0b8"},
      {"small_faces", "44135b66dd336ae6a9b880"},
      {"isolated_vertices", "5413408d9e"},
      {"double_edges", "4017534da27df453"},
      {"self_glued_face", "40176b6c99e4da5ccd0380"},
      {"sponge_1", "14134dd1ad6dc779d1ec29eea77e5f06c79afb00859a1378"},
      {"perforated_grid", "041359734fb84066f9344067e52c6db7404f5490af436c"},
      {"polygon_1000", "00177f4505fa7a686027e0"}};
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
