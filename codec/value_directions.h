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

/// The normals that the surface itself has at its sites: sums over the faces around each.
class SurfaceNormals {
 public:
  /// `places` are those of ValueSites. O(corners).
  static std::vector<SurfaceNormal> of(const ValueGraph& graph, Places places, Weighting weighting) {
    SurfaceNormals sums(graph, places, weighting);
    graph.withFaces([&](const auto& faces) { sums.addAll(faces); });
    return sums.normals();
  }

 private:
  SurfaceNormals(const ValueGraph& graph, Places places, Weighting weighting)
      : graph_(graph), places_(places), weighting_(weighting), sums_(graph.siteCount(), Vector3{}) {}

  template <class Faces>
  void addAll(const Faces& faces) {
    for (Index begin = 0, end; begin < graph_.cornerCount(); begin = end) {
      if constexpr (Faces::kAllTriangles) {
        end = begin + 3;
      } else {
        for (end = begin + 1; faces.next(end - 1) == end; ++end) {
        }
      }
      if (end - begin == 3) addTriangle(begin);
      if (end - begin > 3) addPolygon(faces, begin, end);
    }
  }

  // The area is the product of the sides at each of its corners.
  void addTriangle(Index begin) {
    const Index a = graph_.site(begin), b = graph_.site(begin + 1), c = graph_.site(begin + 2);
    const Vector3 ab = places_.between(a, b), bc = places_.between(b, c), ca = places_.between(c, a);
    const Vector3 area = cross(ab, bc), normal = normalOf(area);
    if (weighting_ != Weighting::kByAngle) {
      for (const Index site : {a, b, c}) add(site, normal, 1);
      return;
    }
    const Sine sine(area);
    add(a, normal, angle(sine, -dot(ab, ca)));
    add(b, normal, angle(sine, -dot(bc, ab)));
    add(c, normal, angle(sine, -dot(ca, bc)));
  }

  template <class Faces>
  void addPolygon(const Faces& faces, Index begin, Index end) {
    const Vector3 normal = normalOf(areaOf(begin, end));
    for (Index c = begin; c < end; ++c) {
      const Index site = graph_.site(c);
      int64_t weight = 1;
      if (weighting_ == Weighting::kByAngle) {
        const Vector3 next = places_.between(site, graph_.site(faces.next(c)));
        const Vector3 prev = places_.between(site, graph_.site(faces.prev(c)));
        weight = angle(Sine(cross(next, prev)), dot(next, prev));
      }
      add(site, normal, weight);
    }
  }

  // Twice the area of a polygon of four corners or more, as a vector at right angles to it.
  Vector3 areaOf(Index begin, Index end) const {
    constexpr Index kMostCorners = 1u << 20;  // so that sums fit
    end = std::min(end, begin + kMostCorners);
    Vector3 area{};
    const auto between = [&](Index from, Index to) { return places_.between(graph_.site(from), graph_.site(to)); };
    const auto addPart = [&](const Vector3& part) {
      for (size_t i = 0; i < 3; ++i) area[i] += part[i];
    };
    Index c = begin;
    // Diagonals span the area of a quad.
    for (; end - c > 3; c += 2) addPart(cross(between(begin, c + 2), between(c + 1, c + 3)));
    if (end - c == 3) addPart(cross(between(begin, c + 1), between(c + 1, c + 2)));
    return area;
  }

  Vector3 normalOf(const Vector3& area) const {
    return weighting_ == Weighting::kByArea ? shortened(area, 46) : unit(area);
  }

  // Unsigned, because thousands of faces round one site may wrap round.
  void add(Index site, const Vector3& normal, int64_t weight) {
    Vector3& sum = sums_[site];
    for (size_t i = 0; i < 3; ++i) {
      sum[i] = static_cast<int64_t>(static_cast<uint64_t>(sum[i]) + static_cast<uint64_t>(normal[i] * weight));
    }
  }

  std::vector<SurfaceNormal> normals() const {
    std::vector<SurfaceNormal> normals(sums_.size());
    for (size_t site = 0; site < sums_.size(); ++site) {
      const Vector3 normal = unit(sums_[site]);
      for (size_t i = 0; i < 3; ++i) normals[site][i] = static_cast<int16_t>(normal[i]);
    }
    return normals;
  }

  const ValueGraph& graph_;
  const Places places_;
  const Weighting weighting_;
  std::vector<Vector3> sums_;  // by site
};

/// Directions: the surface's normal, the same with the neighbours' deviation from theirs, or the neighbours' mean
/// direction: whichever was best at the neighbours. Where directions point into the surface, so do predictions.
template <int C>
class DirectionGuide {
 public:
  static SurroundingsFinder::Wanted wanted(ValueKind) { return {.predictions = false}; }
  static constexpr bool predictsAlone() { return true; }

  /// Without places (an empty span), only the neighbours count. `max` is twice the octahedron's centre.
  DirectionGuide(const ValueGraph& graph, const Nodes<C>& nodes, std::span<const int32_t> places, int32_t max,
                 ValueKind, Weighting weighting)
      : nodes_(nodes), states_(graph.siteCount()), centre_(max / 2) {
    if (!places.empty()) surface_ = SurfaceNormals::of(graph, Places(places), weighting);
  }

  TUTTE_APART void refine(const Surroundings& around, const Vec<C, int32_t>& last, Stencil<C, int32_t>& stencil) {
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
    const Vector3 neighbours{sum[0], sum[1], sum[2]}, here{here_[0], here_[1], here_[2]};
    Vector3 deviating = here;
    for (size_t i = 0; i < 3 && count > 0; ++i) deviating[i] += mean(sum[i] - normals[i], static_cast<uint32_t>(count));
    const Vector3& surface = isZero(here_) ? neighbours : here;
    if (isZero(surface) || isZero(deviating) || (count > 0 && isZero(neighbours))) stencil.settleWithout(around, last);
    bases_[kSurface] = project(surface, stencil.base);
    bases_[kDeviating] = project(deviating, stencil.base);
    bases_[kNeighbourMean] = count > 0 ? project(neighbours, stencil.base) : bases_[kDeviating];
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

  /// `fallback` where there is no direction.
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
