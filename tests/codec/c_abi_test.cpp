// The C interface, used from C (c_abi_client.c), and against the C++ one.

#include "codec/c_abi.h"

#include <gtest/gtest.h>

#include "codec/encode.h"
#include "codec/face_groups.h"
#include "codec/payload.h"
#include "codec/payload_mesh.h"
#include "codec/seams.h"
#include "codec/wedges.h"
#include "tests/codec/c_abi_client.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

std::string told(const char* problem) { return problem ? problem : ""; }

tutte_polygons view(const Polygons& mesh) {
  return {mesh.face_degrees.data(), mesh.corners.data(), mesh.face_degrees.size(), mesh.corners.size(),
          mesh.vertex_count};
}

/// A payload with every section but triangles: a seam around every second wedge, three groups, no attributes' values.
std::vector<uint8_t> payloadOf(const Polygons& mesh, bool with_seams) {
  Result<Encoded> encoded = encode(mesh);
  EXPECT_TRUE(encoded);
  const Connectivity& coded = encoded->connectivity;
  PayloadParts parts;
  parts.counts.vertices = parts.counts.wedges = coded.vertex_count;
  parts.counts.faces = static_cast<Index>(coded.face_degrees.size());
  parts.counts.corners = static_cast<Index>(coded.umbrellas.size());
  for (const Index degree : coded.face_degrees) parts.counts.triangles += degree < 3 ? 0 : degree - 2;
  if (with_seams) {
    std::vector<Index> wedges(coded.umbrellas.size());
    for (Index c = 0; c < wedges.size(); ++c) wedges[c] = c % 2 ? c : coded.vertexOf(c) + parts.counts.corners;
    const Result<PartNumbering> numbering =
        numberParts(verticesOf(coded), coded.vertex_count, wedges, parts.counts.corners + parts.counts.vertices);
    EXPECT_TRUE(numbering);
    parts.counts.wedges = static_cast<Index>(numbering->order.size());
    parts.set(Section::kSeams, encodeSeams(coded, {}, numbering->parts, {}));
  }
  if (parts.counts.faces >= 3) {
    std::vector<Index> groups(parts.counts.faces);
    for (Index f = 0; f < groups.size(); ++f) groups[f] = f % 3;
    parts.counts.groups = 3;
    parts.set(Section::kGroups, encodeGroups(coded, groups, 3));
  }
  parts.set(Section::kConnectivity, std::move(encoded->bytes));
  return writePayload(parts);
}

TEST(CAbi, NumbersAreThoseOfTheCodec) {
  EXPECT_EQ(tutte_abi_version(), TUTTE_ABI_VERSION);
  EXPECT_EQ(TUTTE_TRUNCATED, -static_cast<int>(Error::kTruncated));
  EXPECT_EQ(TUTTE_MALFORMED, -static_cast<int>(Error::kMalformed));
  EXPECT_EQ(TUTTE_UNSUPPORTED_VERSION, -static_cast<int>(Error::kUnsupportedVersion));
  EXPECT_EQ(TUTTE_LIMIT_EXCEEDED, -static_cast<int>(Error::kLimitExceeded));
  EXPECT_EQ(TUTTE_INDEX_OUT_OF_RANGE, -static_cast<int>(Error::kIndexOutOfRange));
  EXPECT_EQ(TUTTE_COUNT_MISMATCH, -static_cast<int>(Error::kCountMismatch));
  EXPECT_EQ(TUTTE_TOO_LARGE, -static_cast<int>(Error::kTooLarge));
  EXPECT_EQ(TUTTE_CHECKSUM, -static_cast<int>(Error::kChecksum));
  EXPECT_EQ(TUTTE_MISSING_SECTION, -static_cast<int>(Error::kMissingSection));
  EXPECT_EQ(TUTTE_TRAILING_BYTES, -static_cast<int>(Error::kTrailingBytes));
  EXPECT_EQ(TUTTE_OUT_OF_MEMORY, -static_cast<int>(Error::kOutOfMemory));
  EXPECT_EQ(TUTTE_ATTRIBUTES, -static_cast<int>(Error::kAttributes));
  EXPECT_EQ(TUTTE_NONE, kNone);
}

TEST(CAbi, RoundTripsInC) {
  for (const shapes::Named& named : shapes::allShapes()) {
    const tutte_polygons polygons = view(named.shape.mesh);
    EXPECT_EQ(told(c_client_round_trip(&polygons, nullptr)), "") << named.name;
    for (int32_t profile = 0; profile < 4; ++profile) {
      const tutte_encode_options options = {profile, 0};
      EXPECT_EQ(told(c_client_round_trip(&polygons, &options)), "") << named.name << ", profile " << profile;
    }
  }
}

TEST(CAbi, ReadsPayloadsInC) {
  for (const shapes::Named& named : shapes::allShapes()) {
    for (const bool with_seams : {false, true}) {
      if (with_seams && named.shape.mesh.corners.empty()) continue;
      const std::vector<uint8_t> payload = payloadOf(named.shape.mesh, with_seams);
      EXPECT_EQ(told(c_client_read_payload(payload.data(), payload.size())), "") << named.name;
    }
  }
}

TEST(CAbi, SurvivesHostileArguments) { EXPECT_EQ(told(c_client_hostile_arguments()), ""); }

TEST(CAbi, DerivedArraysAreThoseOfTheCodec) {
  const std::vector<uint8_t> bytes = payloadOf(shapes::dodecahedron().mesh, true);
  tutte_mesh* mesh = nullptr;
  ASSERT_EQ(tutte_decode_payload(bytes.data(), bytes.size(), nullptr, &mesh), TUTTE_OK);
  const Result<PayloadView> payload = parsePayload(bytes);
  const Result<PayloadMesh, PayloadFailure> decoded = decodePayloadMesh(*payload, {});
  ASSERT_TRUE(decoded);
  const DerivedArray loops = polygonLoops(decoded->arraySource());
  std::vector<Index> read(loops.values.size());
  EXPECT_EQ(tutte_read(mesh, TUTTE_POLYGON_LOOPS, 4, read.data(), read.size()), static_cast<int64_t>(read.size()));
  EXPECT_EQ(read, loops.values);
  std::vector<uint8_t> bytes_read(loops.values.size());
  EXPECT_EQ(tutte_read(mesh, TUTTE_POLYGON_LOOPS, 1, bytes_read.data(), bytes_read.size()),
            static_cast<int64_t>(bytes_read.size()));
  EXPECT_EQ(bytes_read, *packIndices(loops.values, 1));
  size_t offset = 0, length = 0;
  EXPECT_EQ(tutte_find_section(bytes.data(), bytes.size(), 1, &offset, &length), TUTTE_OK);
  EXPECT_EQ(offset, static_cast<size_t>((*payload)[Section::kSeams].data() - bytes.data()));
  EXPECT_EQ(length, (*payload)[Section::kSeams].size());
  EXPECT_EQ(tutte_find_section(bytes.data(), bytes.size(), 5, &offset, &length), TUTTE_NOT_AVAILABLE);
  tutte_free(mesh);
}

TEST(CAbi, LimitsAreCheckedBeforeMemoryIsTaken) {
  const std::vector<uint8_t> bytes = payloadOf(shapes::cube().mesh, false);
  tutte_mesh* mesh = nullptr;
  for (const tutte_limits& limits : {tutte_limits{7, 6, 24}, tutte_limits{8, 5, 24}, tutte_limits{8, 6, 23}}) {
    EXPECT_EQ(tutte_decode_payload(bytes.data(), bytes.size(), &limits, &mesh), TUTTE_LIMIT_EXCEEDED);
    EXPECT_EQ(mesh, nullptr);
  }
  const tutte_limits enough = {8, 6, 24};
  ASSERT_EQ(tutte_decode_payload(bytes.data(), bytes.size(), &enough, &mesh), TUTTE_OK);
  tutte_free(mesh);
}

TEST(CAbi, AMeshThatMemoryCannotHoldIsAnError) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer ends the program where malloc would return null";
#endif
  PayloadParts parts;
  parts.counts.vertices = parts.counts.wedges = parts.counts.faces = 0xFFFFFF00u;
  parts.counts.corners = parts.counts.triangles = 0xFFFFFF00u;
  parts.counts.attributes = kMaxAttributes;
  parts.set(Section::kConnectivity, {0x13});
  parts.set(Section::kAttributes, {0});
  const std::vector<uint8_t> bytes = writePayload(parts);
  const tutte_limits all = {kNone, kNone, kNone};
  tutte_mesh* mesh = nullptr;
  const int32_t status = tutte_decode_payload(bytes.data(), bytes.size(), &all, &mesh);
  // A system that promises memory it does not have lets the decoder see that the counts are lies.
  EXPECT_TRUE(status == TUTTE_OUT_OF_MEMORY || status == TUTTE_COUNT_MISMATCH) << status;
  EXPECT_EQ(mesh, nullptr);
}

TEST(CAbi, DamagedPayloadsAreErrorsOrMeshes) {
  const std::vector<uint8_t> whole = payloadOf(shapes::cube().mesh, true);
  const tutte_limits limits = {1000, 1000, 10000};
  for (size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::vector<uint8_t> bytes = whole;
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    tutte_mesh* mesh = nullptr;
    const int32_t status = tutte_decode_payload(bytes.data(), bytes.size(), &limits, &mesh);
    EXPECT_LT(status, 0) << "bit " << bit;
    EXPECT_EQ(mesh, nullptr);
  }
}

}  // namespace
}  // namespace tutte
