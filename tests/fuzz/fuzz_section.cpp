// Any bytes as a connectivity section: an error, or a valid mesh that encodes and decodes to itself.

#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/trace.h"
#include "tests/fuzz/fuzz.h"

using namespace tutte;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const Result<Connectivity> decoded = decode({data, size}, fuzz::kLimits);
  const Error traced = trace({data, size}, fuzz::kLimits, [](const TraceEvent&) {});
  fuzz::demand(traced == (decoded ? Error::kNone : decoded.error()), "the trace ends otherwise than the decoder");
  if (!decoded) return 0;
  fuzz::demand(isValid(*decoded));
  fuzz::demand(decoded->vertex_count <= fuzz::kLimits.max_vertices, "more vertices than allowed");
  fuzz::demand(decoded->umbrellas.size() <= fuzz::kLimits.max_corners, "more corners than allowed");
  fuzz::demand(decoded->face_degrees.size() <= fuzz::kLimits.max_faces, "more faces than allowed");

  const Polygons polygons = polygonsOf(*decoded);
  const Result<Encoded> encoded = encode(polygons, {static_cast<Profile>(size % 4), 0});
  fuzz::demand(encoded.ok(), "a decoded mesh cannot be encoded");
  const Result<Connectivity> again = decode(encoded->bytes);
  fuzz::demand(again.ok(), "an encoded mesh cannot be decoded");
  fuzz::demand(areEqual(*again, encoded->connectivity));
  fuzz::demand(isSameMesh(*encoded, *again, polygons));
  return 0;
}
