#pragma once
// Whether pack() and unpack() keep what they must.

#include "gltf_ext/pack.h"

namespace tutte {

/// Expects the decoded mesh, read through the orders that pack() reports, to be the input.
void expectSame(const PolygonMesh& in, const Packed& packed, const PolygonMesh& out);

/// The same of the mesh that pack() and unpack() make of it; attributes must be coded without loss.
void expectRoundTrip(const PolygonMesh& mesh, const PackOptions& options = {});

}  // namespace tutte
