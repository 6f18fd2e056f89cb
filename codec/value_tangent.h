#pragma once
// The tangent plane of a surface's points: once two components of a point are known, it tells where the third is.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "codec/value_tables.h"

namespace tutte::values {

class TangentPlane {
 public:
  TangentPlane() { gains_.fill(2048); }

  /// Lies at right angles to a normal of any length; 0: it is not known, and the components keep their order.
  void turn(const std::array<int64_t, 3>& normal) {
    order_ = {0, 1, 2, 3};
    bent_ = false;
    if (normal == std::array<int64_t, 3>{}) return;
    std::array<uint64_t, 3> size{};
    for (int i = 0; i < 3; ++i) {
      size[i] = normal[i] < 0 ? uint64_t{0} - static_cast<uint64_t>(normal[i]) : static_cast<uint64_t>(normal[i]);
    }
    // Ascending; equal ones stay as they are.
    constexpr std::array<std::array<int, 3>, 8> kOrders = {
        {{0, 1, 2}, {0, 2, 1}, {0, 1, 2}, {2, 0, 1}, {1, 0, 2}, {0, 1, 2}, {1, 2, 0}, {2, 1, 0}}};
    std::ranges::copy(kOrders[(size[0] > size[1]) * 4 + (size[0] > size[2]) * 2 + (size[1] > size[2])], order_.begin());
    const int shift = static_cast<int>(std::bit_width(size[order_[2]])) - 12;
    for (int i = 0; i < 3; ++i) normal_[i] = shift > 0 ? normal[i] >> shift : normal[i];
    bent_ = normal_[order_[2]] != 0;
  }

  /// It tells something about the third component to be coded.
  bool bent() const { return bent_; }
  /// Which component is coded at a place: last, of three, the one that the plane determines best.
  int component(int place) const { return order_[place]; }
  /// Of the normal, 12 binary digits.
  int64_t normal(int component) const { return normal_[component]; }

  /// Where the plane is in the third component, as the others are `raw` away from their predictions.
  template <class Values>
  int64_t correction(const Values& raw) const {
    const int64_t sum = normal_[order_[0]] * int64_t{raw[order_[0]]} + normal_[order_[1]] * int64_t{raw[order_[1]]};
    return -sum / normal_[order_[2]];
  }

  /// How much of that is to be believed. `scale`: the usual error; `situation`: below kSituations.
  int64_t believed(int64_t correction, int32_t scale, uint32_t situation) const {
    return gains_[gainOf(scale, situation)] * correction >> 12;
  }

  /// The third component was `off` from its uncorrected prediction.
  void learn(int64_t off, int64_t correction, int32_t scale, uint32_t situation) {
    const int64_t limit = 4 * int64_t{scale} + 64;
    if (off > limit || off < -limit || correction > limit || correction < -limit) return;
    int32_t& gain = gains_[gainOf(scale, situation)];
    const int64_t error = off - (gain * correction >> 12);
    const int shift = 2 * bitLength(static_cast<uint32_t>(scale)) - 6;
    const int64_t product = error * correction;
    const int64_t step = std::clamp<int64_t>(shift >= 0 ? product >> shift : product << -shift, -512, 512);
    gain = static_cast<int32_t>(std::clamp<int64_t>(gain + step, -512, 4608));
  }

  static constexpr uint32_t kSituations = 6;

 private:
  static size_t gainOf(int32_t scale, uint32_t situation) {
    return static_cast<size_t>(std::min(bitLength(static_cast<uint32_t>(scale)), 15)) * kSituations + situation;
  }

  std::array<int32_t, 16 * kSituations> gains_;  // in 1/4096
  std::array<int, 4> order_{0, 1, 2, 3};
  std::array<int64_t, 3> normal_{};
  bool bent_ = false;
};

}  // namespace tutte::values
