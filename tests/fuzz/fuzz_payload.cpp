// Payloads: any bytes, and any sections with right checksums and counts over a mesh that decodes. In the latter case
// the first chunk is the connectivity section.

#include <algorithm>

#include "codec/arrays.h"
#include "codec/decode.h"
#include "codec/payload.h"
#include "codec/payload_mesh.h"
#include "tests/fuzz/fuzz.h"

using namespace tutte;

namespace {

void demandBelow(const std::vector<Index>& values, uint64_t bound, const char* what) {
  fuzz::demand(std::ranges::all_of(values, [&](Index value) { return value < bound || value == kNone; }), what);
}

void checkArrays(const PayloadMesh& mesh) {
  const ArraySource source = mesh.arraySource();
  const TriangleArray triangles = triangleIndices(source);
  demandBelow(triangles.values, mesh.counts.wedges, "a triangle names no wedge");
  fuzz::demand(triangles.values.size() == size_t{3} * mesh.counts.triangles, "triangles are missing");
  demandBelow(polygonLoops(source).values, mesh.counts.wedges, "a loop names no wedge");
  demandBelow(polygonIndexOffsets(source).values, triangles.values.size() + 1, "an offset is too large");
  demandBelow(polygonLoopOffsets(source).values, uint64_t{2} * mesh.counts.corners + mesh.counts.faces + 1,
              "a loop offset is too large");
  fuzz::demand(ringDegrees(source).values.size() <= mesh.counts.faces, "more rings than faces");
  demandBelow(weldedWedges(source).values, mesh.counts.wedges, "a welded wedge is none");
}

void check(std::span<const uint8_t> bytes) {
  const Result<PayloadView> payload = parsePayload(bytes);
  if (!payload) return;
  const Result<PayloadMesh, PayloadFailure> mesh = decodePayloadMesh(*payload, fuzz::kLimits);
  if (!mesh) return;
  fuzz::demand(isValid(mesh->connectivity));
  checkArrays(*mesh);
}

// The counts that the connectivity implies; those of the other sections are the input's.
void forge(fuzz::Input input) {
  PayloadParts parts;
  const uint8_t sections = input.byte();
  const uint8_t wedges = input.byte(), triangles = input.byte(), groups = input.byte(), attributes = input.byte();
  const auto connectivity = input.chunk();
  const Result<Connectivity> mesh = decode(connectivity, fuzz::kLimits);
  if (!mesh) return;
  parts.set(Section::kConnectivity, {connectivity.begin(), connectivity.end()});
  for (const Section section : {Section::kSeams, Section::kGroups, Section::kRings, Section::kTriangulation}) {
    const auto bytes = input.chunk();
    if (sections >> static_cast<int>(section) & 1) parts.set(section, {bytes.begin(), bytes.end()});
  }
  PayloadCounts& counts = parts.counts;
  counts.vertices = counts.wedges = mesh->vertex_count;
  if (sections & 2) counts.wedges += wedges;
  if (sections & 2 && sections & 64 && wedges > 0) counts.vertices += counts.welded = 1 + triangles % wedges;
  counts.faces = static_cast<Index>(mesh->face_degrees.size());
  counts.corners = static_cast<Index>(mesh->umbrellas.size());
  for (const Index degree : mesh->face_degrees) counts.triangles += degree < 3 ? 0 : degree - 2;
  counts.triangles =
      static_cast<Index>(std::max<int64_t>(0, int64_t{counts.triangles} + static_cast<int8_t>(triangles)));
  if (sections & 4) counts.groups += groups;
  if (attributes > 0) {
    counts.attributes = attributes % 16;
    if (counts.attributes > 0) parts.set(Section::kAttributes, {0});
  }
  check(writePayload(parts));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Input input(data, size);
  if (input.byte() % 4 == 0) {
    check(input.rest());
  } else {
    forge(input);
  }
  return 0;
}
