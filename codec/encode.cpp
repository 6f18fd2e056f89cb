#include "codec/encode.h"

#include "codec/candidate.h"
#include "codec/search.h"

namespace tutte {

Result<Encoded> encode(PolygonView mesh, const EncodeOptions& options) noexcept {
  Result<Topology> topology = buildTopology(mesh);
  if (!topology) return topology.error();
  TopologyPair topologies(std::move(*topology));
  Result<WalkedCandidate> walked = searchCandidates(topologies, options);
  if (!walked) return walked.error();
  return finishCandidate(topologies, std::move(*walked), mesh);
}

}  // namespace tutte
