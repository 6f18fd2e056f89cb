#include "tests/theory/measure.h"

#include <cstdio>
#include <cstdlib>

#include "codec/decode.h"
#include "codec/spending.h"

namespace tutte::theory {

Coded code(PolygonView mesh, Profile profile, int effort) {
  const Result<Encoded> encoded = encode(mesh, {.profile = profile, .effort = effort});
  const Result<Connectivity> decoded = encoded ? decode(encoded->bytes) : Result<Connectivity>(encoded.error());
  const bool back = decoded && decoded->umbrellas == encoded->connectivity.umbrellas &&
                    decoded->face_degrees == encoded->connectivity.face_degrees;
  const Result<Spending> spending = back ? spendingOf(encoded->bytes) : Result<Spending>(Error::kMalformed);
  if (!spending) {
    std::fprintf(stderr, "theory: a mesh does not come back\n");
    std::exit(1);
  }
  return {encoded->bytes.size(), encoded->splits, (*spending)[Topic::kSplits].bits};
}

AllCoded codeAll(PolygonView mesh, int effort) {
  AllCoded all;
  for (int i = 0; i < kProfileCount; ++i) all[static_cast<size_t>(i)] = code(mesh, static_cast<Profile>(i), effort);
  return all;
}

}  // namespace tutte::theory
