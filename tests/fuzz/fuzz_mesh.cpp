// Any bytes as a polygon soup: it must come back exactly. The first byte chooses how to encode, the second is the
// number of vertices; then, per face, a degree and its corners.

#include <vector>

#include "tests/fuzz/fuzz.h"

using namespace tutte;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Input input(data, size);
  const uint8_t choice = input.byte();
  Polygons soup;
  soup.vertex_count = input.byte();
  while (soup.vertex_count > 0 && !input.rest().empty()) {
    const Index degree = input.byte() % 9;
    soup.face_degrees.push_back(degree);
    for (Index i = 0; i < degree; ++i) soup.corners.push_back(input.byte() % soup.vertex_count);
  }
  fuzz::demand(roundTrips(soup, {static_cast<Profile>(choice % 4), choice / 4 % 2}));
  return 0;
}
