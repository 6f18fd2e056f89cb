#include "gltf_ext/octahedron.h"

#include <gtest/gtest.h>

#include "tests/gltf/attribute_trip.h"

namespace tutte {
namespace {

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
