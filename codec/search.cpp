#include "codec/search.h"

#include <algorithm>
#include <bit>

namespace tutte {
namespace {

// The degree of all faces, if they have one and it is small.
Index uniformDegree(const Topology& topology) {
  const auto& first = topology.faces.first;
  const Index degree = topology.real_faces == 0 ? 3 : first[1];
  if (degree > 15) return 0;
  for (Index f = 0; f < topology.real_faces; ++f) {
    if (first[f + 1] - first[f] != degree) return 0;
  }
  return degree;
}

// Enough for the mesh, few enough to be cleared in no time.
int tableBitsFor(const Topology& topology) {
  const int bits = static_cast<int>(std::bit_width(topology.valence.size()));
  return std::clamp(bits - 4, std::clamp(bits - 1, 5, 7), 11);
}

class Search {
 public:
  Search(TopologyPair& topologies, const EncodeOptions& options, EncoderMemory& memory)
      : topologies_(topologies), options_(options), memory_(memory) {}

  Result<WalkedCandidate> run() {
    const size_t corners = std::max<size_t>(1, topologies_.primal().twin.size());
    profile_ = options_.profile ? *options_.profile : profileFor(corners);
    trials_left_ = trialsFor(options_.effort, corners, profile_);
    if (const Error error = tryFirst(); error != Error::kNone) return error;
    if (trials_left_ > 0) tryVariants();
    if (trials_left_ > 2 && !best_candidate_.header.degreesKnown()) tryDual();
    if (options_.effort >= 2) tryMoreLines();
    trySeeds();
    while (best_candidate_.header.table_bits > mostTableBits(best_.bits() / 8)) {
      best_candidate_.header.table_bits = mostTableBits(best_.bits() / 8);
      Result<WalkedCandidate> walked = walkCandidate(topologies_, best_candidate_, memory_);
      if (!walked) return walked.error();
      best_ = std::move(*walked);
    }
    return std::move(best_);
  }

 private:
  // How often a mesh is walked at most, besides the first time. Fewer contexts leave more to the walk.
  static size_t trialsFor(int effort, size_t corners, Profile profile) {
    constexpr size_t kCorners[] = {0, 400'000, 4'000'000, 80'000'000};
    const size_t kMost[] = {0, profile >= Profile::kDefault ? 8u : 11u, 200, 2000};
    effort = std::clamp(effort, 0, 3);
    return std::min(kMost[effort], kCorners[effort] / corners);
  }

  Candidate candidateFor(bool dual, std::vector<ComponentPlan> components) {
    const Topology& topology = topologies_.walked(dual);
    Candidate candidate;
    candidate.components = std::move(components);
    SectionHeader& header = candidate.header;
    header.dual = dual;
    header.closed = topologies_.primal().faces.faceCount() == topologies_.primal().real_faces;
    header.uniform_degree = uniformDegree(topology);
    header.copies = std::any_of(candidate.components.begin(), candidate.components.end(),
                                [](const ComponentPlan& plan) { return plan.original != kNone; });
    header.profile = profile_;
    // Of equal sizes, but newest first is quicker: what came last is still in the caches.
    const bool quick = profile_ == Profile::kFast && !options_.values_follow;
    header.tie = quick ? TieRule::kNewestFirst : TieRule::kOldestFirst;
    header.table_bits = tableBitsFor(topology);
    header.match = profile_ >= Profile::kDefault && header.uniform_degree == 0;
    return candidate;
  }

  // The paper's coder knows no copies; a dual's mirror images were turned round with the mesh.
  Repeats repeatsFor(bool dual) const {
    if (profile_ == Profile::kPaper) return Repeats::kNone;
    return dual ? Repeats::kCopies : Repeats::kMirrored;
  }

  // A large mesh is hoped to be of one piece: only a walk that does not reach all faces shows that it is not.
  Error tryFirst() {
    constexpr Index kLarge = 50'000;
    const Topology& topology = topologies_.primal();
    if (topology.real_faces >= kLarge) {
      const Error error = walkFirst({{topology.faces.first[0], kNone}});
      if (error != Error::kNone || best_.order.start_corners.size() == topology.real_faces) return error;
    }
    return walkFirst(planComponents(topologies_.walked(false), repeatsFor(false)));
  }

  Error walkFirst(std::vector<ComponentPlan> components) {
    Candidate candidate = candidateFor(false, std::move(components));
    Result<WalkedCandidate> walked = walkCandidate(topologies_, candidate, memory_);
    if (!walked) return walked.error();
    keep(std::move(candidate), std::move(*walked));
    return Error::kNone;
  }

  void keep(Candidate&& candidate, WalkedCandidate&& walked) {
    best_candidate_ = std::move(candidate);
    best_ = std::move(walked);
  }

  // In bits. Newest first walks in strips, where values have fewer neighbours that are known: on average they take an
  // eighth of a bit more. A dual must be turned when it is decoded; where speed counts most, it has to save something.
  size_t priceOf(const WalkedCandidate& walked) const {
    const bool strips = options_.values_follow && walked.header.tie == TieRule::kNewestFirst;
    const bool turned = walked.header.dual && profile_ == Profile::kFast;
    return walked.bits() + (strips ? topologies_.primal().valence.size() / 8 : 0) + (turned ? walked.bits() / 32 : 0);
  }

  // Keeps the candidate if it is smaller.
  void attempt(Candidate candidate) {
    if (trials_left_ == 0) return;
    --trials_left_;
    Result<WalkedCandidate> walked = walkCandidate(topologies_, candidate, memory_, priceOf(best_));
    if (walked && priceOf(*walked) < priceOf(best_)) keep(std::move(candidate), std::move(*walked));
  }

  void tryVariants() {
    attempt(withTie(best_candidate_, other(best_candidate_.header.tie)));
    // A match saves next to nothing where it is not worth having, but some hundred trials have time for that.
    if (best_candidate_.header.match && options_.effort >= 2) {
      Candidate unmatched = best_candidate_;
      unmatched.header.match = false;
      attempt(std::move(unmatched));
    }
  }

  // Fewer contexts share a place then; but a decoder has more to clear.
  void tryMoreLines() {
    for (int more = 0; more < 2; ++more) {
      Candidate candidate = best_candidate_;
      if (++candidate.header.table_bits <= mostTableBits(best_.bits() / 8)) attempt(std::move(candidate));
    }
  }

  void tryDual() {
    const Candidate dual = candidateFor(true, planComponents(topologies_.walked(true), repeatsFor(true)));
    attempt(dual);
    if (best_candidate_.header.dual) attempt(withTie(dual, other(dual.header.tie)));
  }

  static TieRule other(TieRule tie) {
    return tie == TieRule::kOldestFirst ? TieRule::kNewestFirst : TieRule::kOldestFirst;
  }

  static Candidate withTie(Candidate candidate, TieRule tie) {
    candidate.header.tie = tie;
    return candidate;
  }

  // Other seeds for components, large ones more often than small ones.
  void trySeeds() {
    if (trials_left_ == 0 || topologies_.primal().real_faces == 0) return;
    const Topology& topology = topologies_.walked(best_candidate_.header.dual);
    const std::vector<Index> component_of = componentsOfFaces(topology, best_candidate_.components);
    const Index corners = topology.faces.first[topology.real_faces];
    uint64_t random = 1;
    for (size_t misses = 0; trials_left_ > 0 && misses < 10'000; ++misses) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      const Index seed = static_cast<Index>((random >> 33) % corners);
      const Index component = component_of[topology.faces.faceOf(seed)];
      if (best_candidate_.components[component].original != kNone) continue;
      Candidate candidate = best_candidate_;
      moveSeed(topology, candidate.components, component, seed);
      attempt(std::move(candidate));
    }
  }

  TopologyPair& topologies_;
  const EncodeOptions& options_;
  EncoderMemory& memory_;
  Profile profile_ = Profile::kDefault;
  size_t trials_left_ = 0;
  Candidate best_candidate_;
  WalkedCandidate best_;
};

}  // namespace

Result<WalkedCandidate> searchCandidates(TopologyPair& topologies, const EncodeOptions& options,
                                         EncoderMemory& memory) {
  return Search(topologies, options, memory).run();
}

}  // namespace tutte
