#pragma once
// The encoder's choices. The decoder pays nothing for them.

#include "codec/candidate.h"
#include "codec/encode.h"

namespace tutte {

/// The smallest walk that `options.effort` allows to find: order of the queue, dual, matching, seeds of components.
Result<WalkedCandidate> searchCandidates(TopologyPair& topologies, const EncodeOptions& options, EncoderMemory& memory);

}  // namespace tutte
