#pragma once
// How a copy of a component lies to its original: an affine map, found from the values that are known of both.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "codec/value_geometry.h"
#include "codec/value_nodes.h"
#include "codec/value_tables.h"

namespace tutte::values {

/// Values that are only moved: all differences are the original's.
template <int C>
class Motion {
 public:
  bool known() const { return known_; }

  /// The image of a value, in 1/16.
  template <class T>
  Vec<C, T> applied(const Vec<C, int32_t>& value) const {
    Vec<C, T> image{};
    for (size_t i = 0; i < image.size(); ++i) image[i] = (T{to_[i]} + value[i] - from_[i]) * (T{1} << kFraction);
    return image;
  }

  /// A value of the original, and the copy's.
  void learn(const Vec<C, int32_t>& from, const Vec<C, int32_t>& to, bool /*turns*/) {
    if (known_) return;
    from_ = from;
    to_ = to;
    known_ = true;
  }

 private:
  bool known_ = false;
  Vec<C, int32_t> from_{}, to_{};
};

/// Points of space, whose fourth component is not used, may also be turned and stretched. They are below 2^20.
template <>
class Motion<4> {
 public:
  bool known() const { return known_; }

  template <class T>
  Vec<4, T> applied(const Vec<4, int32_t>& point) const {
    Vec<4, T> image{};
    for (size_t i = 0; i < 4; ++i) image[i] = (T{to_[i]} + point[i] - from_[i]) * (T{1} << kFraction);
    if (!solved_) return image;
    const Vector3 d = difference(point, from_);
    for (int i = 0; i < 3; ++i) {
      const int64_t turned = rows_[i][0] * d[0] + rows_[i][1] * d[1] + rows_[i][2] * d[2];
      const int64_t place = (int64_t{to_[i]} << kFraction) + (turned >> (kBits - kFraction + shift_));
      image[i] = static_cast<T>(std::clamp<int64_t>(place, -kLimit, kLimit));
    }
    return image;
  }

  /// `turns`: not only moved.
  void learn(const Vec<4, int32_t>& from, const Vec<4, int32_t>& to, bool turns) {
    if (!known_) {
      from_ = from;
      to_ = to;
      known_ = true;
      return;
    }
    if (!turns) return;
    const Pair pair{difference(from, from_), difference(to, to_)};
    const bool changed = extend(pair), turned_before = turned_;
    for (int i = 0; i < 3; ++i) turned_ |= std::abs(pair.from[i] - pair.to[i]) > kRounding;
    if (turned_ && (changed || !turned_before)) solve();
  }

 private:
  static constexpr int kBits = 16, kLargest = 18;
  static constexpr int64_t kLimit = int64_t{1} << 25, kRounding = 1, kThickness = 6;
  static constexpr int64_t kSteepest = int64_t{1} << (kBits + 4);

  // Ways from the first point to another one.
  struct Pair {
    Vector3 from, to;
  };

  static Vector3 difference(const Vec<4, int32_t>& a, const Vec<4, int32_t>& b) {
    return {int64_t{a[0]} - b[0], int64_t{a[1]} - b[1], int64_t{a[2]} - b[2]};
  }

  // How much space ways span: a length, an area or a volume, by the largest component.
  static int64_t span(const std::array<Pair, 3>& basis, int count) {
    if (count == 1) return largestMagnitude(basis[0].from);
    const Vector3 area = cross(basis[0].from, basis[1].from);
    return count == 2 ? largestMagnitude(area) : std::abs(dot(area, basis[2].from));
  }

  // Takes a pair into the basis: if it leads out of what is spanned, by more than rounding explains, or makes that
  // twice as large. True when the basis has changed.
  bool extend(const Pair& pair) {
    std::array<Pair, 3> best = basis_;
    int64_t widest = span_;
    if (count_ < 3) {
      best[count_] = pair;
      widest = span(best, count_ + 1);
      if (widest > kThickness * span_) return take(best, count_ + 1, widest);
    }
    widest = span_;
    for (int place = 0; place < count_; ++place) {
      std::array<Pair, 3> tried = basis_;
      tried[place] = pair;
      const int64_t here = span(tried, count_);
      if (here <= widest || here / 2 < span_) continue;
      best = tried;
      widest = here;
    }
    return widest != span_ && take(best, count_, widest);
  }

  bool take(const std::array<Pair, 3>& basis, int count, int64_t span) {
    basis_ = basis;
    count_ = count;
    span_ = span;
    return true;
  }

  // Two ways are enough for what is only turned: the third one stands upright on them.
  void solve() {
    if (count_ < 2) return;
    std::array<Pair, 3> basis = basis_;
    if (count_ == 2) {
      Vector3 from = cross(basis[0].from, basis[1].from), to = cross(basis[0].to, basis[1].to);
      while (std::max(largestMagnitude(from), largestMagnitude(to)) >= int64_t{1} << kLargest) {
        for (int i = 0; i < 3; ++i) from[i] >>= 1, to[i] >>= 1;
      }
      basis[2] = {from, to};
    }
    invert(basis);
  }

  // rows_ = to * adjoint(from) / det(from)
  void invert(const std::array<Pair, 3>& basis) {
    std::array<Vector3, 3> from{basis[0].from, basis[1].from, basis[2].from};
    shift_ = 0;
    while (std::max({largestMagnitude(from[0]), largestMagnitude(from[1]), largestMagnitude(from[2])}) >=
           int64_t{1} << kLargest) {
      for (Vector3& way : from) {
        for (int64_t& x : way) x >>= 1;
      }
      ++shift_;
    }
    const std::array<Vector3, 3> adjoint{cross(from[1], from[2]), cross(from[2], from[0]), cross(from[0], from[1])};
    const int64_t volume = dot(adjoint[0], from[0]);
    solved_ = volume != 0;
    if (!solved_) return;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        int64_t sum = 0;
        for (int k = 0; k < 3; ++k) sum += basis[k].to[i] * adjoint[k][j];
        rows_[i][j] = std::clamp(quotient(sum, volume), -kSteepest, kSteepest);
      }
    }
  }

  // a / b with kBits binary digits, towards 0. |a| < 2^60, |b| < 2^58.
  static int64_t quotient(int64_t a, int64_t b) {
    const bool negative = (a < 0) != (b < 0);
    a = std::abs(a);
    b = std::abs(b);
    int64_t result = std::min(a / b, kSteepest);
    a %= b;
    for (int bit = 0; bit < kBits; bit += 4) {
      a <<= 4;
      result = result << 4 | a / b;
      a %= b;
    }
    return negative ? -result : result;
  }

  bool known_ = false, turned_ = false, solved_ = false;
  Vec<4, int32_t> from_{}, to_{};  // the first point of both
  std::array<Pair, 3> basis_{};
  int count_ = 0, shift_ = 0;
  int64_t span_ = 0;
  std::array<Vector3, 3> rows_{};
};

}  // namespace tutte::values
