#pragma once
// The join list: which umbrellas share a vertex. Written once for both directions.
//
// Where sheets of a surface meet, they mostly do so along edges: so the neighbours of an umbrella and the other
// umbrellas of these neighbours' vertices suggest which vertex it belongs to.

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "codec/face_ways.h"
#include "codec/mesh.h"
#include "codec/model.h"
#include "codec/result.h"

namespace tutte {

/// The vertices that an umbrella may belong to, likeliest first.
class JoinCandidates {
 public:
  explicit JoinCandidates(const Connectivity& mesh)
      : mesh_(mesh),
        ways_(mesh),
        firsts_(mesh.umbrella_count, kNone),
        suggested_(mesh.umbrella_count, 0),
        vertices_(std::make_unique_for_overwrite<Vertex[]>(mesh.umbrella_count)),
        sibling_(std::make_unique_for_overwrite<Index[]>(mesh.umbrella_count)) {
    findFirstCorners(mesh.twins, mesh.umbrellas, firsts_);
  }

  /// Comes to an umbrella; all before it are known. O(1).
  void enter(Index umbrella) {
    umbrella_ = umbrella;
    taken_ = found_ = 0;
    const Index first = firsts_[umbrella];
    lone_ = isLone(first);
    if (lone_) {
      enterLone(first);
    } else {
      evidence_ = suggested_[umbrella] ? lookAround() : 0;
    }
  }

  /// 0: no candidate; 1: one neighbour suggests the likeliest; 2: several do;
  /// 3: its face may be alone, and a neighbour is known.
  int evidence() const { return evidence_; }

  /// The likeliest candidate that was not taken yet; kNone: there is none. Nothing but a face that is alone visits a
  /// vertex twice, and such a face does so more often than not: its vertices come first, and only then is looked
  /// around.
  Index take() {
    if (taken_ == found_ && lone_ && found_ == beside_) lookAround();
    if (taken_ == found_) return kNone;
    int best = taken_;
    for (int i = taken_ + 1; i < found_; ++i) {
      if (isLikelier(candidates_[i], candidates_[best])) best = i;
    }
    std::rotate(&candidates_[taken_], &candidates_[best], &candidates_[best] + 1);
    return candidates_[taken_++].vertex;
  }

  /// No neighbour comes before it.
  bool starts() const {
    if (lone_) return evidence_ == 0;
    const Ring<1> neighbors(*this, umbrella_, umbrella_);
    return neighbors.begin() == neighbors.end();
  }

  /// An umbrella's vertex is known, and new or not.
  void learn(Index umbrella, bool joined) {
    Vertex& vertex = vertexOf(umbrella);
    if (joined) {
      if (vertex.umbrellas == 1) suggestAround(vertex.last);
      suggestAround(umbrella);
    }
    sibling_[umbrella] = joined ? vertex.last : kNone;
    vertex = {umbrella, joined ? vertex.umbrellas + 1 : 1};
  }

  static constexpr int kMostRanks = 6;

 private:
  static constexpr size_t kMostNeighbors = 8, kMostRing = 12;
  static constexpr int kMostSteps = 32, kMostSiblings = 3, kMostVoted = 16;

  struct Candidate {
    Index vertex;
    int votes;
  };

  struct Vertex {
    Index last;       ///< of its umbrellas
    Index umbrellas;  ///< how many there are
  };

  bool isLikelier(const Candidate& a, const Candidate& b) const {
    return a.votes != b.votes ? a.votes > b.votes : vertices_[a.vertex].umbrellas < vertices_[b.vertex].umbrellas;
  }

  /// The first of an umbrella's neighbours that are below a number: one per edge, in the order round it.
  template <size_t kMost>
  class Ring {
   public:
    Ring(const JoinCandidates& candidates, Index umbrella, Index below) {
      candidates.goRound(umbrella, [&, steps = 0](Index neighbor) mutable {
        if (neighbor < below) neighbors_[count_++] = neighbor;
        return count_ < kMost && ++steps < kMostSteps;
      });
    }

    const Index* begin() const { return neighbors_.data(); }
    const Index* end() const { return neighbors_.data() + count_; }

   private:
    std::array<Index, kMost> neighbors_;
    size_t count_ = 0;
  };

  Vertex& vertexOf(Index umbrella) { return vertices_[mesh_.vertices[umbrella]]; }

  /// Calls visit(neighbour) as long as it returns true.
  template <class Visit>
  void goRound(Index umbrella, Visit visit) const {
    const Index first = firsts_[umbrella];
    if (first == kNone || !visit(mesh_.umbrellas[ways_.next(first)])) return;
    for (Index corner = first; corner != kNone;) {
      const Index prev = ways_.prev(corner);
      corner = mesh_.twins[prev];
      if (corner == first || !visit(mesh_.umbrellas[prev])) return;
    }
  }

  /// It has two neighbours.
  bool isLone(Index first) const {
    if (first == kNone) return false;
    const Index beyond = mesh_.twins[ways_.prev(first)];
    return beyond == kNone || (beyond != first && mesh_.twins[ways_.prev(beyond)] == first);
  }

  /// An umbrella shares its vertex.
  void suggestAround(Index umbrella) {
    goRound(umbrella, [&](Index neighbor) { return suggested_[neighbor] = 1; });
  }

  // Two neighbours, whose vertices are candidates before anybody votes.
  void enterLone(Index first) {
    for (const Index neighbor : {mesh_.umbrellas[ways_.next(first)], mesh_.umbrellas[ways_.prev(first)]}) {
      if (neighbor < umbrella_ && (found_ == 0 || candidates_[0].vertex != mesh_.vertices[neighbor])) put(neighbor);
    }
    beside_ = found_;
    evidence_ = found_ == 0 ? 0 : 3;
  }

  void put(Index neighbor) { candidates_[found_++] = {mesh_.vertices[neighbor], 0}; }

  // The other umbrellas of the neighbours' vertices vote with their own neighbours. The vertices of an umbrella's own
  // neighbours are taken. Returns the evidence.
  int lookAround() {
    const Ring<kMostNeighbors> neighbors(*this, umbrella_, umbrella_);
    if (std::ranges::none_of(neighbors, [&](Index neighbor) { return vertexOf(neighbor).umbrellas > 1; })) return 0;
    if (!lone_) {
      for (const Index neighbor : neighbors) put(neighbor);
      beside_ = taken_ = found_;
    }
    for (const Index neighbor : neighbors) {
      if (vertexOf(neighbor).umbrellas > 1) look(neighbor);
    }
    int votes = 0;
    for (int i = taken_; i < found_; ++i) votes = std::max(votes, candidates_[i].votes);
    return std::min(votes, 2);
  }

  // The neighbours of the other umbrellas of a neighbour's vertex.
  void look(Index neighbor) {
    Index sibling = vertexOf(neighbor).last;
    for (int i = 0; i < kMostSiblings && sibling != kNone; ++i, sibling = sibling_[sibling]) {
      if (sibling == neighbor) continue;
      for (const Index far : Ring<kMostRing>(*this, sibling, umbrella_)) vote(mesh_.vertices[far]);
    }
  }

  void vote(Index vertex) {
    for (int i = 0; i < found_; ++i) {
      if (candidates_[i].vertex != vertex) continue;
      ++candidates_[i].votes;
      return;
    }
    if (found_ < beside_ + kMostVoted) candidates_[found_++] = {vertex, 1};
  }

  const Connectivity& mesh_;
  const FaceWays ways_;
  std::vector<Index> firsts_;       // per umbrella: the corner from which one goes round it
  std::vector<uint8_t> suggested_;  // per umbrella: a neighbour shares its vertex
  const std::unique_ptr<Vertex[]> vertices_;
  const std::unique_ptr<Index[]> sibling_;  // per umbrella: the one before it at its vertex
  // Of the umbrella that was entered: its neighbours' vertices, and those that were voted for.
  std::array<Candidate, kMostNeighbors + kMostVoted> candidates_;
  int beside_ = 0, taken_ = 0, found_ = 0;
  int evidence_ = 0;
  Index umbrella_ = 0;
  bool lone_ = false;
};

template <class Port>
class JoinCoder {
 public:
  /// `mesh` has everything but its vertices; `on_boundary` says which of its umbrellas a dummy face touches, and ends
  /// where the umbrellas of faces of degree below 3 begin. `truth`: per umbrella its vertex; a decoder passes nothing.
  JoinCoder(Port& port, std::span<const Index> truth, std::span<const uint8_t> on_boundary, Connectivity& mesh)
      : port_(port), truth_(truth), on_boundary_(on_boundary), mesh_(mesh), candidates_(mesh) {}

  /// Per umbrella: does it belong to a vertex that has one already, and to which? O(corners).
  Error run() {
    mesh_.vertices.resize(mesh_.umbrella_count);
    for (Index u = 0; u < mesh_.umbrella_count; ++u) {
      const Index truth = truth_.empty() ? 0 : truth_[u];
      candidates_.enter(u);
      const bool joined = count_ != 0 && isJoined(u).code(port_, truth != count_);
      const Index vertex = joined ? codeVertex(truth) : count_++;
      if (vertex >= count_) return Error::kMalformed;
      mesh_.vertices[u] = vertex;
      candidates_.learn(u, joined);
      if (joined) expect(vertex);
      joined_before_ = joined;
    }
    mesh_.vertex_count = count_;
    return Error::kNone;
  }

 private:
  Bit& isJoined(Index umbrella) {
    const int kind = umbrella >= on_boundary_.size() ? 2 : on_boundary_[umbrella];
    return joins_[kind][joined_before_][candidates_.evidence()];
  }

  // References run on from the last one; those of components, from the last component's.
  void expect(Index vertex) {
    expected_ = vertex + 1;
    if (candidates_.starts()) expected_start_ = vertex;
  }

  Index codeVertex(Index truth) {
    for (Bit& hit : hits_[candidates_.evidence()]) {
      const Index vertex = candidates_.take();
      if (vertex == kNone) break;
      if (hit.code(port_, truth == vertex)) return vertex;
    }
    return codeFar(candidates_.starts(), truth);
  }

  Index codeFar(bool starts, Index truth) {
    const int context = starts ? 2 : joined_before_;
    const Index expected = starts ? expected_start_ : expected_;
    const bool back = backwards_[context].code(port_, truth < expected);
    const Index steps = distance_[context].code(port_, back ? expected - 1 - truth : truth - expected);
    const uint64_t vertex = back ? uint64_t{expected} - 1 - steps : uint64_t{expected} + steps;
    return static_cast<Index>(std::min(vertex, uint64_t{kNone}));
  }

  Port& port_;
  std::span<const Index> truth_;
  std::span<const uint8_t> on_boundary_;
  Connectivity& mesh_;
  JoinCandidates candidates_;
  std::array<std::array<std::array<Bit, 4>, 2>, 3> joins_;
  std::array<std::array<Bit, JoinCandidates::kMostRanks>, 4> hits_;
  std::array<Bit, 3> backwards_;
  std::array<NumberModel, 3> distance_;
  Index count_ = 0;                          // vertices so far
  Index expected_ = 0, expected_start_ = 0;  // where the next references are expected to go
  bool joined_before_ = false;
};

}  // namespace tutte
