#pragma once
// Predictions of directions, such as normals, on the unfolded octahedron.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/value_geometry.h"
#include "codec/value_guides.h"
#include "codec/value_stencil.h"

namespace tutte::values {

/// The normals that the surface itself has at its sites, in the ways in which programs average those of the faces.
enum Weighting { kEven, kByAngle, kByArea, kWeightings };
using SurfaceNormals = std::array<std::array<int16_t, 3>, kWeightings>;  ///< each of length 2^kUnitBits, or 0

/// Sums over the faces around each site. `places` are those of ValueSites. O(corners).
inline std::vector<SurfaceNormals> surfaceNormals(const ValueGraph& graph, Places places) {
  constexpr int64_t kMostArea = int64_t{1} << 61;
  using Sums = std::array<Vector3, kWeightings>;
  std::vector<Sums> sums(graph.siteCount(), Sums{});
  for (Index begin = 0, end; begin < graph.cornerCount(); begin = end) {
    for (end = begin + 1; graph.next(end - 1) == end; ++end) {
    }
    if (end - begin < 3) continue;
    Vector3 normal{};
    for (Index c = begin + 1; c + 1 < end; ++c) {
      const Vector3 part =
          cross(places.between(graph.site(begin), graph.site(c)), places.between(graph.site(begin), graph.site(c + 1)));
      normal = shortened({normal[0] + part[0], normal[1] + part[1], normal[2] + part[2]}, 60);
    }
    const Vector3 even = unit(normal), area = shortened(normal, 46);
    for (Index c = begin; c < end; ++c) {
      const Index site = graph.site(c);
      const int64_t turn =
          angle(places.between(site, graph.site(graph.next(c))), places.between(site, graph.site(graph.prev(c))));
      Sums& sum = sums[site];
      for (int i = 0; i < 3; ++i) {
        sum[kEven][i] += even[i];
        sum[kByAngle][i] += even[i] * turn;
        sum[kByArea][i] = std::clamp(sum[kByArea][i] + area[i], -kMostArea, kMostArea);
      }
    }
  }
  std::vector<SurfaceNormals> normals(sums.size());
  for (size_t site = 0; site < sums.size(); ++site) {
    for (int k = 0; k < kWeightings; ++k) {
      const Vector3 normal = unit(sums[site][k]);
      for (int i = 0; i < 3; ++i) normals[site][k][i] = static_cast<int16_t>(normal[i]);
    }
  }
  return normals;
}

/// Directions: one of the surface's normals, the same with the neighbours' deviation from theirs, or the neighbours'
/// mean direction: whichever was best at the neighbours. Where directions point into the surface, so do predictions.
class DirectionGuide {
 public:
  static constexpr bool kWantsEdges = false;

  /// Without places (an empty span), only the neighbours count. `max` is twice the octahedron's centre.
  DirectionGuide(const ValueGraph& graph, const Nodes<2>& nodes, std::span<const int32_t> places, int32_t max)
      : nodes_(nodes), states_(graph.siteCount()), centre_(max / 2) {
    if (!places.empty()) surface_ = surfaceNormals(graph, Places(places));
  }

  void refine(const Surroundings& around, Stencil<2, int32_t>& stencil) {
    std::array<int64_t, kCandidates> errors{};
    Vector3 sum{}, deviation{};
    const auto count = static_cast<int64_t>(around.neighbours.size());
    int64_t inward = 0;
    for (const Index neighbour : around.neighbours) {
      const State& state = states_[neighbour];
      for (int k = 0; k < kCandidates; ++k) errors[k] += state.errors[k];
      for (int i = 0; i < 3; ++i) {
        sum[i] += state.direction[i];
        deviation[i] += state.deviation[i];
      }
      inward += state.inward;
    }
    if (!surface_.empty()) here_ = surface_[around.site];
    inward_ = count > 0 ? 2 * inward > count : last_inward_;
    if (inward_) turnRound();
    predict(sum, deviation, count, stencil.base);
    if (count > 0 || normalOf(here_, kEven) != Vector3{}) choose(errors, stencil);
  }

  void learn(Index, const std::array<int32_t, 2>& value) {
    State& state = states_[nodes_.count() - 1];
    const Vec<2, int32_t> truth = {value[0] << kFraction, value[1] << kFraction};
    for (int k = 0; k < kCandidates; ++k) state.errors[k] = static_cast<uint32_t>(distance(truth, bases_[k]));
    const Vector3 direction = fromOctahedron(value[0], value[1], centre_);
    const int64_t along = dot(direction, normalOf(here_, kEven));
    if (along < 0) {
      inward_ = !inward_;
      turnRound();
    }
    if (along != 0) last_inward_ = inward_;
    state.inward = inward_;
    for (int i = 0; i < 3; ++i) {
      state.direction[i] = static_cast<int16_t>(direction[i]);
      state.deviation[i] = static_cast<int32_t>(direction[i]) - here_[kEven][i];
    }
  }

 private:
  enum Candidate { kDeviating = kWeightings, kNeighbourMean, kCandidates };

  struct State {
    std::array<int16_t, 3> direction{};
    bool inward = false;                 ///< the surface's normals were turned round
    std::array<int32_t, 3> deviation{};  ///< of the direction from the surface's normal
    std::array<uint32_t, kCandidates> errors{};
  };

  static Vector3 normalOf(const SurfaceNormals& normals, int weighting) {
    const std::array<int16_t, 3>& normal = normals[weighting];
    return {normal[0], normal[1], normal[2]};
  }

  void turnRound() {
    for (auto& normal : here_) {
      for (int16_t& x : normal) x = static_cast<int16_t>(-x);
    }
  }

  void predict(const Vector3& sum, const Vector3& deviation, int64_t count, const Vec<2, int32_t>& fallback) {
    bases_.fill(fallback);
    for (int k = 0; k < kWeightings; ++k) {
      const Vector3 normal = normalOf(here_, k);
      project(k, normal == Vector3{} ? sum : normal);
    }
    Vector3 deviating = normalOf(here_, kEven);
    for (int i = 0; i < 3 && count > 0; ++i) deviating[i] += deviation[i] / count;
    project(kDeviating, deviating);
    project(kNeighbourMean, count > 0 ? sum : deviating);
  }

  void project(int candidate, const Vector3& direction) {
    const Vector3 shorter = shortened(direction, 24);
    if (shorter == Vector3{}) return;
    const auto [s, t] = toOctahedron(shorter, centre_, kFraction);
    bases_[candidate] = {static_cast<int32_t>(s), static_cast<int32_t>(t)};
  }

  void choose(const std::array<int64_t, kCandidates>& errors, Stencil<2, int32_t>& stencil) {
    int best = 0;
    for (int k = 1; k < kCandidates; ++k) best = errors[k] < errors[best] ? k : best;
    int second = best == 0 ? 1 : 0;
    for (int k = 1; k < kCandidates; ++k) second = k != best && errors[k] < errors[second] ? k : second;
    stencil.adopt(Source::kAcrossTriangle, bases_[best], std::span(&bases_[best], 1));
    stencil.lean = bases_[second];
    for (int i = 0; i < 2; ++i) {
      const int32_t off = bases_[second][i] - bases_[best][i];
      stencil.spread[i] = off < 0 ? -off : off;
    }
  }

  const Nodes<2>& nodes_;
  std::vector<SurfaceNormals> surface_;  // by site; empty: unknown
  std::vector<State> states_;            // by site
  const int64_t centre_;
  bool last_inward_ = false;

  // Of the current site.
  SurfaceNormals here_{};  // on the side on which the direction is
  bool inward_ = false;
  std::array<Vec<2, int32_t>, kCandidates> bases_{};
};

}  // namespace tutte::values
