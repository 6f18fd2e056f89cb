// Floats without loss: every bit pattern comes back, printed numbers cost what their digits are worth, and damaged
// bytes are survived.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "codec/encode.h"
#include "codec/numeral_reader.h"
#include "codec/numeral_values.h"
#include "tests/codec/vertex_sites.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

constexpr NumeralSystem kBinary, kSixDigits{10, 6, -12, 5}, kMillionths{10, 8, -6, -6}, kSixteenths{2, 12, -4, -4};

uint32_t bitsOf(double value) { return std::bit_cast<uint32_t>(static_cast<float>(value)); }

using Sites = VertexSites;

NumeralFormat formatOf(int components, const NumeralSystem& system, Relation relation = Relation::kNone) {
  NumeralFormat format{components, relation, {}};
  format.systems.fill(system);
  return format;
}

/// Bytes that the floats take, after they came back.
size_t roundTrip(Sites& sites, const NumeralFormat& format, const std::vector<uint32_t>& floats) {
  EXPECT_TRUE(format.valid());
  const std::vector<uint8_t> bytes = encodeNumerals(sites.graph, format, floats);
  const auto decoded = decodeNumerals(sites.graph, format, bytes);
  EXPECT_TRUE(decoded) << describe(decoded.error());
  EXPECT_EQ(decoded ? *decoded : std::vector<uint32_t>(), floats);
  return bytes.size();
}

TEST(Numerals, EveryFloatOfASystemComesBack) {
  shapes::Random random(1);
  for (const NumeralSystem& system : {kBinary, kSixDigits, kMillionths, kSixteenths, NumeralSystem{2, 1, -149, 104}}) {
    for (int i = 0; i < 20000; ++i) {
      const auto magnitude = static_cast<uint32_t>(random.next()) & 0x7FFFFFFF;
      const auto numeral = numeralOf(system, magnitude);
      if (!numeral) continue;
      ASSERT_EQ(system.floatOf(*numeral), magnitude);
      ASSERT_LT(numeral->n, system.power(system.digits));
      ASSERT_TRUE(numeral->x == system.least || system.digitsOf(numeral->n) == system.digits);
      ASSERT_LT(std::abs(system.fixed(*numeral)), 1 << 27);
    }
  }
  for (uint32_t magnitude : {0u, 1u, 0x7FFFFFu, 0x800000u, 0x7F7FFFFFu}) EXPECT_TRUE(numeralOf(kBinary, magnitude));
  EXPECT_FALSE(numeralOf(kBinary, 0x7F800000u));
}

TEST(Numerals, PrintedNumbersHaveTheirDigits) {
  shapes::Random random(2);
  char text[64];
  for (int i = 0; i < 20000; ++i) {
    const double value = std::ldexp(static_cast<double>(random.below(1u << 30)), -static_cast<int>(random.below(60)));
    std::snprintf(text, sizeof text, "%.6g", value);
    const float printed = std::strtof(text, nullptr);
    if (printed < 1e-7 || printed >= 1e6) continue;
    EXPECT_TRUE(numeralOf({10, 6, -13, 5}, bitsOf(printed))) << text;
    std::snprintf(text, sizeof text, "%.3f", value);
    const bool small = value < 1e5;
    EXPECT_TRUE(!small || numeralOf({10, 8, -3, -3}, bitsOf(std::strtof(text, nullptr)))) << text;
  }
}

TEST(Numerals, AnyBitsComeBackInAnySystem) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    SCOPED_TRACE(name);
    Sites sites(shape.mesh);
    shapes::Random random(3);
    for (int components = 1; components <= 4; ++components) {
      std::vector<uint32_t> floats(sites.graph.siteCount() * static_cast<size_t>(components));
      for (uint32_t& bits : floats) bits = static_cast<uint32_t>(random.next());
      for (const NumeralSystem& system : {kBinary, kSixDigits, kMillionths, kSixteenths}) {
        const size_t bytes = roundTrip(sites, formatOf(components, system), floats);
        EXPECT_LE(bytes, floats.size() * 6 + 100);
      }
    }
  }
}

TEST(Numerals, SpecialValuesComeBack) {
  Sites sites(shapes::triangleTorus(12, 12).mesh);
  const std::array<uint32_t, 10> special{0x7FC00000, 0x7FC12345, 0xFFFFFFFF, 0x7F800000, 0xFF800000,
                                         0x80000000, 0,          1,          0x80000001, 0x7F7FFFFF};
  shapes::Random random(4);
  for (const Relation relation : {Relation::kNone, Relation::kUnitVector, Relation::kUnitSum}) {
    std::vector<uint32_t> floats;
    for (size_t i = 0; i < size_t{sites.graph.siteCount()} * 3; ++i) {
      floats.push_back(random.below(3) ? bitsOf(std::sin(0.1 * static_cast<double>(i))) : special[random.below(10)]);
    }
    roundTrip(sites, formatOf(3, {2, 24, -149, -20}, relation), floats);
    roundTrip(sites, formatOf(3, {10, 6, -12, -5}, relation), floats);
  }
}

TEST(Numerals, RelatedComponentsAreNearlyFree) {
  Sites sites(shapes::triangleTorus(40, 40).mesh);
  shapes::Random random(5);
  std::vector<uint32_t> vectors, sums;
  for (Index i = 0; i < sites.graph.siteCount(); ++i) {
    const double a = 0.6 + 1e-7 * random.below(1000000), b = 0.4 + 1e-7 * random.below(1000000);
    for (const double x : {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)})
      vectors.push_back(bitsOf(x));
    const float first = static_cast<float>(a / 2), second = static_cast<float>(b / 8);
    sums.insert(sums.end(), {bitsOf(first), bitsOf(second), bitsOf(1.0 - first - second)});
  }
  const NumeralSystem system{2, 24, -60, -24};
  EXPECT_LT(roundTrip(sites, formatOf(3, system, Relation::kUnitVector), vectors),
            roundTrip(sites, formatOf(3, system), vectors) * 3 / 4);
  EXPECT_LT(roundTrip(sites, formatOf(3, {2, 24, -60, -23}, Relation::kUnitSum), sums),
            roundTrip(sites, formatOf(3, {2, 24, -60, -23}), sums) * 3 / 4);
}

TEST(Numerals, FormatsThatMakeNoSenseAreRefused) {
  EXPECT_FALSE(formatOf(0, kBinary).valid());
  EXPECT_FALSE(formatOf(5, kBinary).valid());
  EXPECT_FALSE(formatOf(2, {2, 24, -60, -24}, Relation::kUnitVector).valid());
  EXPECT_FALSE(formatOf(3, {2, 24, -60, 100}, Relation::kUnitVector).valid());
  EXPECT_FALSE(formatOf(3, kBinary, static_cast<Relation>(3)).valid());
  for (const NumeralSystem& system :
       {NumeralSystem{3, 6, 0, 0}, NumeralSystem{2, 25, 0, 0}, NumeralSystem{10, 9, 0, 0}, NumeralSystem{2, 0, 0, 0},
        NumeralSystem{2, 9, 1, 0}, NumeralSystem{2, 9, -150, 0}, NumeralSystem{10, 5, -23, 0},
        NumeralSystem{10, 5, 0, 23}}) {
    EXPECT_FALSE(system.valid());
  }
}

class HostileNumerals : public testing::Test {
 protected:
  HostileNumerals() : sites_(shapes::mergeFaces(shapes::randomTriangulation(40, 1), 12, 2).mesh) {}

  Sites sites_;
};

TEST_F(HostileNumerals, PrefixesAndFlipsAreSurvived) {
  shapes::Random random(6);
  for (const NumeralSystem& system : {NumeralSystem{2, 24, -60, -20}, NumeralSystem{10, 6, -12, -5}}) {
    for (const Relation relation : {Relation::kNone, Relation::kUnitVector, Relation::kUnitSum}) {
      const NumeralFormat format = formatOf(3, system, relation);
      std::vector<uint32_t> floats;
      for (size_t i = 0; i < size_t{sites_.graph.siteCount()} * 3; ++i) {
        floats.push_back(bitsOf(1e-5 * static_cast<double>(i * 90 + random.below(100))));
      }
      std::vector<uint8_t> bytes = encodeNumerals(sites_.graph, format, floats);
      for (size_t size = 0; size + 1 < bytes.size(); ++size) {
        const auto decoded = decodeNumerals(sites_.graph, format, std::span(bytes).first(size));
        EXPECT_TRUE(!decoded || *decoded != floats) << size;
      }
      for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
        (void)decodeNumerals(sites_.graph, format, bytes);
        bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
      }
      bytes.insert(bytes.end(), 16, 1);
      EXPECT_FALSE(decodeNumerals(sites_.graph, format, bytes));
    }
  }
}

TEST_F(HostileNumerals, RandomBytesInRandomFormatsAreSurvived) {
  shapes::Random random(7);
  for (int round = 0; round < 20000; ++round) {
    NumeralFormat format{static_cast<int>(random.below(5)), static_cast<Relation>(random.below(4)), {}};
    NumeralSystem system{random.below(2) ? 2 : 10, static_cast<int>(random.below(26)),
                         static_cast<int>(random.below(260)) - 150, 0};
    system.top = system.least + static_cast<int>(random.below(random.below(4) ? 40 : 256));
    format.systems.fill(system);
    std::vector<uint8_t> bytes(random.below(200));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.below(3) ? random.next() : 0xFF * random.below(2));
    const auto decoded = decodeNumerals(sites_.graph, format, bytes);
    EXPECT_TRUE(!decoded || decoded->size() == sites_.graph.siteCount() * static_cast<size_t>(format.components));
  }
}

}  // namespace
}  // namespace tutte
