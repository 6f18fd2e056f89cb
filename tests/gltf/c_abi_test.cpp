// The C interface to attributes, used from C (c_abi_client.c), and against unpack().

#include "gltf_ext/c_abi.h"

#include <gtest/gtest.h>

#include "gltf_ext/pack.h"
#include "tests/gltf/c_abi_client.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

std::string told(const char* problem) { return problem ? problem : ""; }

template <class T>
Attribute invented(std::string name, uint8_t components, ComponentType type, Index count, bool normalized = false) {
  Attribute result{std::move(name), components, type, normalized, {}};
  std::vector<T> values;
  for (Index i = 0; i < count * components; ++i) values.push_back(static_cast<T>(i * 7 % 101));
  const auto* const bytes = reinterpret_cast<const uint8_t*>(values.data());
  result.data.assign(bytes, bytes + values.size() * sizeof(T));
  return result;
}

PolygonMesh decorated(const shapes::Shape& shape) {
  PolygonMesh mesh;
  mesh.polygons = shape.mesh;
  mesh.wedge_count = shape.mesh.vertex_count;
  const Index count = mesh.wedge_count;
  mesh.attributes = {invented<float>("POSITION", 3, ComponentType::kFloat, count),
                     invented<uint8_t>("COLOR_0", 3, ComponentType::kUint8, count, true),
                     invented<uint16_t>("JOINTS_0", 4, ComponentType::kUint16, count),
                     invented<float>("POSITION@2", 3, ComponentType::kFloat, count)};
  return mesh;
}

std::vector<uint8_t> payloadOf(const PolygonMesh& mesh, AttributeCoder coder) {
  PackOptions options;
  options.attribute_coder = coder;
  Outcome<Packed> packed = pack(mesh, options);
  EXPECT_TRUE(packed);
  return packed ? std::move(packed->bytes) : std::vector<uint8_t>();
}

TEST(CAbiAttributes, AreThoseOfUnpack) {
  for (const AttributeCoder coder : {AttributeCoder::kDraco, AttributeCoder::kTutte}) {
    for (const auto& shape : {shapes::cube(), shapes::dodecahedron(), shapes::quadGrid(5, 7)}) {
      const std::vector<uint8_t> payload = payloadOf(decorated(shape), coder);
      const Outcome<PolygonMesh> mesh = unpack(payload);
      ASSERT_TRUE(mesh);
      std::vector<expected_attribute> expected;
      for (const Attribute& attribute : mesh->attributes) {
        expected.push_back({attribute.name.c_str(), attribute.components, static_cast<uint32_t>(attribute.type),
                            attribute.normalized, attribute.data.data(), attribute.stride()});
      }
      ASSERT_EQ(expected.size(), 4u);
      EXPECT_EQ(told(c_client_read_attributes(payload.data(), payload.size(), expected.data(), 4)), "");
    }
  }
}

TEST(CAbiAttributes, APayloadMayHaveNone) {
  PolygonMesh mesh;
  mesh.polygons = shapes::cube().mesh;
  mesh.wedge_count = mesh.polygons.vertex_count;
  const std::vector<uint8_t> payload = payloadOf(mesh, AttributeCoder::kAuto);
  EXPECT_EQ(told(c_client_read_attributes(payload.data(), payload.size(), nullptr, 0)), "");
}

TEST(CAbiAttributes, SurviveHostileArguments) {
  const std::vector<uint8_t> payload = payloadOf(decorated(shapes::cube()), AttributeCoder::kTutte);
  EXPECT_EQ(told(c_client_hostile_attributes(payload.data(), payload.size())), "");
}

TEST(CAbiAttributes, TheMeshMustBeThePayloads) {
  const std::vector<uint8_t> cube = payloadOf(decorated(shapes::cube()), AttributeCoder::kTutte);
  const std::vector<uint8_t> other = payloadOf(decorated(shapes::dodecahedron()), AttributeCoder::kTutte);
  tutte_mesh* mesh = nullptr;
  tutte_attributes* attributes = nullptr;
  ASSERT_EQ(tutte_decode_payload(cube.data(), cube.size(), nullptr, &mesh), TUTTE_OK);
  EXPECT_EQ(tutte_decode_attributes(mesh, other.data(), other.size(), &attributes), TUTTE_COUNT_MISMATCH);
  EXPECT_EQ(attributes, nullptr);
  tutte_free(mesh);
}

}  // namespace
}  // namespace tutte
