#pragma once
// Attributes there and back: what they decode to, how far that may be from what they were, and values to try.

#include <array>
#include <vector>

#include "gltf_ext/attributes.h"
#include "tests/gltf/coded_mesh.h"

namespace tutte {

/// So many bits for every attribute.
PackOptions bitsOf(int bits);

/// Every attribute is kept to the bit.
PackOptions losslessPacking();

/// What attributes decode to; no matter who codes them, it is the same.
std::vector<Attribute> roundTrip(CodedMesh& mesh, const std::vector<Attribute>& attributes, PackOptions options = {});

/// Half a step of the grid that the values span, and what rounding to float adds.
double quantisationBound(const Attribute& attribute, int bits);

/// The largest difference between components of two float attributes.
double largestError(const Attribute& a, const Attribute& b);

/// A unit vector, different for every wedge.
std::array<float, 3> direction(Index wedge);

/// A smooth value for a component of a wedge.
float wave(Index wedge, int c);

}  // namespace tutte
