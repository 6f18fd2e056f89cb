// The account of a section's bits: complete, and each topic only where there is something to say about it.

#include "codec/spending.h"

#include <gtest/gtest.h>

#include "codec/decode.h"
#include "codec/encode.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

constexpr std::array kProfiles = {Profile::kPaper, Profile::kFast, Profile::kDefault, Profile::kSmall};

std::vector<uint8_t> encoded(const shapes::Shape& shape, Profile profile) {
  const Result<Encoded> result = encode(shape.mesh, {.profile = profile, .effort = 0});
  EXPECT_TRUE(result);
  return result ? result->bytes : std::vector<uint8_t>();
}

Spending spending(const shapes::Shape& shape, Profile profile = Profile::kDefault) {
  const Result<Spending> result = spendingOf(encoded(shape, profile));
  EXPECT_TRUE(result);
  return result ? *result : Spending();
}

TEST(Spending, AccountsForEveryBit) {
  for (const Profile profile : kProfiles) {
    for (const auto& [name, shape] : shapes::allShapes()) {
      SCOPED_TRACE(name);
      const std::vector<uint8_t> bytes = encoded(shape, profile);
      const Result<Spending> spending = spendingOf(bytes);
      ASSERT_TRUE(spending);
      double sum = spending->head_bits + spending->end_bits;
      for (const TopicBits& topic : spending->topics) {
        EXPECT_GE(topic.bits, -1e-6);
        sum += topic.bits;
      }
      EXPECT_NEAR(sum, 8.0 * static_cast<double>(bytes.size()), 1e-6);
      // The symbols end at a whole byte; their last word loses its zeros.
      EXPECT_LE(spending->end_bits, 16);
      EXPECT_GE(spending->end_bits, -32);
    }
  }
}

TEST(Spending, TopicsThatAMeshHasNot) {
  for (const Profile profile : kProfiles) {
    const Spending torus = spending(shapes::triangleTorus(20, 20), profile);
    EXPECT_EQ(torus[Topic::kDegrees].decisions, 0u);
    EXPECT_EQ(torus[Topic::kHoles].decisions, 0u);
    EXPECT_EQ(torus[Topic::kJoins].decisions, 0u);
    EXPECT_EQ(torus[Topic::kCopies].decisions, 0u);
    EXPECT_GE(torus[Topic::kValences].decisions, 400u);
    EXPECT_GT(torus[Topic::kSplits].bits, 0);
    EXPECT_EQ(torus[Topic::kComponents].decisions, 2u);
    EXPECT_EQ(spending(shapes::cube(), profile)[Topic::kSplits].decisions, 0u);
  }
}

TEST(Spending, TopicsThatAMeshHas) {
  const Spending perforated = spending(shapes::perforatedGrid(9, 9));
  EXPECT_GT(perforated[Topic::kHoles].bits, 81);  // at least whether there is a hole, here and there
  EXPECT_EQ(perforated[Topic::kDegrees].decisions, 0u);
  EXPECT_GT(spending(shapes::pyramid(7))[Topic::kDegrees].decisions, 0u);
  EXPECT_GT(spending(shapes::copies(shapes::cube(), 50))[Topic::kCopies].decisions, 0u);
  EXPECT_GT(spending(shapes::bowTie(30))[Topic::kJoins].bits, 30);
  EXPECT_GT(spending(shapes::moebiusStrip(40))[Topic::kJoins].decisions, 0u);
  EXPECT_GT(spending(shapes::smallFaces())[Topic::kStrays].decisions, 1u);
  EXPECT_GT(spending(shapes::isolatedVertices())[Topic::kIsolated].bits, 1);
}

TEST(Spending, CopiesAreNotCountedTwice) {
  const shapes::Shape one = shapes::perforatedGrid(4, 4);
  const Spending once = spending(one), often = spending(shapes::copies(one, 20));
  for (const Topic topic : {Topic::kValences, Topic::kHoles, Topic::kSplits}) {
    EXPECT_EQ(once[topic].decisions, often[topic].decisions) << nameOf(topic);
    EXPECT_NEAR(once[topic].bits, often[topic].bits, 1e-6) << nameOf(topic);
  }
}

TEST(Spending, ErrorsAreTheDecoders) {
  const std::vector<uint8_t> bytes = encoded(shapes::sponge(2), Profile::kSmall);
  for (size_t length = 0; length < bytes.size(); ++length) {
    const std::span<const uint8_t> prefix(bytes.data(), length);
    const Result<Connectivity> mesh = decode(prefix);
    const Result<Spending> spending = spendingOf(prefix);
    ASSERT_EQ(mesh.ok(), spending.ok()) << length;
    if (!mesh) {
      EXPECT_EQ(mesh.error(), spending.error()) << length;
    }
  }
}

}  // namespace
}  // namespace tutte
