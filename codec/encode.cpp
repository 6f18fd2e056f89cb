#include "codec/encode.h"

#include "codec/candidate.h"
#include "codec/encoder_memory.h"
#include "codec/search.h"

namespace tutte {

Encoder::Encoder() : memory_(std::make_unique<EncoderMemory>()) {}
Encoder::~Encoder() = default;
Encoder::Encoder(Encoder&&) noexcept = default;
Encoder& Encoder::operator=(Encoder&&) noexcept = default;

Result<Encoded> Encoder::encode(PolygonView mesh, const EncodeOptions& options) noexcept {
  Result<Topology> topology = buildTopology(mesh);
  if (!topology) return topology.error();
  TopologyPair topologies(std::move(*topology));
  Result<WalkedCandidate> walked = searchCandidates(topologies, options, *memory_);
  if (!walked) return walked.error();
  return finishCandidate(topologies, std::move(*walked), mesh);
}

Result<Encoded> encode(PolygonView mesh, const EncodeOptions& options) noexcept {
  return Encoder().encode(mesh, options);
}

}  // namespace tutte
