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
  void turn(const std::array<int32_t, 4>& normal) {
    std::array<uint32_t, 3> size;
    for (size_t i = 0; i < 3; ++i) {
      size[i] = normal[i] < 0 ? 0u - static_cast<uint32_t>(normal[i]) : static_cast<uint32_t>(normal[i]);
    }
    // Sums, because compilers make decisions of conditions, and nobody foresees which is the largest.
    const size_t upper = size[0] <= size[1], last = upper + (2 - upper) * (size[2] >= std::max(size[0], size[1]));
    bent_ = size[last] != 0;
    order_ = kOrders[last];
    if (!bent_) return;
    const int shift = static_cast<int>(std::bit_width(size[last])) - 12;
    if (shift > 0) [[likely]] {
      for (size_t i = 0; i < 4; ++i) normal_[i] = normal[i] >> shift;
    } else {
      for (size_t i = 0; i < 4; ++i) normal_[i] = normal[i] * (1 << -shift);
    }
    inverse_ = (1 << 24) / normal_[last];
  }

  /// It tells something about the third component to be coded.
  bool bent() const { return bent_; }
  /// Which component is coded at a place: last, of three, the one that the plane determines best.
  size_t component(size_t place) const { return order_[place]; }
  /// 12 binary digits per component.
  const std::array<int32_t, 4>& normal() const { return normal_; }

  /// How far the plane is from the prediction of the third component, as the others are away from theirs, and how much
  /// of that is to be believed. `scale`: the usual error; `situation`: below kSituations.
  [[gnu::always_inline]] int64_t correction(int64_t first, int64_t second, int32_t scale, uint32_t situation) {
    const int64_t sum = normal_[order_[0]] * first + normal_[order_[1]] * second;
    correction_ = -sum * inverse_ >> 24;
    length_ = bitLength(static_cast<uint32_t>(scale));
    limit_ = 4 * int64_t{scale} + 64;
    gain_ = &gains_[static_cast<uint32_t>(std::min(length_, 15)) * kSituations + situation];
    believed_ = *gain_ * correction_ >> 12;
    return believed_;
  }

  /// The third component was `error` from its corrected prediction.
  [[gnu::always_inline]] void learn(int64_t error) {
    const int64_t off = error + believed_;
    if (std::max(off < 0 ? -off : off, correction_ < 0 ? -correction_ : correction_) > limit_) return;
    const int64_t step = std::clamp<int64_t>(error * correction_ * 64 >> 2 * length_, -512, 512);
    *gain_ = static_cast<int32_t>(std::clamp<int64_t>(*gain_ + step, -512, 4608));
  }

  static constexpr uint32_t kSituations = 6;

 private:
  using Order = std::array<uint8_t, 4>;
  static constexpr std::array<Order, 3> kOrders = {{{1, 2, 0, 3}, {0, 2, 1, 3}, {0, 1, 2, 3}}};

  std::array<int32_t, 16 * kSituations> gains_;  // in 1/4096
  Order order_ = kOrders[2];
  bool bent_ = false;
  std::array<int32_t, 4> normal_{};
  int32_t inverse_ = 0;  // 2^24 / the last component

  // Of the current site.
  int64_t correction_ = 0, believed_ = 0, limit_ = 0;
  int length_ = 0;
  int32_t* gain_ = nullptr;
};

}  // namespace tutte::values
