// One Decoder and one Encoder for many meshes: they leave nothing behind that a later mesh could notice.

#include <gtest/gtest.h>

#include "codec/decode.h"
#include "codec/encode.h"
#include "tests/codec/checks.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using shapes::Named;

TEST(Reuse, MeshesOfAllKindsDoNotNoticeEachOther) {
  Encoder encoder;
  Decoder decoder;
  for (const Named& named : shapes::allShapes()) {
    for (const Profile profile : {Profile::kSmall, Profile::kFast, Profile::kPaper, Profile::kDefault}) {
      const EncodeOptions options{profile, 0};
      const Result<Encoded> alone = encode(named.shape.mesh, options);
      const Result<Encoded> after_others = encoder.encode(named.shape.mesh, options);
      ASSERT_TRUE(alone.ok() && after_others.ok()) << named.name;
      EXPECT_EQ(alone->bytes, after_others->bytes) << named.name << ", profile " << static_cast<int>(profile);
      const Result<Connectivity> decoded = decoder.decode(alone->bytes);
      ASSERT_TRUE(decoded.ok()) << named.name;
      EXPECT_TRUE(areEqual(*decoded, alone->connectivity)) << named.name;
    }
  }
}

TEST(Reuse, DamagedMeshesLeaveNothingBehind) {
  Decoder decoder;
  const Result<Encoded> good = encode(shapes::randomTriangulation(300, 7).mesh);
  ASSERT_TRUE(good.ok());
  for (size_t bit = 0; bit < 8 * good->bytes.size(); bit += 3) {
    std::vector<uint8_t> bytes = good->bytes;
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    const Limits limits{1u << 16, 1u << 16, 1u << 18};
    const Result<Connectivity> damaged = decoder.decode(bytes, limits), alone = decode(bytes, limits);
    ASSERT_EQ(damaged.ok(), alone.ok()) << "bit " << bit;
    if (alone.ok()) {
      EXPECT_TRUE(areEqual(*damaged, *alone)) << "bit " << bit;
    }
    const Result<Connectivity> decoded = decoder.decode(good->bytes);
    ASSERT_TRUE(decoded.ok()) << "bit " << bit;
    EXPECT_TRUE(areEqual(*decoded, good->connectivity)) << "bit " << bit;
  }
}

}  // namespace
}  // namespace tutte
