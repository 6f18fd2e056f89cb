// One attribute beside the positions, of every type and meaning.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf_ext/attribute_name.h"
#include "gltf_ext/octahedron.h"
#include "tests/gltf/attribute_trip.h"
#include "tests/gltf/coded_mesh.h"

namespace tutte {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class OneAttribute : public testing::Test {
 protected:
  OneAttribute() : shape_(shapes::quadTorus(12, 9)), mesh_(codeMesh(shape_)) {}

  Attribute through(Attribute attribute, const PackOptions& options = {}) {
    std::vector<Attribute> attributes{positionsOf(mesh_, shape_), std::move(attribute)};
    auto decoded = roundTrip(mesh_, attributes, options);
    return decoded.size() == 2 ? std::move(decoded[1]) : Attribute{};
  }

  void expectExact(const Attribute& attribute, const PackOptions& options = {}) {
    EXPECT_EQ(through(attribute, options).data, attribute.data) << attribute.name;
  }

  Index count() const { return mesh_.wedgeCount(); }

  shapes::Shape shape_;
  CodedMesh mesh_;
};

TEST_F(OneAttribute, IntegersOfEveryTypeAreExact) {
  shapes::Random random(1);
  const auto any = [&](Index, int) { return random.next(); };
  expectExact(makeAttribute<int8_t>("_A", ComponentType::kInt8, 3, count(), any));
  expectExact(makeAttribute<uint8_t>("COLOR_0", ComponentType::kUint8, 4, count(), any));
  expectExact(makeAttribute<int16_t>("_B", ComponentType::kInt16, 2, count(), any));
  expectExact(makeAttribute<uint16_t>("JOINTS_0", ComponentType::kUint16, 4, count(), any));
  expectExact(makeAttribute<uint32_t>("_C", ComponentType::kUint32, 1, count(), any));
  Attribute normalized = makeAttribute<int16_t>("NORMAL", ComponentType::kInt16, 3, count(), any);
  normalized.normalized = true;
  expectExact(normalized);
  Attribute texcoords = makeAttribute<uint16_t>("TEXCOORD_0", ComponentType::kUint16, 2, count(), any);
  texcoords.normalized = true;
  expectExact(texcoords);
}

TEST_F(OneAttribute, AnyFloatBitsAreExactWithoutQuantisation) {
  shapes::Random random(2);
  const auto bits = [&](Index, int) { return static_cast<uint32_t>(random.next()); };
  for (const char* name : {"NORMAL", "TANGENT", "TEXCOORD_3", "COLOR_1", "WEIGHTS_0", "_CUSTOM", "POSITION@2"}) {
    Attribute attribute = makeAttribute<uint32_t>(name, ComponentType::kFloat, 4, count(), bits);
    expectExact(attribute, losslessPacking());
  }
}

TEST_F(OneAttribute, WhatIsNotFiniteIsExact) {
  for (const float odd : {kNan, kInfinity, -kInfinity}) {
    for (const char* name : {"NORMAL", "TANGENT", "TEXCOORD_0", "_CUSTOM"}) {
      expectExact(makeFloats(name, 4, count(), [&](Index w, int c) { return w == 5 ? odd : wave(w, c); }));
    }
  }
  const float huge = std::numeric_limits<float>::max();
  expectExact(makeFloats("_HUGE", 1, count(), [&](Index w, int) { return w % 2 ? huge : -huge; }));
}

TEST_F(OneAttribute, WeightsAreExact) {
  expectExact(makeFloats("WEIGHTS_0", 4, count(), [](Index w, int c) { return c == 3 ? 0.0 : 1.0 / (1 + w % 5 + c); }));
  expectExact(makeFloats("WEIGHTS_1", 4, count(),
                         [](Index w, int c) { return static_cast<float>(w * (c + 1) % 256) / 255.f; }));
}

TEST_F(OneAttribute, WeightsThatSumUpToOneCostLittle) {
  const Attribute weights = makeFloats("WEIGHTS_0", 4, count(), [](Index w, int c) {
    const double first = 0.5 + 0.3 * std::sin(0.1 * w), second = (1 - first) * 0.7, third = (1 - first) * 0.2;
    const float parts[] = {static_cast<float>(first), static_cast<float>(second), static_cast<float>(third)};
    return c < 3 ? parts[c] : 1 - parts[0] - parts[1] - parts[2];
  });
  expectExact(weights);
  Attribute without = weights;
  without.components = 3;
  without.data.clear();
  for (Index w = 0; w < count(); ++w) {
    without.data.insert(without.data.end(), &weights.data[16 * w], &weights.data[16 * w + 12]);
  }
  const std::vector<Attribute> all{positionsOf(mesh_, shape_), weights}, some{all[0], without};
  const auto four = encodeAttributes(mesh_.topology(all), all, {}),
             three = encodeAttributes(mesh_.topology(some), some, {});
  EXPECT_LE(four->size(), three->size() + count() * 3 / 4);
}

TEST_F(OneAttribute, FewFloatsAreExactAndCheap) {
  const Attribute few = makeFloats("_FEW", 3, count(), [](Index w, int c) { return std::sin(1.0 + w / 9 % 4 + c); });
  expectExact(few, losslessPacking());
  const std::vector<Attribute> attributes{positionsOf(mesh_, shape_), few};
  const auto with = encodeAttributes(mesh_.topology(attributes), attributes, losslessPacking());
  const auto without = encodeAttributes(mesh_.topology({attributes[0]}), {attributes.data(), 1}, losslessPacking());
  EXPECT_LE(with->size(), without->size() + 12 * 5 + count());
}

TEST_F(OneAttribute, ErrorBoundsAreKept) {
  for (const char* name : {"TEXCOORD_0", "COLOR_0", "_CUSTOM", "NORMAL@0"}) {
    for (const double bound : {0.1, 0.01, 1e-4}) {
      PackOptions options;
      options.errors.texcoord = options.errors.color = options.errors.generic = {bound, false};
      const Attribute attribute = makeFloats(name, 3, count(), wave);
      EXPECT_LE(largestError(attribute, through(attribute, options)), bound) << name;
      EXPECT_GE(largestError(attribute, through(attribute, options)), bound / 5) << name;
    }
  }
}

TEST_F(OneAttribute, WholeNumbersAreExact) {
  expectExact(makeFloats("_FEATURE_ID_0", 1, count(), [](Index w, int) { return static_cast<float>(w / 9); }));
  expectExact(
      makeFloats("_SIGNED", 2, count(), [](Index w, int c) { return static_cast<float>(int(w % 11) - 5 * c); }));
}

TEST_F(OneAttribute, FloatsStayWithinTheirGrid) {
  const PackOptions options;
  const auto check = [&](const char* name, int components, int bits) {
    const Attribute attribute = makeFloats(name, components, count(), wave);
    EXPECT_LE(largestError(attribute, through(attribute, options)), quantisationBound(attribute, bits)) << name;
  };
  check("TEXCOORD_0", 2, options.texcoord_bits);
  check("COLOR_0", 4, options.color_bits);
  check("_CUSTOM", 1, options.generic_bits);
  check("POSITION@0", 3, options.position_bits);
  check("NORMAL@0", 3, options.generic_bits);
  check("TEXCOORD_0@7", 2, options.generic_bits);
}

TEST_F(OneAttribute, EveryNumberOfBits) {
  for (int bits = 2; bits <= 24; ++bits) {
    const PackOptions options = bitsOf(bits);
    const Attribute texcoords = makeFloats("TEXCOORD_0", 2, count(), wave);
    EXPECT_LE(largestError(texcoords, through(texcoords, options)), quantisationBound(texcoords, bits)) << bits;
    const Attribute normals = makeFloats("NORMAL", 3, count(), [](Index w, int c) { return direction(w)[c]; });
    EXPECT_LE(largestError(normals, through(normals, options)), 3.0 / octahedronCentre(bits) + 1.2e-7) << bits;
  }
}

TEST_F(OneAttribute, BitsOutOfRangeAreRefused) {
  const std::vector<Attribute> attributes{positionsOf(mesh_, shape_)};
  const AttributeTopology topology = mesh_.topology(attributes);
  for (const int bits : {25, -1, 1, 99}) {
    const PackOptions options = bitsOf(bits);
    const auto bytes = encodeAttributes(topology, attributes, options);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().kind, FailureKind::kUsage);
  }
}

TEST_F(OneAttribute, UnitNormalsStayUnit) {
  const Attribute normals = makeFloats("NORMAL", 3, count(), [](Index w, int c) { return direction(w)[c]; });
  const Attribute decoded = through(normals);
  for (Index w = 0; w < count(); ++w) {
    const double x = floatAt(decoded, w, 0), y = floatAt(decoded, w, 1), z = floatAt(decoded, w, 2);
    EXPECT_NEAR(x * x + y * y + z * z, 1, 1e-6);
  }
}

TEST_F(OneAttribute, OtherNormalsAreQuantised) {
  const Attribute scaled = makeFloats("NORMAL", 3, count(), [](Index w, int c) { return 3 * direction(w)[c]; });
  EXPECT_LE(largestError(scaled, through(scaled)), quantisationBound(scaled, 10));
  const Attribute partly = makeFloats("NORMAL", 3, count(), [](Index w, int c) { return w ? direction(w)[c] : 0.f; });
  EXPECT_LE(largestError(partly, through(partly)), quantisationBound(partly, 10));
  expectExact(makeFloats("NORMAL", 3, count(), [](Index, int) { return 0.f; }));
}

TEST_F(OneAttribute, TangentsKeepTheirSigns) {
  for (const int period : {1, 2, 1000}) {
    const Attribute tangents = makeFloats("TANGENT", 4, count(), [&](Index w, int c) {
      return c < 3 ? direction(w)[c] : w % period ? 1.f : -1.f;
    });
    const Attribute decoded = through(tangents);
    EXPECT_LE(largestError(tangents, decoded), 3.0 / octahedronCentre(10));
    for (Index w = 0; w < count(); ++w) EXPECT_EQ(floatAt(tangents, w, 3), floatAt(decoded, w, 3));
  }
}

TEST_F(OneAttribute, OtherTangentsAreExact) {
  expectExact(makeFloats("TANGENT", 4, count(), [](Index w, int c) { return c < 3 ? direction(w)[c] : 0.5f; }));
  expectExact(makeFloats("TANGENT", 4, count(), [](Index w, int c) { return c < 3 ? 2 * direction(w)[c] : 1.f; }));
}

TEST_F(OneAttribute, OneValueEverywhereIsExactAndCheap) {
  const Attribute white = makeFloats("COLOR_0", 4, count(), [](Index, int c) { return 0.1 * c; });
  expectExact(white);
  const std::vector<Attribute> attributes{positionsOf(mesh_, shape_), white};
  const auto with = encodeAttributes(mesh_.topology(attributes), attributes, {});
  const auto without = encodeAttributes(mesh_.topology({attributes[0]}), {attributes.data(), 1}, {});
  EXPECT_LE(with->size(), without->size() + 20);
}

TEST_F(OneAttribute, NamesComeBack) {
  for (const char* name : {"POSITION@3", "TEXCOORD_17", "TEXCOORD_007", "TEXCOORD_", "TEXCOORD", "COLOR_4294967295",
                           "COLOR_4294967296", "NORMAL@", "@1", "", "_A@B@2", "JOINTS_1@0", "_\xC3\xA9t\xC3\xA9"}) {
    expectExact(makeAttribute<uint8_t>(name, ComponentType::kUint8, 1, count(), [](Index w, int) { return w; }));
    EXPECT_EQ(nameOf(parseName(name)), name);
  }
}

TEST_F(OneAttribute, TwoValuesWithoutASeamAreRefused) {
  std::vector<Attribute> attributes{positionsOf(mesh_, shape_)};
  CodedMesh split = codeMesh(shape_, true);
  attributes[0] = makeFloats("POSITION", 3, split.wedgeCount(), wave);
  const auto bytes = encodeAttributes(split.topology(attributes), attributes, {});
  ASSERT_FALSE(bytes.ok());
  EXPECT_EQ(bytes.error().kind, FailureKind::kInvalid);
}

TEST_F(OneAttribute, WrongSizesAreRefused) {
  std::vector<Attribute> attributes{positionsOf(mesh_, shape_)};
  const AttributeTopology topology = mesh_.topology(attributes);
  attributes[0].data.pop_back();
  EXPECT_FALSE(encodeAttributes(topology, attributes, {}).ok());
  attributes[0].components = 5;
  EXPECT_FALSE(encodeAttributes(topology, attributes, {}).ok());
}

}  // namespace
}  // namespace tutte
