// Attribute values over meshes of every kind: exact round trips, bytes that stay the same, and damaged bytes.

#include "codec/values.h"

#include <gtest/gtest.h>

#include <array>

#include "codec/bytes.h"
#include "codec/value_surroundings.h"
#include "tests/codec/vertex_sites.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

constexpr ValueProfile kProfiles[] = {ValueProfile::kFast, ValueProfile::kDefault, ValueProfile::kSmall};

using Sites = VertexSites;

/// Values that are smooth where neighbours have near numbers, with some noise.
std::vector<int32_t> someValues(const Sites& sites, int components, int32_t max, uint64_t seed) {
  shapes::Random random(seed);
  std::vector<int32_t> values;
  for (const Index vertex : sites.vertex_order) {
    for (int c = 0; c < components; ++c) {
      const int64_t smooth = int64_t{vertex} * max / static_cast<int64_t>(sites.vertex_order.size()) * (c + 1) / 4;
      const int64_t noise = random.below(static_cast<Index>(max / 50 + 1));
      values.push_back(static_cast<int32_t>(std::min<int64_t>(smooth + noise, max)));
    }
  }
  return values;
}

std::vector<uint8_t> bytesOf(const Sites& sites, const ValueFormat& format, std::span<const int32_t> values) {
  ByteWriter out;
  EXPECT_TRUE(encodeValues({sites.graph, {}}, format, values, out));
  return std::move(out).take();
}

TEST(Values, SurroundingsAreKnown) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    const Sites sites(shape.mesh);
    values::SurroundingsFinder finder(sites.graph, {.edges = true});
    for (Index i = 0; i < sites.graph.siteCount(); ++i) {
      const values::Surroundings around = finder.next();
      ASSERT_EQ(around.site(), i) << name;
      for (const Index neighbour : around.neighbours()) ASSERT_LT(neighbour, i) << name;
      for (const auto& list : {around.scaled(), around.within(), around.across(), around.over()}) {
        for (const values::Term& term : list) ASSERT_LT(std::max({term.a, term.b, term.x}), i) << name;
      }
      for (const values::Edge& edge : around.edges()) ASSERT_LT(std::max(edge.from, edge.to), i) << name;
    }
  }
}

TEST(Values, RoundTrips) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    const Sites sites(shape.mesh);
    for (const ValueProfile profile : kProfiles) {
      for (int components = 1; components <= 4; ++components) {
        for (const int32_t max : {0, 1, 255, 16383, (1 << 27) - 1}) {
          const ValueFormat format{components, max, profile,
                                   components == 3 && max < 1 << 20 ? ValueKind::kPoints : ValueKind::kPlain};
          const std::vector<int32_t> values = someValues(sites, components, max, static_cast<uint64_t>(max));
          if (values.empty()) continue;
          const std::vector<uint8_t> bytes = bytesOf(sites, format, values);
          const Result<std::vector<int32_t>> decoded = decodeValues({sites.graph, {}}, format, bytes);
          ASSERT_TRUE(decoded) << name << ": " << describe(decoded.error());
          ASSERT_EQ(*decoded, values) << name << ", " << components << " components up to " << max;
        }
      }
    }
  }
}

/// The extremes of the range side by side: the largest residuals there are.
TEST(Values, Extremes) {
  const Sites sites(shapes::triangleTorus(20, 20).mesh);
  for (const ValueProfile profile : kProfiles) {
    for (const int32_t max : {1, 1 << 20, (1 << 27) - 1}) {
      shapes::Random random(7);
      std::vector<int32_t> values(size_t{sites.graph.siteCount()} * 3);
      for (int32_t& value : values) value = random.below(2) ? max : 0;
      const ValueFormat format{3, max, profile, max < 1 << 20 ? ValueKind::kAngular : ValueKind::kPlain};
      const auto decoded = decodeValues({sites.graph, {}}, format, bytesOf(sites, format, values));
      ASSERT_TRUE(decoded);
      EXPECT_EQ(*decoded, values);
    }
  }
}

/// Affine images of a grid are predicted exactly: close to no bytes.
TEST(Values, PlanesAreNearlyFree) {
  const Index columns = 60, rows = 60;
  const shapes::Shape grid = shapes::quadGrid(columns, rows);
  const Sites sites(grid.mesh);
  std::vector<int32_t> values;
  for (const Index vertex : sites.vertex_order) {
    const auto x = static_cast<int32_t>(vertex % (columns + 1)), y = static_cast<int32_t>(vertex / (columns + 1));
    values.insert(values.end(), {10 * x + 3 * y, 7 * y, 5 * x + 2 * y + 100});
  }
  const std::vector<uint8_t> bytes = bytesOf(sites, {3, 4095, ValueProfile::kDefault, ValueKind::kPoints}, values);
  EXPECT_LT(bytes.size(), size_t{columns} * rows / 16);
}

bool isHarmless(const Sites& sites, const ValueFormat& format, std::span<const uint8_t> bytes) {
  const auto decoded = decodeValues({sites.graph, {}}, format, bytes);
  if (!decoded) return true;
  if (decoded->size() != size_t{sites.graph.siteCount()} * format.components) return false;
  for (const int32_t value : *decoded) {
    if (value < 0 || value > format.max) return false;
  }
  return true;
}

TEST(Values, DamagedBytes) {
  for (const shapes::Shape& shape : {shapes::triangleTorus(6, 6), shapes::quadGrid(5, 5), shapes::hexGrid(4, 4)}) {
    const Sites sites(shape.mesh);
    for (const ValueProfile profile : kProfiles) {
      for (const int32_t max : {16383, (1 << 27) - 1}) {
        const ValueFormat format{3, max, profile, max < 1 << 20 ? ValueKind::kAngular : ValueKind::kPlain};
        std::vector<uint8_t> bytes = bytesOf(sites, format, someValues(sites, 3, max, 3));
        for (size_t size = 0; size < bytes.size(); size += 5) {
          ASSERT_TRUE(isHarmless(sites, format, std::span(bytes).first(size)));
        }
        for (size_t bit = 0; bit < 8 * bytes.size(); bit += 7) {
          bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
          ASSERT_TRUE(isHarmless(sites, format, bytes));
          bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
        }
        bytes.push_back(1);
        EXPECT_FALSE(decodeValues({sites.graph, {}}, format, bytes));
      }
    }
  }
}

TEST(Values, Noise) {
  const Sites sites(shapes::randomTriangulation(60, 9).mesh);
  for (uint64_t seed = 0; seed < 3000; ++seed) {
    shapes::Random random(seed);
    std::vector<uint8_t> bytes(random.below(300));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next());
    const ValueFormat format{3, 4095, kProfiles[seed % 3], seed % 2 ? ValueKind::kPoints : ValueKind::kPlain};
    ASSERT_TRUE(isHarmless(sites, format, bytes)) << seed;
  }
}

struct Guided {
  ValueFormat format;
  std::vector<int32_t> places;
  std::vector<int32_t> values;
};

/// A sheet with its texture laid flat on it, or with normals that are all alike.
Guided guided(const Sites& sites, ValueKind kind, ValueProfile profile) {
  Guided result{{2, 1022, profile, kind}, {}, {}};
  for (const Index vertex : sites.vertex_order) {
    const auto x = static_cast<int32_t>(vertex % 21), y = static_cast<int32_t>(vertex / 21);
    result.places.insert(result.places.end(), {100 * x + 7 * y * y, 90 * y, 30 * x});
    const std::array<int32_t, 2> texcoord = {40 * x, 30 * y}, normal = {300, 500 + x % 2};
    const auto& value = kind == ValueKind::kTexcoord ? texcoord : normal;
    result.values.insert(result.values.end(), value.begin(), value.end());
  }
  return result;
}

TEST(Values, GuidedRoundTripsAndDamage) {
  for (const shapes::Shape& shape :
       {shapes::quadGrid(20, 20), shapes::triangleGrid(20, 20), shapes::soup(441, 300, 3, 6, 5)}) {
    const Sites sites(shape.mesh);
    for (const ValueProfile profile : kProfiles) {
      for (const ValueKind kind : {ValueKind::kTexcoord, ValueKind::kDirection}) {
        const Guided given = guided(sites, kind, profile);
        const ValueSites where{sites.graph, given.places};
        ByteWriter out;
        ASSERT_TRUE(encodeValues(where, given.format, given.values, out));
        std::vector<uint8_t> bytes = std::move(out).take();
        const auto decoded = decodeValues(where, given.format, bytes);
        ASSERT_TRUE(decoded) << describe(decoded.error());
        ASSERT_EQ(*decoded, given.values);
        for (size_t bit = 0; bit < 8 * bytes.size(); bit += 31) {
          bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
          const auto damaged = decodeValues(where, given.format, bytes);
          if (damaged) {
            ASSERT_EQ(damaged->size(), given.values.size());
          }
          bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
        }
      }
    }
  }
}

/// Few different values, far apart: lists of them, and names.
TEST(Values, ListsRoundTripsAndDamage) {
  for (const auto& [name, shape] : shapes::allShapes()) {
    const Sites sites(shape.mesh);
    shapes::Random random(4);
    for (const int32_t max : {1000, (1 << 27) - 1}) {
      for (int components = 1; components <= 4; ++components) {
        std::vector<int32_t> values;
        for (size_t i = 0; i < size_t{sites.graph.siteCount()} * components; ++i) {
          values.push_back(static_cast<int32_t>(random.below(3)) * (max / 2));
        }
        for (const ValueFormat& format :
             {ValueFormat{components, max, ValueProfile::kDefault, ValueKind::kLabel},
              ValueFormat{components, max, ValueProfile::kDefault, ValueKind::kPlain, true},
              ValueFormat{components, max, ValueProfile::kFast, ValueKind::kPlain, false, true}}) {
          const ValueSites where{sites.graph, {}};
          ByteWriter out;
          if (!encodeValues(where, format, values, out)) continue;
          std::vector<uint8_t> bytes = std::move(out).take();
          const auto decoded = decodeValues(where, format, bytes);
          ASSERT_TRUE(decoded) << name << describe(decoded.error());
          ASSERT_EQ(*decoded, values) << name;
          for (size_t bit = 0; bit < 8 * bytes.size(); bit += 37) {
            bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
            ASSERT_TRUE(isHarmless(sites, format, bytes)) << name;
            ASSERT_TRUE(isHarmless(sites, format, std::span(bytes).first(bit / 8))) << name;
            bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
          }
        }
      }
    }
  }
}

/// Strips side by side: what one strip's border says is not said again by the next one's.
TEST(Values, EchoesOfOtherBordersAreCheap) {
  constexpr Index kStrips = 20, kRows = 30;
  Polygons mesh;
  for (Index strip = 0; strip < kStrips; ++strip) {
    const Index first = strip * 2 * (kRows + 1);
    for (Index row = 0; row < kRows; ++row) {
      const Index low = first + 2 * row;
      mesh.face_degrees.push_back(4);
      mesh.corners.insert(mesh.corners.end(), {low, low + 1, low + 3, low + 2});
    }
  }
  mesh.vertex_count = kStrips * 2 * (kRows + 1);
  const Sites sites(mesh);
  std::vector<int32_t> values;
  for (const Index vertex : sites.vertex_order) {
    const Index column = vertex / (2 * (kRows + 1)) + vertex % 2, row = vertex % (2 * (kRows + 1)) / 2;
    shapes::Random random(column * 100 + row);
    for (const Index place : {column, row, column + row}) {
      values.push_back(static_cast<int32_t>(100 * place + random.below(60)));
    }
  }
  for (const ValueProfile profile : kProfiles) {
    ValueFormat format{3, 8191, profile, ValueKind::kPoints};
    const size_t plain = bytesOf(sites, format, values).size();
    format.echoes = true;
    const std::vector<uint8_t> bytes = bytesOf(sites, format, values);
    EXPECT_LT(bytes.size(), plain * 2 / 3);
    const auto decoded = decodeValues({sites.graph, {}}, format, bytes);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, values);
  }
}

TEST(Values, UnsupportedFormatsAreRefused) {
  const Sites sites(shapes::cube().mesh);
  const ValueSites where{sites.graph, {}};
  EXPECT_TRUE(supports(where, {3, 100, ValueProfile::kDefault, ValueKind::kPoints}));
  EXPECT_FALSE(supports(where, {2, 100, ValueProfile::kDefault, ValueKind::kPoints}));
  EXPECT_FALSE(supports(where, {3, 100, ValueProfile::kDefault, ValueKind::kAngular, true}));
  EXPECT_FALSE(supports(where, {2, 100, ValueProfile::kDefault, ValueKind::kTexcoord}));  // no places
  EXPECT_FALSE(supports(where, {2, 101, ValueProfile::kDefault, ValueKind::kDirection}));
  EXPECT_FALSE(supports(where, {3, 100, ValueProfile::kDefault, ValueKind::kLabel, false, true}));
  EXPECT_FALSE(supports(where, {5, 100, ValueProfile::kDefault, ValueKind::kPlain}));
  EXPECT_FALSE(supports(where, {1, 1 << 27, ValueProfile::kDefault, ValueKind::kPlain}));
}

TEST(Values, DirectionsNameAWeighting) {
  const Sites sites(shapes::cube().mesh);
  const ValueFormat format{2, 510, ValueProfile::kDefault, ValueKind::kDirection};
  const std::vector<int32_t> places = someValues(sites, 3, 1000, 1);
  ByteWriter out;
  ASSERT_TRUE(encodeValues({sites.graph, places}, format, someValues(sites, 2, 510, 2), out));
  std::vector<uint8_t> bytes = std::move(out).take();
  EXPECT_TRUE(decodeValues({sites.graph, places}, format, bytes));
  bytes[0] = 3;
  EXPECT_EQ(decodeValues({sites.graph, places}, format, bytes).error(), Error::kMalformed);
}

}  // namespace
}  // namespace tutte
