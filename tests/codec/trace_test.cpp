// What the trace tells must be enough to say what the mesh is, and its errors must be the decoder's.

#include "codec/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "codec/decode.h"
#include "codec/encode.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using Kind = TraceEvent::Kind;

std::vector<TraceEvent> eventsOf(std::span<const uint8_t> bytes, Error* error = nullptr) {
  std::vector<TraceEvent> events;
  const Error result = trace(bytes, {}, [&](const TraceEvent& event) { events.push_back(event); });
  if (error) *error = result;
  return events;
}

TEST(Trace, Tetrahedron) {
  const Result<Encoded> encoded = encode(shapes::tetrahedron().mesh);
  ASSERT_TRUE(encoded);
  const std::vector<TraceEvent> events = eventsOf(encoded->bytes);
  const std::vector<Kind> kinds = {Kind::kComponent, Kind::kFace,   Kind::kVertex, Kind::kVertex, Kind::kVertex,
                                   Kind::kFace,      Kind::kVertex, Kind::kFace,   Kind::kFace,   Kind::kEnd};
  ASSERT_EQ(events.size(), kinds.size());
  for (size_t i = 0; i < kinds.size(); ++i) EXPECT_EQ(events[i].kind, kinds[i]) << i;
  EXPECT_TRUE(events[1].seed);
  EXPECT_EQ(events[4].missing, 1u);
  EXPECT_EQ(events[4].known_vertices, 2u);
  EXPECT_EQ(events[4].valence_sum, 6u);
  EXPECT_EQ(events[5].degree_behind, 3u);
  EXPECT_EQ(events[6].umbrella, 3u);
  EXPECT_EQ(events[6].face, 1u);
  EXPECT_EQ(events[7].known_edges, 2u);
  EXPECT_TRUE(events[8].closed);
  EXPECT_EQ(events[9].component, 1u);
}

TEST(Trace, AgreesWithTheMesh) {
  for (const shapes::Named& named : shapes::allShapes()) {
    const Result<Encoded> encoded = encode(named.shape.mesh, {.profile = {}, .effort = 0});  // never the dual
    ASSERT_TRUE(encoded) << named.name;
    const Connectivity& mesh = encoded->connectivity;
    std::vector<Index> degrees;
    Index umbrellas = 0, splits = 0;
    for (const TraceEvent& event : eventsOf(encoded->bytes)) {
      ASSERT_EQ(event.umbrella, umbrellas) << named.name;
      if (event.kind == Kind::kFace && !event.dummy) {
        ASSERT_EQ(event.face, degrees.size()) << named.name;
        degrees.push_back(event.degree);
      }
      umbrellas += event.kind == Kind::kVertex;
      splits += event.kind == Kind::kSplit;
    }
    ASSERT_LE(degrees.size(), mesh.face_degrees.size()) << named.name;
    EXPECT_TRUE(std::equal(degrees.begin(), degrees.end(), mesh.face_degrees.begin())) << named.name;
    EXPECT_LE(umbrellas, mesh.umbrella_count) << named.name;
    EXPECT_EQ(splits, encoded->splits) << named.name;
  }
}

TEST(Trace, HasTheDecodersErrors) {
  const Result<Encoded> encoded = encode(shapes::cube().mesh);
  ASSERT_TRUE(encoded);
  for (size_t bit = 0; bit < 8 * encoded->bytes.size(); ++bit) {
    std::vector<uint8_t> bytes = encoded->bytes;
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    Error error = Error::kNone;
    eventsOf(bytes, &error);
    const Result<Connectivity> decoded = decode(bytes);
    EXPECT_EQ(error, decoded ? Error::kNone : decoded.error()) << bit;
  }
}

}  // namespace
}  // namespace tutte
