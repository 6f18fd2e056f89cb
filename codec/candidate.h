#pragma once
// One way to code a topology: what the encoder's search tries, and what becomes of the best.

#include <memory>
#include <vector>

#include "codec/components.h"
#include "codec/copy_order.h"
#include "codec/dual.h"
#include "codec/encode.h"
#include "codec/range_coder.h"
#include "codec/section.h"
#include "codec/topology.h"

namespace tutte {

/// All that a choice of the encoder consists of.
struct Candidate {
  SectionHeader header;
  std::vector<ComponentPlan> components;
};

/// A candidate's walk: its symbols, and which part of the topology came when.
struct WalkedCandidate {
  SectionHeader header;
  Connectivity connectivity;  ///< of the walked topology: in a dual, the dual's
  WalkOrder order;
  std::vector<ComponentPlan> components;
  std::vector<uint8_t> on_boundary;
  std::vector<Index> dummy_umbrellas;
  RangeWriter symbols;  ///< still open: repairs follow
  Index splits = 0;

  size_t bits() const { return symbols.bits(); }
};

/// The topology and, once asked for, its dual.
class TopologyPair {
 public:
  explicit TopologyPair(Topology primal) : primal_(std::move(primal)) {}

  const Topology& primal() const { return primal_; }
  Topology& mutablePrimal() { return primal_; }
  DualTopology& dual() {
    if (!dual_) dual_ = std::make_unique<DualTopology>(dualOf(primal_));
    return *dual_;
  }
  Topology& walked(bool dual) { return dual ? this->dual().topology : primal_; }

 private:
  Topology primal_;
  std::unique_ptr<DualTopology> dual_;
};

struct EncoderMemory;

/// Codes valences and degrees. Fails when that takes clearly more than `most_bits`.
Result<WalkedCandidate> walkCandidate(TopologyPair& topologies, const Candidate& candidate, EncoderMemory& memory,
                                      size_t most_bits = ~size_t{0});

/// Adds the repairs and makes the section.
Result<Encoded> finishCandidate(TopologyPair& topologies, WalkedCandidate&& walked, PolygonView mesh);

}  // namespace tutte
