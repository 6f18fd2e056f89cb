// Damaged attribute sections: every prefix, flips and mutations give a Failure or whole attributes, and take no more
// memory than the mesh accounts for.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "gltf_ext/draco_planes.h"
#include "tests/gltf/coded_mesh.h"

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;

float wave(Index wedge, int c) { return static_cast<float>(std::sin(0.05 * wedge + c)); }

class HostileAttributes : public testing::TestWithParam<AttributeCoder> {
 protected:
  HostileAttributes()
      : shape_(shapes::mergeFaces(shapes::randomTriangulation(24, 1), 8, 2)), mesh_(codeMesh(shape_, true)) {
    const Index count = mesh_.wedgeCount();
    attributes_.push_back(positionsOf(mesh_, shape_));
    attributes_.push_back(makeFloats("NORMAL", 3, count, [](Index w, int c) {
      return static_cast<float>(c == 2 ? 0 : c == 0 ? std::cos(0.3 * w) : std::sin(0.3 * w));
    }));
    attributes_.push_back(makeFloats("TEXCOORD_0", 2, count, wave));
    attributes_.push_back(makeFloats("TANGENT", 4, count, [](Index w, int c) {
      return c == 3 ? (w % 3 ? 1.f : -1.f) : c == 2 ? 1.f : 0.f;
    }));
    attributes_.push_back(makeAttribute<uint8_t>("JOINTS_0", ComponentType::kUint8, 4, count,
                                                 [](Index w, int c) { return static_cast<uint8_t>(w / 8 + c); }));
    attributes_.push_back(makeFloats("WEIGHTS_0", 4, count, [](Index w, int c) { return 1.0 / (w + c + 1); }));
    attributes_.push_back(makeFloats("_FEW", 2, count, [](Index w, int c) { return 0.1234567 * (w % (2 + c)); }));
    attributes_.push_back(makeFloats("POSITION@0", 3, count, [](Index w, int c) { return 0.01 * std::sin(w + c); }));
    attributes_.push_back(makeFloats("_IDS@1", 1, count, [](Index w, int) { return static_cast<float>(w % 7); }));
  }

  Bytes section() {
    PackOptions options;
    options.attribute_coder = GetParam();
    options.generic_bits = 0;
    options.grid = PositionGrid{{-0.5f, 0, 0.25f}, 0.002f};
    auto bytes = encodeAttributes(mesh_.topology(attributes_), attributes_, options);
    EXPECT_TRUE(bytes.ok());
    return *std::move(bytes);
  }

  /// True when the bytes were refused; otherwise what they decode to must be whole.
  bool refused(const AttributeTopology& topology, const Bytes& bytes) {
    const auto decoded = decodeAttributes(topology, bytes);
    if (!decoded) return true;
    for (const Attribute& attribute : *decoded) {
      EXPECT_EQ(attribute.data.size(), size_t{topology.wedge_count} * attribute.stride());
    }
    return false;
  }

  shapes::Shape shape_;
  CodedMesh mesh_;
  std::vector<Attribute> attributes_;
};

TEST_P(HostileAttributes, EveryPrefixIsRefused) {
  const Bytes bytes = section();
  const AttributeTopology topology = mesh_.topology(attributes_);
  for (size_t size = 0; size < bytes.size(); ++size) {
    const Bytes prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_TRUE(refused(topology, prefix)) << size;
  }
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_TRUE(refused(topology, longer));
}

TEST_P(HostileAttributes, EveryFlippedBitIsSurvived) {
  Bytes bytes = section();
  const AttributeTopology topology = mesh_.topology(attributes_);
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    refused(topology, bytes);
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
  }
}

TEST_P(HostileAttributes, MutationsAreSurvived) {
  const Bytes original = section();
  const AttributeTopology topology = mesh_.topology(attributes_);
  shapes::Random random(3);
  for (int round = 0; round < 3000; ++round) {
    Bytes bytes = original;
    for (Index i = random.below(6) + 1; i > 0; --i) {
      bytes[random.below(static_cast<Index>(bytes.size()))] =
          static_cast<uint8_t>(random.below(4) ? random.next() : 0xFF);
    }
    refused(topology, bytes);
  }
}

TEST_P(HostileAttributes, AnotherMeshsSectionIsSurvived) {
  const Bytes bytes = section();
  for (const auto& [name, shape] : shapes::dirtyShapes()) {
    SCOPED_TRACE(name);
    CodedMesh other = codeMesh(shape);
    refused(other.topology({}), bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(Coders, HostileAttributes, testing::Values(AttributeCoder::kDraco, AttributeCoder::kTutte));

TEST(HostilePlanes, RandomBytesTakeLittleMemory) {
  CodedMesh mesh = codeMesh(shapes::mergeFaces(shapes::randomTriangulation(24, 1), 8, 2), true);
  const AttributeTopology topology = mesh.topology({});
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  shapes::Random random(4);
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes(random.below(100) + 1);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.below(3) ? random.below(4) : random.next());
    for (const PlaneKind kind : {PlaneKind::kPosition, PlaneKind::kDirection, PlaneKind::kLabel}) {
      Plane plane;
      plane.kind = kind;
      plane.components = plane.octahedral() ? 2 : 3;
      plane.max = 1022;
      decodePlanes(topology, bytes, {&plane, 1});
    }
  }
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 400 * 1024) << "kilobytes";
}

}  // namespace
}  // namespace tutte
