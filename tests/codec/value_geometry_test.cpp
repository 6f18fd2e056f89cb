// The integer geometry of predictions.

#include "codec/value_geometry.h"

#include <gtest/gtest.h>

namespace tutte {
namespace {

TEST(ValueGeometry, SquareRootsAreRoundedDown) {
  const auto expectRoot = [](uint64_t x) {
    const auto root = static_cast<uint64_t>(values::squareRoot(x));
    EXPECT_TRUE(root * root <= x && (root + 1) * (root + 1) > x) << x;
  };
  for (uint64_t x = 0; x < 10000; ++x) expectRoot(x);
  for (uint64_t root = 1; root < uint64_t{1} << 31; root += root / 7 + 1) {
    for (const uint64_t x : {root * root - 1, root * root, root * root + 1}) expectRoot(x);
  }
}

TEST(ValueGeometry, UnitVectorsHaveTheirLength) {
  for (const values::Vector3 v : {values::Vector3{1, 0, 0}, {0, -5, 0}, {3, 4, 12}, {-1000000, 999999, 7}}) {
    const values::Vector3 unit = values::unit(v);
    EXPECT_NEAR(static_cast<double>(values::squareRoot(static_cast<uint64_t>(values::dot(unit, unit)))), 16384, 2);
  }
  EXPECT_EQ(values::unit({0, 0, 0}), (values::Vector3{0, 0, 0}));
}

}  // namespace
}  // namespace tutte
