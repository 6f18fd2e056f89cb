// Weights whose sum is the same everywhere: one component is not coded.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/attribute_name.h"
#include "tests/gltf/coded_mesh.h"

namespace tutte {
namespace {

const shapes::Shape& shape() {
  static const shapes::Shape torus = shapes::triangleTorus(24, 24);
  return torus;
}

/// Four weights with the given sum, smooth and uneven.
std::array<uint32_t, 4> weightsOf(Index wedge, uint32_t sum) {
  const uint32_t second = (wedge * 7 + wedge / 24 * 3) % (sum / 3), third = second / 3, fourth = wedge % 5;
  return {sum - second - third - fourth, second, third, fourth};
}

template <class T>
Attribute wholeWeights(ComponentType type, Index count, uint32_t sum, const char* name = "WEIGHTS_0") {
  Attribute attribute = makeAttribute<T>(name, type, 4, count, [&](Index w, int c) { return weightsOf(w, sum)[c]; });
  attribute.normalized = true;
  return attribute;
}

Attribute byteWeights(Index count) { return wholeWeights<uint8_t>(ComponentType::kUint8, count, 255); }

Attribute floatWeights(Index count) {
  return makeFloats("WEIGHTS_0", 4, count, [](Index w, int c) { return weightsOf(w, 255)[c] / 255.0; });
}

/// The bytes of all attributes, after checking that both coders give them back.
size_t exactBytes(CodedMesh& mesh, const Attribute& weights) {
  const std::vector<Attribute> attributes{positionsOf(mesh, shape()), weights};
  const AttributeTopology topology = mesh.topology(attributes);
  std::array<size_t, 2> bytes{};
  for (const AttributeCoder coder : {AttributeCoder::kDraco, AttributeCoder::kTutte}) {
    PackOptions options;
    options.attribute_coder = coder;
    const auto coded = encodeAttributes(topology, attributes, options);
    if (!coded) return ADD_FAILURE() << coded.error().what, 0;
    const auto decoded = decodeAttributes(topology, *coded);
    if (!decoded) return ADD_FAILURE() << decoded.error().what, 0;
    EXPECT_EQ((*decoded)[1].data, weights.data);
    bytes[coder == AttributeCoder::kTutte] = coded->size();
  }
  return bytes[1];
}

bool isSummed(const Attribute& attribute) { return chooseCoding(attribute, {}).summed; }

TEST(FixedSum, EveryTypeIsExactAndSaysSo) {
  CodedMesh mesh = codeMesh(shape());
  const Index count = mesh.wedgeCount();
  const std::vector<Attribute> all = {
      byteWeights(count), floatWeights(count), wholeWeights<uint16_t>(ComponentType::kUint16, count, 65535),
      wholeWeights<uint16_t>(ComponentType::kUint16, count, 1000, "_SHARES"),
      makeAttribute<int8_t>("_BALANCE", ComponentType::kInt8, 2, count, [](Index w, int c) {
        return c == 0 ? static_cast<int>(w % 90) : -static_cast<int>(w % 90);
      })};
  for (const Attribute& weights : all) {
    EXPECT_TRUE(isSummed(weights)) << weights.name;
    exactBytes(mesh, weights);
  }
}

TEST(FixedSum, TheLargestWeightCostsNothing) {
  CodedMesh mesh = codeMesh(shape());
  const Attribute weights = byteWeights(mesh.wedgeCount());
  Attribute odd = weights;
  odd.data[0] ^= 1;  // so that this wedge has another sum
  EXPECT_FALSE(isSummed(odd));
  EXPECT_LT(exactBytes(mesh, weights) * 10, exactBytes(mesh, odd) * 9);
}

TEST(FixedSum, OnlyWhereAllComponentsMeanShares) {
  CodedMesh mesh = codeMesh(shape());
  const Index count = mesh.wedgeCount();
  EXPECT_FALSE(isSummed(wholeWeights<uint8_t>(ComponentType::kUint8, count, 255, "COLOR_0")));
  EXPECT_FALSE(isSummed(wholeWeights<uint8_t>(ComponentType::kUint8, count, 255, "_SHARES@1")));
  EXPECT_FALSE(
      isSummed(makeAttribute<uint8_t>("WEIGHTS_0", ComponentType::kUint8, 1, count, [](Index w, int) { return w; })));
}

TEST(FixedSum, ASumThatLeavesATypeIsAnError) {
  const Attribute weights = byteWeights(codeMesh(shape()).wedgeCount());
  AttributeCoding coding = chooseCoding(weights, {});
  std::vector<Plane> planes = planesOf(weights, coding, 1);
  splitValues(weights, coding, planes);
  Attribute decoded = weights;
  const auto count = static_cast<Index>(weights.data.size() / 4);
  ASSERT_TRUE(joinValues(planes, coding, count, decoded));
  EXPECT_EQ(decoded.data, weights.data);
  coding.total = 600;
  EXPECT_FALSE(joinValues(planes, coding, count, decoded));
}

TEST(FixedSum, HeadsThatMakeNoSenseAreRefused) {
  const Attribute weights = byteWeights(codeMesh(shape()).wedgeCount());
  const AttributeCoding coding = chooseCoding(weights, {});
  ByteWriter out;
  writeCoding(coding, weights, out);
  const std::vector<uint8_t> bytes = std::move(out).take();
  ByteReader in(bytes);
  const auto back = readCoding(in, weights);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->summed);
  EXPECT_EQ(back->total, 255u);
  Attribute single = weights;
  single.components = 1;
  ByteReader again(bytes);
  EXPECT_FALSE(readCoding(again, single)) << "a sum of one component";
  const std::vector<uint8_t> constant(bytes.size(), 128);
  ByteReader other(constant);
  EXPECT_FALSE(readCoding(other, weights)) << "the sum of a constant";
}

}  // namespace
}  // namespace tutte
