#pragma once
// Where a site has several parallelograms, one of them may be a better prediction than their average: which one is
// said.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "codec/logistic.h"
#include "codec/value_model.h"
#include "codec/value_stencil.h"
#include "codec/value_tables.h"

namespace tutte::values {

template <int C, class T>
class Picks {
 public:
  Picks() { chances_.fill(Chance(6160)); }

  /// Makes one of at least two members the stencil's base, or not. A writer takes what is best for the first `width`
  /// components of `wanted`.
  template <class Port>
  [[gnu::always_inline]] bool code(Port& port, Stencil<C, T>& stencil, const Vec<C, int32_t>& wanted, int width) {
    T spread = 0;
    for (size_t i = 0; i < C; ++i) spread += stencil.spread[i];
    const int level = std::min((bitLength(small(spread) + 4) - 3) >> 1, 5);
    const uint32_t count = static_cast<uint32_t>(std::min(stencil.member_count, 4)) - 2;
    const uint32_t within = stencil.source == Source::kWithin ? 1 : 0;
    Chance& chance = chances_[((within * 3 + count) * 2 + last_) * 6 + static_cast<uint32_t>(level)];
    int choice = 0;
    if constexpr (Port::kWriting) choice = best(stencil, chance, wanted, width);
    last_ = chance.code(port, choice > 0);
    if (!last_) return false;
    int m = 0;
    std::array<Chance, Stencil<C, T>::kMostMembers>& row = indices_[count];
    while (m + 1 < stencil.member_count && !row[m].code(port, choice - 1 == m)) ++m;
    stencil.base = stencil.members[m];
    return true;
  }

 private:
  // 0: the average; m + 1: parallelogram m. Costs are in quarters of bits.
  int best(const Stencil<C, T>& stencil, const Chance& chance, const Vec<C, int32_t>& wanted, int width) const {
    const auto cost = [&](const Vec<C, T>& prediction) {
      int32_t sum = 0;
      for (int i = 0; i < width; ++i) {
        const T off = wanted[i] * T{1 << kFraction} - prediction[i];
        sum += quarterLog(small((off < 0 ? -off : off) + 8));
      }
      return sum;
    };
    int best = 0;
    int32_t least = cost(stencil.base) - 4;
    const int32_t price = -stretch4(chance.one16()) / 118 + (stencil.member_count > 2 ? 4 : 2);
    for (int m = 0; m < stencil.member_count; ++m) {
      const int32_t here = cost(stencil.members[m]) + price;
      if (here >= least) continue;
      least = here;
      best = m + 1;
    }
    return best;
  }

  static uint32_t small(int64_t x) { return static_cast<uint32_t>(std::min<int64_t>(x, 0x7FFFFFF0)); }

  std::array<Chance, 2 * 3 * 2 * 6> chances_;
  std::array<std::array<Chance, Stencil<C, T>::kMostMembers>, 3> indices_;
  bool last_ = false;  // what was said at the last site that had several
};

}  // namespace tutte::values
