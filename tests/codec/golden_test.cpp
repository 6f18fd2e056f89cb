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
      {"empty", "130380"},
      {"tetrahedron", "13035880"},
      {"cube", "14034080"},
      {"icosahedron", "130341"},
      {"dodecahedron", "15034020"},
      {"pyramid_5", "10076807a0"},
      {"triangle", "03035ed360"},
      {"quad_torus_3x3", "140301b1d07c"},
      {"triangle_torus", "130b0372046cef20"},
      {"random_polygons_1", "10075eba2fb09839339bbe931b1336e0"},
      {"bow_tie_2", "d3035838f7e0"},
      {"book_3", "c3035ed31c902280"},
      {"orientation_conflict", "43035e9ed6b8"},
      {"moebius_5", "44034112a6ee9c7ac6b589"},
      {"klein_bottle", "4403052a50c370fc30ba294a527ab2fd9ab3cd57"},
      {"duplicate_faces", "43034b303a77"},
      {"repeated_vertex", "c007565d31a81c4c5ccafb9bb06cd38ee2ead5317a1737dd90"},
      {"small_faces", "44035b66dd336ae6a9b880"},
      {"isolated_vertices", "5403409620"},
      {"double_edges", "400753506b50eb05"},
      {"self_glued_face", "40076b6ca804e349b0c8c0"},
      {"sponge_1", "140b4ddaf7625cba5ff0799ea01bf1ccfa8a824b7d0e2718"},
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
