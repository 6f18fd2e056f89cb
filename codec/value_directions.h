#pragma once
// Predictions of directions, such as normals, on the unfolded octahedron.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/apart.h"
#include "codec/value_geometry.h"
#include "codec/value_guides.h"
#include "codec/value_stencil.h"

namespace tutte::values {

using SurfaceNormal = std::array<int16_t, 3>;  ///< of length 2^kUnitBits, or 0

/// Twice the area of a face's corners from `begin` to `end`, as a vector at right angles to it.
inline Vector3 areaOf(const ValueGraph& graph, Places places, Index begin, Index end) {
  constexpr Index kMostCorners = 1u << 20;  // so that sums fit
  end = std::min(end, begin + kMostCorners);
  Vector3 area{};
  Index c = begin;
  // Diagonals span the area of a quad.
  for (; end - c > 3; c += 2) {
    const Vector3 part = cross(places.between(graph.site(begin), graph.site(c + 2)),
                               places.between(graph.site(c + 1), graph.site(c + 3)));
    for (int i = 0; i < 3; ++i) area[i] += part[i];
  }
  if (end - c < 3) return area;
  const Vector3 part =
      cross(places.between(graph.site(begin), graph.site(c + 1)), places.between(graph.site(c + 1), graph.site(c + 2)));
  for (int i = 0; i < 3; ++i) area[i] += part[i];
  return area;
}

/// The normals that the surface itself has at its sites: sums over the faces around each. `places` are those of
/// ValueSites. O(corners).
inline std::vector<SurfaceNormal> surfaceNormals(const ValueGraph& graph, Places places, Weighting weighting) {
  std::vector<Vector3> sums(graph.siteCount(), Vector3{});
  for (Index begin = 0, end; begin < graph.cornerCount(); begin = end) {
    for (end = begin + 1; graph.next(end - 1) == end; ++end) {
    }
    if (end - begin < 3) continue;
    const Vector3 area = areaOf(graph, places, begin, end);
    const Vector3 normal = weighting == Weighting::kByArea ? shortened(area, 46) : unit(area);
    for (Index c = begin; c < end; ++c) {
      const Index site = graph.site(c);
      int64_t weight = 1;
      if (weighting == Weighting::kByAngle) {
        weight =
            angle(places.between(site, graph.site(graph.next(c))), places.between(site, graph.site(graph.prev(c))));
      }
      // Unsigned, because thousands of faces round one site may wrap round.
      for (int i = 0; i < 3; ++i) {
        sums[site][i] =
            static_cast<int64_t>(static_cast<uint64_t>(sums[site][i]) + static_cast<uint64_t>(normal[i] * weight));
      }
    }
  }
  std::vector<SurfaceNormal> normals(sums.size());
  for (size_t site = 0; site < sums.size(); ++site) {
    const Vector3 normal = unit(sums[site]);
    for (int i = 0; i < 3; ++i) normals[site][i] = static_cast<int16_t>(normal[i]);
  }
  return normals;
}

/// Directions: the surface's normal, the same with the neighbours' deviation from theirs, or the neighbours' mean
/// direction: whichever was best at the neighbours. Where directions point into the surface, so do predictions.
template <int C>
class DirectionGuide {
 public:
  static SurroundingsFinder::Wanted wanted(ValueKind) { return {.predictions = false}; }

  /// Without places (an empty span), only the neighbours count. `max` is twice the octahedron's centre.
  DirectionGuide(const ValueGraph& graph, const Nodes<C>& nodes, std::span<const int32_t> places, int32_t max,
                 ValueKind, Weighting weighting)
      : nodes_(nodes), states_(graph.siteCount()), centre_(max / 2) {
    if (!places.empty()) surface_ = surfaceNormals(graph, Places(places), weighting);
  }

  TUTTE_APART void refine(const Surroundings& around, Stencil<C, int32_t>& stencil) {
    std::array<int32_t, kCandidates> errors{};
    std::array<int32_t, 3> sum{}, normals{};
    const auto count = static_cast<int32_t>(around.neighbours().size());
    int32_t inward = 0;
    for (const Index neighbour : around.neighbours()) {
      const State& state = states_[neighbour];
      for (int k = 0; k < kCandidates; ++k) errors[k] += state.errors[k];
      for (int i = 0; i < 3; ++i) {
        sum[i] += state.direction[i];
        normals[i] += state.normal[i];
      }
      inward += state.inward;
    }
    if (!surface_.empty()) here_ = surface_[around.site()];
    inward_ = count > 0 ? 2 * inward > count : last_inward_;
    if (inward_) turnRound();
    predict(sum, normals, count, stencil.base);
    if (count > 0 || !isZero(here_)) choose(errors, stencil);
  }

  void learn(Index, const Vec<C, int32_t>& value) {
    State& state = states_[nodes_.count() - 1];
    const Vec<C, int32_t> truth = {value[0] << kFraction, value[1] << kFraction};
    for (int k = 0; k < kCandidates; ++k) state.errors[k] = static_cast<int32_t>(distance<C>(truth, bases_[k]));
    const Vector3 direction = fromOctahedron(value[0], value[1], centre_);
    const int64_t along = dot(direction, Vector3{here_[0], here_[1], here_[2]});
    if (along < 0) {
      inward_ = !inward_;
      turnRound();
    }
    if (along != 0) last_inward_ = inward_;
    state.inward = inward_;
    state.normal = here_;
    for (int i = 0; i < 3; ++i) state.direction[i] = static_cast<int16_t>(direction[i]);
  }

 private:
  enum Candidate { kSurface, kDeviating, kNeighbourMean, kCandidates };

  struct State {
    SurfaceNormal direction{}, normal{};  ///< the latter on the direction's side
    bool inward = false;                  ///< so that it was turned round
    std::array<int32_t, kCandidates> errors{};
  };

  // In one step, where comparing arrays would be a call.
  template <class Number>
  static bool isZero(const std::array<Number, 3>& v) {
    return (v[0] | v[1] | v[2]) == 0;
  }

  void turnRound() {
    for (int16_t& x : here_) x = static_cast<int16_t>(-x);
  }

  void predict(const std::array<int32_t, 3>& sum, const std::array<int32_t, 3>& normals, int32_t count,
               const Vec<C, int32_t>& fallback) {
    Vector3 mean_direction{sum[0], sum[1], sum[2]}, deviating{here_[0], here_[1], here_[2]};
    bases_[kSurface] = project(isZero(here_) ? mean_direction : deviating, fallback);
    for (int i = 0; i < 3 && count > 0; ++i) deviating[i] += mean(sum[i] - normals[i], static_cast<uint32_t>(count));
    bases_[kDeviating] = project(deviating, fallback);
    bases_[kNeighbourMean] = count > 0 ? project(mean_direction, fallback) : bases_[kDeviating];
  }

  Vec<C, int32_t> project(const Vector3& direction, const Vec<C, int32_t>& fallback) const {
    if (isZero(direction)) return fallback;
    const auto [s, t] = toOctahedron(direction, centre_, kFraction);
    return {static_cast<int32_t>(s), static_cast<int32_t>(t)};
  }

  void choose(const std::array<int32_t, kCandidates>& errors, Stencil<C, int32_t>& stencil) {
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

  const Nodes<C>& nodes_;
  std::vector<SurfaceNormal> surface_;  // by site; empty: unknown
  std::vector<State> states_;           // by site
  const int64_t centre_;
  bool last_inward_ = false;

  // Of the current site.
  SurfaceNormal here_{};  // on the side on which the direction is
  bool inward_ = false;
  std::array<Vec<C, int32_t>, kCandidates> bases_{};
};

}  // namespace tutte::values
