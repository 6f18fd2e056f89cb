#pragma once
// Predictions from what is known besides the attribute itself. A guide looks at a site after its stencil and may put
// a better prediction into it; one that predicts alone is given a stencil that has gathered nothing but errors.
// Afterwards it learns the site's value.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/apart.h"
#include "codec/value_geometry.h"
#include "codec/value_stencil.h"
#include "codec/values.h"

namespace tutte::values {

/// How programs weigh the normals of the faces round a vertex. The numbers are part of the format.
enum class Weighting : uint8_t { kEven = 0, kByAngle = 1, kByArea = 2 };
inline constexpr int kWeightings = 3;

/// For attributes without relatives.
template <int C>
struct NoGuide {
  static SurroundingsFinder::Wanted wanted(ValueKind) { return {}; }
  static constexpr bool predictsAlone() { return false; }

  NoGuide(const ValueGraph&, const Nodes<C>&, std::span<const int32_t>, int32_t, ValueKind, Weighting) {}
  template <class T>
  void refine(const Surroundings&, const Vec<C, int32_t>&, Stencil<C, T>&) {}
  void learn(Index, const Vec<C, int32_t>&) {}
};

/// The positions of the sites, three numbers each, below 2^20.
class Places {
 public:
  explicit Places(std::span<const int32_t> values) : values_(values) {}

  Vector3 operator[](Index site) const {
    const int32_t* value = &values_[size_t{site} * 3];
    return {value[0], value[1], value[2]};
  }
  Vector3 between(Index from, Index to) const {
    const std::array<int32_t, 3> step = shortStep(from, to);
    return {step[0], step[1], step[2]};
  }
  /// The same in fewer bits.
  std::array<int32_t, 3> shortStep(Index from, Index to) const {
    const int32_t *a = &values_[size_t{from} * 3], *b = &values_[size_t{to} * 3];
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }

 private:
  std::span<const int32_t> values_;
};

/// Of the first two components.
template <int C>
int64_t distance(const Vec<C, int32_t>& a, const Vec<C, int32_t>& b) {
  const int64_t x = a[0] - b[0], y = a[1] - b[1];
  return std::min<int64_t>((x < 0 ? -x : x) + (y < 0 ? -y : y), 1 << 20);
}

/// Texture coordinates: the texture is taken to lie on the surface without distortion, so a triangle in space, two
/// corners of which have known coordinates, gives the third's, once it is known whether the texture is mirrored.
template <int C>
class TexcoordGuide {
 public:
  /// Where there is a parallelogram, edges say more than what is far away.
  static SurroundingsFinder::Wanted wanted(ValueKind) { return {.edges = true, .far = false}; }
  static constexpr bool predictsAlone() { return false; }

  TexcoordGuide(const ValueGraph& graph, const Nodes<C>& nodes, std::span<const int32_t> places, int32_t max, ValueKind,
                Weighting)
      : nodes_(nodes), places_(places), states_(graph.siteCount()), limit_(int64_t{max} << kFraction) {}

  TUTTE_APART void refine(const Surroundings& around, const Vec<C, int32_t>&, Stencil<C, int32_t>& stencil) {
    count_ = 0;
    int64_t here_error = 0, stencil_error = 0;
    for (const Index neighbour : around.neighbours()) {
      here_error += states_[neighbour].here_error;
      stencil_error += states_[neighbour].stencil_error;
    }
    for (const Edge& edge : around.edges()) develop(around.site(), edge);
    stencil_base_ = here_base_ = stencil.base;
    if (count_ == 0) return;
    average();
    const bool weak = stencil.member_count == 0;
    if (weak || here_error <= stencil_error)
      adopt(stencil, weak);
    else
      keep(stencil);
  }

  void learn(Index, const Vec<C, int32_t>& value) {
    const Vec<C, int32_t> truth = {value[0] << kFraction, value[1] << kFraction};
    State& state = states_[nodes_.count() - 1];
    state.here_error = static_cast<uint32_t>(distance<C>(truth, here_base_));
    state.stencil_error = static_cast<uint32_t>(distance<C>(truth, stencil_base_));
    if (count_ == 0) return;
    const int64_t x = value[0] - nodes_[edge_].value[0], y = value[1] - nodes_[edge_].value[1];
    const int64_t side = edge_step_[0] * y - edge_step_[1] * x;
    if (side != 0) last_turn_ = side > 0 ? 1 : -1;
    state.turn = last_turn_;
  }

 private:
  struct State {
    uint32_t here_error = 0;     ///< of this guide's prediction
    uint32_t stencil_error = 0;  ///< of the one it was given
    int8_t turn = 0;             ///< 1: the texture lies as the surface does; -1: mirrored; 0: unknown
  };

  /// The prediction from an edge that runs round the face that the site belongs to.
  void develop(Index site, const Edge& side) {
    std::array<int32_t, 3> edge = places_.shortStep(side.from, side.to), leg = places_.shortStep(side.from, site);
    uint32_t digits = 0;
    for (size_t i = 0; i < 3; ++i) digits |= magnitude(edge[i]) | magnitude(leg[i]);
    const int shift = static_cast<int>(std::bit_width(digits)) - 14;
    for (size_t i = 0; i < 3 && shift > 0; ++i) edge[i] >>= shift, leg[i] >>= shift;
    const int64_t square = dot(edge, edge), along = dot(edge, leg);
    if (square == 0) return;
    // Parts of the edge, in 1/2^20; neither product reaches 2^61, since along and across are at most |edge| |leg|.
    const int64_t inverse = (int64_t{1} << 45) / square;
    const int64_t across = nearRoot(static_cast<uint64_t>(dot(leg, leg) * square - along * along));
    const int64_t forth = along * inverse >> 25,
                  aside = (turnAt(side.from, side.to) < 0 ? -across : across) * inverse >> 25;
    const Vec<C, int32_t>&from = nodes_[side.from].value, &to = nodes_[side.to].value;
    const int64_t dx = int64_t{to[0]} - from[0], dy = int64_t{to[1]} - from[1];
    Vec<C, int32_t>& member = members_[count_];
    const auto place = [&](int32_t start, int64_t step) {
      const int64_t x = (int64_t{start} << kFraction) + ((step + (1 << (19 - kFraction))) >> (20 - kFraction));
      return static_cast<int32_t>(std::clamp(x, -limit_, 2 * limit_));
    };
    member[0] = place(from[0], forth * dx - aside * dy);
    member[1] = place(from[1], forth * dy + aside * dx);
    if (count_++ == 0) {
      edge_ = side.from;
      edge_step_ = {dx, dy};
    }
  }

  static uint32_t magnitude(int32_t x) { return static_cast<uint32_t>(x < 0 ? -x : x); }
  static int64_t dot(const std::array<int32_t, 3>& a, const std::array<int32_t, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  int turnAt(Index p, Index q) const {
    if (states_[p].turn != 0) return states_[p].turn;
    return states_[q].turn != 0 ? states_[q].turn : last_turn_;
  }

  void average() {
    for (int i = 0; i < 2; ++i) {
      int64_t sum = 0;
      for (int m = 0; m < count_; ++m) sum += members_[m][i];
      here_base_[i] = static_cast<int32_t>(mean(sum, static_cast<uint32_t>(count_)));
    }
  }

  void adopt(Stencil<C, int32_t>& stencil, bool weak) {
    stencil.adopt(Source::kAcrossTriangle, here_base_, std::span(members_.data(), static_cast<size_t>(count_)));
    if (weak) return;
    stencil.lean = stencil_base_;
    if (count_ == 1) spread(stencil);
  }

  void keep(Stencil<C, int32_t>& stencil) {
    stencil.lean = here_base_;
    if (stencil.member_count == 1) spread(stencil);
  }

  // Of a single prediction: how far the other guess is from it.
  void spread(Stencil<C, int32_t>& stencil) const {
    for (size_t i = 0; i < 2; ++i) {
      const int32_t off = stencil_base_[i] - here_base_[i];
      stencil.spread[i] = off < 0 ? -off : off;
    }
  }

  const Nodes<C>& nodes_;
  const Places places_;
  std::vector<State> states_;  // by site
  const int64_t limit_;
  int8_t last_turn_ = 1;

  // Of the current site.
  int count_ = 0;
  std::array<Vec<C, int32_t>, Stencil<C, int32_t>::kMostMembers> members_{};
  Vec<C, int32_t> here_base_{}, stencil_base_{};
  Index edge_ = 0;  // the first prediction's start
  std::array<int64_t, 2> edge_step_{};
};

}  // namespace tutte::values
