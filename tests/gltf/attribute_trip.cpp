#include "tests/gltf/attribute_trip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tutte {
namespace {

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

}  // namespace

PackOptions bitsOf(int bits) {
  PackOptions options;
  options.position_bits = options.normal_bits = options.texcoord_bits = bits;
  options.color_bits = options.generic_bits = bits;
  return options;
}

PackOptions losslessPacking() { return bitsOf(0); }

std::vector<Attribute> roundTrip(CodedMesh& mesh, const std::vector<Attribute>& attributes, PackOptions options) {
  const AttributeTopology topology = mesh.topology(attributes);
  options.attribute_coder = AttributeCoder::kTutte;
  const auto own = codeAndDecode(topology, attributes, options);
  options.attribute_coder = AttributeCoder::kDraco;
  auto decoded = codeAndDecode(topology, attributes, options);
  EXPECT_EQ(own.size(), decoded.size());
  for (size_t i = 0; i < std::min(own.size(), decoded.size()); ++i) EXPECT_EQ(own[i].data, decoded[i].data);
  return decoded;
}

double quantisationBound(const Attribute& attribute, int bits) {
  double range = 0, largest = 0;
  for (int c = 0; c < attribute.components; ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
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

}  // namespace tutte
