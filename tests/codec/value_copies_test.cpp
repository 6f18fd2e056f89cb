// Values of components that repeat others: predicted from the original, however the copy lies in space.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "codec/bytes.h"
#include "codec/encode.h"
#include "codec/values.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using Point = std::array<double, 3>;

/// Equal components, one placed by each of the motions, with positions of 16 bits.
class Placed {
 public:
  Placed(const shapes::Shape& part, std::span<const std::function<Point(Point)>> motions)
      : encoded_(*encode(shapes::copies(part, static_cast<Index>(motions.size())).mesh)),
        graph_(encoded_.connectivity, encoded_.connectivity.umbrellas, encoded_.connectivity.vertex_count) {
    shapes::Random random(7);
    std::vector<Point> points;
    for (Index v = 0; v < part.mesh.vertex_count; ++v) {
      points.push_back({double(random.below(4000)), double(random.below(4000)), double(random.below(4000))});
    }
    for (const Index vertex : encoded_.vertex_order) {
      const Point placed = motions[vertex / part.mesh.vertex_count](points[vertex % part.mesh.vertex_count]);
      for (const double x : placed) values_.push_back(static_cast<int32_t>(std::lround(x)) + 30000);
    }
  }

  /// The coded size; what decodes must be the same.
  size_t size(ValueProfile profile, ValueKind kind, bool copies) const {
    const ValueFormat format{3, 65535, profile, kind, false, false, copies};
    ByteWriter out;
    EXPECT_TRUE(encodeValues({graph_, {}}, format, values_, out));
    const Result<std::vector<int32_t>> decoded = decodeValues({graph_, {}}, format, out.bytes());
    EXPECT_TRUE(decoded && *decoded == values_);
    return out.bytes().size();
  }

  const Connectivity& connectivity() const { return encoded_.connectivity; }
  const ValueGraph& graph() const { return graph_; }
  const std::vector<int32_t>& values() const { return values_; }

 private:
  const Encoded encoded_;
  const ValueGraph graph_;
  std::vector<int32_t> values_;
};

Point moved(Point p) { return {p[0] + 9000, p[1] - 20, p[2] + 77}; }
Point turned(Point p) { return {0.6 * p[0] - 0.8 * p[1] + 5000, 0.8 * p[0] + 0.6 * p[1], p[2] - 9000}; }
Point mirrored(Point p) { return {-p[0], p[1], p[2]}; }
Point stretched(Point p) { return {2 * p[0], 1.5 * p[1] + 0.3 * p[2], 0.7 * p[2]}; }

constexpr ValueProfile kProfiles[] = {ValueProfile::kFast, ValueProfile::kDefault, ValueProfile::kSmall};
const shapes::Shape kPart = shapes::randomTriangulation(300, 1);

TEST(ValueCopies, AreNamedByTheirCorners) {
  const Placed placed(kPart, std::array<std::function<Point(Point)>, 3>{std::identity(), moved, turned});
  ASSERT_EQ(placed.connectivity().copies.size(), 2u);
  const Index corners = static_cast<Index>(kPart.mesh.corners.size());
  for (Index i = 0; i < 2; ++i) {
    const ComponentCopy& copy = placed.connectivity().copies[i];
    EXPECT_EQ(copy.original, 0u);
    EXPECT_EQ(copy.corner, corners * (i + 1));
    EXPECT_EQ(copy.count, corners);
  }
}

TEST(ValueCopies, AreNamedInDualsToo) {
  // Vertices of valence 3 and faces of many degrees: the dual takes fewer bytes.
  const shapes::Shape part = shapes::dual(shapes::randomTriangulation(120, 2));
  const Result<Encoded> encoded = encode(shapes::copies(part, 3).mesh, {.profile = Profile::kDefault, .effort = 1});
  ASSERT_TRUE(encoded);
  ASSERT_NE(encoded->bytes[1] & 0x40, 0) << "the walk is over the dual";
  const Connectivity& mesh = encoded->connectivity;
  ASSERT_EQ(mesh.copies.size(), 2u);
  for (const ComponentCopy& copy : mesh.copies) {
    EXPECT_EQ(copy.count, part.mesh.corners.size());
    const Index umbrella = mesh.umbrellas[copy.corner], original = mesh.umbrellas[copy.original];
    for (Index i = 0; i < copy.count; ++i) {
      EXPECT_EQ(mesh.umbrellas[copy.corner + i] - umbrella, mesh.umbrellas[copy.original + i] - original);
    }
  }
}

TEST(ValueCopies, MovedOnesAreNearlyFree) {
  const std::array<std::function<Point(Point)>, 4> motions{std::identity(), moved, std::identity(), moved};
  const Placed one(kPart, std::span(motions).first(1)), four(kPart, motions);
  for (const ValueProfile profile : kProfiles) {
    for (const ValueKind kind : {ValueKind::kPoints, ValueKind::kPlain}) {
      EXPECT_LT(four.size(profile, kind, true), one.size(profile, kind, false) * 11 / 10);
      EXPECT_GT(four.size(profile, kind, false), one.size(profile, kind, false) * 3);
    }
  }
}

TEST(ValueCopies, TurnedMirroredAndStretchedOnesAreCheap) {
  const std::array<std::function<Point(Point)>, 4> motions{std::identity(), turned, mirrored, stretched};
  const Placed one(kPart, std::span(motions).first(1)), four(kPart, motions);
  for (const ValueProfile profile : kProfiles) {
    EXPECT_LT(four.size(profile, ValueKind::kPoints, true), one.size(profile, ValueKind::kPoints, false) * 9 / 5);
  }
}

TEST(ValueCopies, ExtremesStayInTheirRange) {
  // Corners of the largest cube, so that every product of the motion is as large as it can be.
  Placed placed(shapes::cube(), std::array<std::function<Point(Point)>, 3>{std::identity(), moved, turned});
  shapes::Random random(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<int32_t> values;
    for (size_t i = 0; i < placed.values().size(); ++i) values.push_back(random.below(2) * ((1 << 20) - 1));
    const ValueFormat format{3, (1 << 20) - 1, ValueProfile::kDefault, ValueKind::kPoints, false, false, true};
    ByteWriter out;
    ASSERT_TRUE(encodeValues({placed.graph(), {}}, format, values, out));
    const Result<std::vector<int32_t>> decoded = decodeValues({placed.graph(), {}}, format, out.bytes());
    ASSERT_TRUE(decoded);
    ASSERT_EQ(*decoded, values);
  }
}

TEST(ValueCopies, HostileBytesGiveErrorsOrValuesInRange) {
  const Placed placed(shapes::triangleTorus(5, 4),
                      std::array<std::function<Point(Point)>, 3>{std::identity(), turned, stretched});
  const ValueFormat format{3, 65535, ValueProfile::kDefault, ValueKind::kPoints, false, false, true};
  ByteWriter out;
  ASSERT_TRUE(encodeValues({placed.graph(), {}}, format, placed.values(), out));
  std::vector<uint8_t> bytes(out.bytes().begin(), out.bytes().end());
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    const Result<std::vector<int32_t>> decoded = decodeValues({placed.graph(), {}}, format, bytes);
    if (decoded) {
      for (const int32_t value : *decoded) ASSERT_TRUE(value >= 0 && value <= 65535);
    }
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
  }
}

}  // namespace
}  // namespace tutte
