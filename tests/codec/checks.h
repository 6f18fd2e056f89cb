#pragma once
// What every decoded mesh must satisfy, and what a round trip must give back.

#include <gtest/gtest.h>

#include <span>

#include "codec/encode.h"
#include "codec/mesh.h"

namespace tutte {

/// The rules of Connectivity's declaration, checked without any help of the codec.
testing::AssertionResult isValid(const Connectivity& mesh);

/// Every edge that belongs to exactly two faces is linked, and nothing is cut or flipped.
testing::AssertionResult isUncut(const Connectivity& mesh, PolygonView input);

testing::AssertionResult areEqual(const Connectivity& a, const Connectivity& b);

/// The decoded mesh, mapped back through the encoder's orders, is the input: the same faces as cycles, in the same
/// orientation, over the same vertices.
testing::AssertionResult isSameMesh(const Encoded& encoded, const Connectivity& decoded, PolygonView input);

/// Encodes, decodes and checks all of the above but isUncut.
testing::AssertionResult roundTrips(PolygonView input, const EncodeOptions& options = {});

/// Decoding a copy in an allocation of exactly the right size gives an error or a valid mesh.
testing::AssertionResult isHarmless(std::span<const uint8_t> bytes);

}  // namespace tutte
