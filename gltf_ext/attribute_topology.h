#pragma once
// From decoded seams to what attribute coders ask for.

#include "codec/seams.h"
#include "gltf_ext/attributes.h"

namespace tutte {

/// A view: `connectivity` and `seams` must outlive it; they must be an encoder's or a decoder's.
inline AttributeTopology attributeTopology(const Connectivity& connectivity, const Seams& seams) {
  const std::vector<Index>& wedges = seams.wedges.empty() ? connectivity.umbrellas : seams.wedges;
  AttributeTopology topology{connectivity, wedges,           seams.wedge_count,     {},
                             true,         seams.ways.get(), seams.parted_umbrellas};
  topology.seams.assign(seams.attribute_seams.begin(), seams.attribute_seams.end());
  return topology;
}

}  // namespace tutte
