#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gltf_ext/attribute_name.h"
#include "gltf_ext/octahedron.h"
#include "tests/gltf/coded_mesh.h"

namespace tutte {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

PackOptions bitsOf(int bits) {
  PackOptions options;
  options.position_bits = options.normal_bits = options.texcoord_bits = bits;
  options.color_bits = options.generic_bits = bits;
  return options;
}

PackOptions lossless() { return bitsOf(0); }

void expectSameDescriptions(const std::vector<Attribute>& a, const std::vector<Attribute>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].components, b[i].components);
    EXPECT_EQ(a[i].type, b[i].type);
    EXPECT_EQ(a[i].normalized, b[i].normalized);
  }
}

std::vector<Attribute> codeAndDecode(const AttributeTopology& topology, const std::vector<Attribute>& attributes,
                                     const PackOptions& options) {
  const auto bytes = encodeAttributes(topology, attributes, options);
  EXPECT_TRUE(bytes.ok()) << bytes.error().what;
  if (!bytes) return {};
  const auto described = describeAttributes(*bytes);
  EXPECT_TRUE(described.ok());
  if (described) expectSameDescriptions(*described, attributes);
  auto decoded = decodeAttributes(topology, *bytes);
  EXPECT_TRUE(decoded.ok()) << decoded.error().what;
  if (!decoded) return {};
  expectSameDescriptions(*decoded, attributes);
  for (size_t i = 0; i < decoded->size(); ++i) EXPECT_EQ((*decoded)[i].data.size(), attributes[i].data.size());
  return *std::move(decoded);
}

/// What attributes decode to; no matter who codes them, it is the same.
std::vector<Attribute> roundTrip(CodedMesh& mesh, const std::vector<Attribute>& attributes, PackOptions options = {}) {
  const AttributeTopology topology = mesh.topology(attributes);
  options.attribute_coder = AttributeCoder::kTutte;
  const auto own = codeAndDecode(topology, attributes, options);
  options.attribute_coder = AttributeCoder::kDraco;
  auto decoded = codeAndDecode(topology, attributes, options);
  EXPECT_EQ(own.size(), decoded.size());
  for (size_t i = 0; i < std::min(own.size(), decoded.size()); ++i) EXPECT_EQ(own[i].data, decoded[i].data);
  return decoded;
}

/// Half a step of the grid that the values span, and what rounding to float adds.
double quantisationBound(const Attribute& attribute, int bits) {
  double range = 0, largest = 0;
  for (int c = 0; c < attribute.components; ++c) {
    double low = kInfinity, high = -kInfinity;
    for (Index w = 0; w * attribute.stride() < attribute.data.size(); ++w) {
      low = std::min(low, double{floatAt(attribute, w, c)});
      high = std::max(high, double{floatAt(attribute, w, c)});
    }
    range = std::max(range, high - low);
    largest = std::max({largest, std::fabs(low), std::fabs(high)});
  }
  return range / (std::ldexp(1.0, bits) - 1) / 2 * 1.000001 + largest * 1.2e-7;
}

double largestError(const Attribute& a, const Attribute& b) {
  double error = 0;
  for (Index w = 0; w * a.stride() < a.data.size(); ++w) {
    for (int c = 0; c < a.components; ++c) {
      error = std::max(error, std::fabs(double{floatAt(a, w, c)} - floatAt(b, w, c)));
    }
  }
  return error;
}

std::array<float, 3> direction(Index wedge) {
  const double a = 0.37 * wedge, b = 1.1 * wedge;
  const double x = std::cos(a) * std::cos(b), y = std::sin(a) * std::cos(b), z = std::sin(b);
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

float wave(Index wedge, int c) { return static_cast<float>(std::sin(0.01 * wedge + c) + 0.3 * c); }

TEST(Attributes, PositionsOfEveryShape) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    for (const bool split : {false, true}) {
      CodedMesh mesh = codeMesh(shape, split);
      const std::vector<Attribute> attributes{positionsOf(mesh, shape)};
      const auto decoded = roundTrip(mesh, attributes);
      ASSERT_EQ(decoded.size(), 1u);
      EXPECT_LE(largestError(attributes[0], decoded[0]), quantisationBound(attributes[0], 14));
      const auto exact = roundTrip(mesh, attributes, lossless());
      ASSERT_EQ(exact.size(), 1u);
      EXPECT_EQ(exact[0].data, attributes[0].data);
    }
  }
}

TEST(Attributes, SeamsKeepEveryWedgesValue) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    CodedMesh mesh = codeMesh(shape, true);
    const Index count = mesh.wedgeCount();
    std::vector<Attribute> attributes{positionsOf(mesh, shape)};
    attributes.push_back(makeFloats("NORMAL", 3, count, [](Index w, int c) { return direction(w)[c]; }));
    attributes.push_back(makeFloats("TEXCOORD_0", 2, count, wave));
    attributes.push_back(makeFloats("TEXCOORD_1", 2, count, [&](Index w, int c) { return wave(mesh.vertex[w], c); }));
    attributes.push_back(makeAttribute<uint16_t>("_ID", ComponentType::kUint16, 1, count,
                                                 [](Index w, int) { return static_cast<uint16_t>(w * 7); }));
    const auto decoded = roundTrip(mesh, attributes);
    ASSERT_EQ(decoded.size(), attributes.size());
    EXPECT_LE(largestError(attributes[1], decoded[1]), 3.0 / octahedronCentre(10));
    EXPECT_LE(largestError(attributes[2], decoded[2]), quantisationBound(attributes[2], 12));
    EXPECT_LE(largestError(attributes[3], decoded[3]), quantisationBound(attributes[3], 12));
    EXPECT_EQ(decoded[4].data, attributes[4].data);
  }
}

TEST(Attributes, DecodedValuesAreAFixedPoint) {
  const shapes::Shape shape = shapes::mergeFaces(shapes::randomTriangulation(300, 5), 100, 6);
  CodedMesh mesh = codeMesh(shape);
  std::vector<Attribute> attributes{positionsOf(mesh, shape)};
  attributes.push_back(makeFloats("NORMAL", 3, mesh.wedgeCount(), [](Index w, int c) { return direction(w)[c]; }));
  const auto once = roundTrip(mesh, attributes);
  const auto twice = roundTrip(mesh, once);
  for (size_t i = 0; i < attributes.size(); ++i) EXPECT_EQ(once[i].data, twice[i].data) << attributes[i].name;
}

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
    expectExact(attribute, lossless());
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
  expectExact(few, lossless());
  const std::vector<Attribute> attributes{positionsOf(mesh_, shape_), few};
  const auto with = encodeAttributes(mesh_.topology(attributes), attributes, lossless());
  const auto without = encodeAttributes(mesh_.topology({attributes[0]}), {attributes.data(), 1}, lossless());
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

TEST(Attributes, NoneAndNothing) {
  CodedMesh mesh = codeMesh(shapes::cube());
  EXPECT_TRUE(roundTrip(mesh, {}).empty());
  CodedMesh empty = codeMesh(shapes::Shape{});
  const auto decoded = roundTrip(empty, {makeFloats("POSITION", 3, 0, wave), makeFloats("NORMAL", 3, 0, wave)});
  EXPECT_EQ(decoded.size(), 2u);
}

TEST(Attributes, ManyMorphTargets) {
  const shapes::Shape shape = shapes::quadGrid(6, 6);
  CodedMesh mesh = codeMesh(shape);
  std::vector<Attribute> attributes{positionsOf(mesh, shape)};
  for (int target = 0; target < 300; ++target) {
    attributes.push_back(makeFloats("POSITION@" + std::to_string(target), 3, mesh.wedgeCount(),
                                    [&](Index w, int c) { return wave(w * target, c); }));
  }
  const auto decoded = roundTrip(mesh, attributes);
  ASSERT_EQ(decoded.size(), attributes.size());
  for (size_t i = 0; i < decoded.size(); ++i) {
    EXPECT_LE(largestError(attributes[i], decoded[i]), quantisationBound(attributes[i], 14));
  }
}

TEST(Octahedron, EveryPointOfASmallGridComesBack) {
  for (int bits = 2; bits <= 7; ++bits) {
    const int32_t last = 2 * octahedronCentre(bits);
    for (int32_t s = 0; s <= last; ++s) {
      for (int32_t t = 0; t <= last; ++t) {
        const auto vector = pointToVector({s, t}, bits);
        const auto point = vectorToPoint({vector[0], vector[1], vector[2]}, bits);
        EXPECT_EQ(pointToVector(point, bits), vector) << bits << ": " << s << ", " << t;
      }
    }
  }
}

TEST(Octahedron, StaysWithinItsBound) {
  for (const int bits : {2, 3, 8, 10, 16, 24}) {
    for (Index i = 0; i < 20000; ++i) {
      const auto v = direction(i);
      const auto back = pointToVector(vectorToPoint({v[0], v[1], v[2]}, bits), bits);
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(back[c], v[c], 2.2 / octahedronCentre(bits) + 1.2e-7) << bits;
    }
  }
}

}  // namespace
}  // namespace tutte
