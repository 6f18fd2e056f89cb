// Groups and interior rings.

#include "codec/face_groups.h"

#include <gtest/gtest.h>

#include "tests/codec/overlays.h"

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;

template <class Use>
void damaged(Bytes bytes, Use&& use) {
  for (size_t size = 0; size < bytes.size(); ++size)
    use(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)));
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    use(bytes);
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
  }
}

TEST(Groups, AnyGroupsComeBack) {
  for (const overlays::Base& base : overlays::bases()) {
    for (const Index count : {1u, 2u, 3u, 40u}) {
      for (const Index patch : {1u, 4u, 50u}) {
        const std::vector<Index> groups = overlays::colours(base.mesh, count, patch, count * patch);
        const Result<std::vector<Index>> decoded =
            decodeGroups(base.mesh, encodeGroups(base.mesh, groups, count), count);
        ASSERT_TRUE(decoded.ok()) << base.name;
        EXPECT_EQ(*decoded, groups) << base.name;
      }
    }
  }
}

TEST(Groups, TwoPatchesCostLittle) {
  const Encoded encoded = *encode(shapes::quadGrid(100, 100).mesh);
  std::vector<Index> groups;
  for (const Index face : encoded.face_order) groups.push_back(face >= 5000);
  EXPECT_LE(encodeGroups(encoded.connectivity, groups, 2).size(), 100u);
}

TEST(Groups, DamagedBytesAreHarmless) {
  for (const overlays::Base& base : overlays::bases()) {
    if (base.mesh.face_degrees.size() > 100) continue;
    damaged(encodeGroups(base.mesh, overlays::colours(base.mesh, 3, 2, 1), 3), [&](const Bytes& bytes) {
      const Result<std::vector<Index>> groups = decodeGroups(base.mesh, bytes, 3);
      if (!groups) return;
      ASSERT_EQ(groups->size(), base.mesh.face_degrees.size());
      for (const Index group : *groups) ASSERT_LT(group, 3u);
    });
  }
}

TEST(Rings, AnyRingsComeBack) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const std::vector<Index> owners = overlays::randomRings(1 + static_cast<Index>(seed) * 7, 3, seed);
    const Result<std::vector<Index>> decoded = decodeRings(encodeRings(owners), static_cast<Index>(owners.size()));
    ASSERT_TRUE(decoded.ok());
    EXPECT_EQ(*decoded, owners);
  }
}

TEST(Rings, DamagedBytesAreHarmless) {
  damaged(encodeRings(overlays::randomRings(60, 3, 5)), [](const Bytes& bytes) {
    const Result<std::vector<Index>> owners = decodeRings(bytes, 60);
    ASSERT_TRUE(!owners || ringsAreValid(*owners, {}));
  });
}

TEST(Rings, RefusesRingsOfRingsAndOfOtherGroups) {
  EXPECT_TRUE(ringsAreValid(std::vector<Index>{kNone, 0}, {}));
  EXPECT_FALSE(ringsAreValid(std::vector<Index>{kNone, 0, 1}, {}));
  EXPECT_FALSE(ringsAreValid(std::vector<Index>{0}, {}));
  EXPECT_FALSE(ringsAreValid(std::vector<Index>{kNone, 2}, {}));
  EXPECT_FALSE(ringsAreValid(std::vector<Index>{kNone, 0}, std::vector<Index>{0, 1}));
}

}  // namespace
}  // namespace tutte
