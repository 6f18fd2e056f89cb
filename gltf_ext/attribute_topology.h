#pragma once
// From decoded seams to what attribute coders ask for.

#include "codec/seams.h"
#include "gltf_ext/attributes.h"

namespace tutte {

/// A view: `connectivity` and `seams` must outlive it.
inline AttributeTopology attributeTopology(const Connectivity& connectivity, const Seams& seams) {
  AttributeTopology topology{connectivity, seams.wedges, seams.wedge_count, {}};
  topology.seams.assign(seams.attribute_seams.begin(), seams.attribute_seams.end());
  return topology;
}

}  // namespace tutte
