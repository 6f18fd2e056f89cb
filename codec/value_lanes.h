#pragma once
// Sixteen 16-bit numbers at once. Vector code and scalar code give the same bits.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace tutte::values {

inline constexpr int kSymbols = 16;

/// A distribution of 16 symbols: lane i is the probability, in 1/32768, of a symbol above i. It is below 32768 and
/// falls from lane to lane by at least 1. In the last lane is the rate at which it learns, in 1/65536, negative.
struct alignas(32) Distribution {
  std::array<uint16_t, kSymbols> above{};
};

/// Eight numbers of 16 bits with signs, and what is done with them.
namespace lanes {

#if defined(__SSE2__)

using Eight = __m128i;

inline Eight load(const uint16_t* from) { return _mm_load_si128(reinterpret_cast<const __m128i*>(from)); }
inline void store(uint16_t* to, Eight value) { _mm_store_si128(reinterpret_cast<__m128i*>(to), value); }
inline Eight splat(uint32_t value) { return _mm_set1_epi16(static_cast<int16_t>(value)); }
inline Eight average(Eight a, Eight b) { return _mm_avg_epu16(a, b); }
inline Eight withoutLast(Eight eight) { return _mm_and_si128(eight, _mm_setr_epi16(-1, -1, -1, -1, -1, -1, -1, 0)); }
inline Eight splatLast(Eight eight) {
  const __m128i last = _mm_shufflehi_epi16(eight, 0xFF);
  return _mm_unpackhi_epi64(last, last);
}
inline Eight towards(Eight from, Eight to, Eight rate) {
  return _mm_add_epi16(from, _mm_mulhi_epi16(_mm_sub_epi16(from, to), rate));
}
inline uint32_t countAbove(Eight low, Eight high, Eight limit) {
  const __m128i above = _mm_packs_epi16(_mm_cmpgt_epi16(low, limit), _mm_cmpgt_epi16(high, limit));
  return static_cast<uint32_t>(__builtin_ctz(~static_cast<uint32_t>(_mm_movemask_epi8(above))));
}

inline void sumFours(int32_t* sum, const int32_t* fours, size_t stride, std::span<const uint32_t> which) {
  __m128i all = _mm_setzero_si128();
  for (const uint32_t i : which)
    all = _mm_add_epi32(all, _mm_load_si128(reinterpret_cast<const __m128i*>(fours + i * stride)));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(sum), all);
}
inline void addCross(int32_t* sum, const int32_t* origin, const int32_t* first, const int32_t* second, int shift) {
  const auto load4 = [](const int32_t* from) { return _mm_load_si128(reinterpret_cast<const __m128i*>(from)); };
  const auto from = [&](const int32_t* to) {
    const __m128i way = _mm_sra_epi32(_mm_sub_epi32(load4(to), load4(origin)), _mm_cvtsi32_si128(shift));
    return _mm_packs_epi32(way, way);
  };
  const __m128i u = from(first), w = from(second), back = _mm_sub_epi16(_mm_setzero_si128(), u);
  const __m128i a = _mm_unpacklo_epi16(_mm_shufflelo_epi16(u, 0xC9), _mm_shufflelo_epi16(back, 0xD2));
  const __m128i b = _mm_unpacklo_epi16(_mm_shufflelo_epi16(w, 0xD2), _mm_shufflelo_epi16(w, 0xC9));
  const auto target = reinterpret_cast<__m128i*>(sum);
  _mm_store_si128(target, _mm_add_epi32(load4(sum), _mm_madd_epi16(a, b)));
}

#elif defined(__wasm_simd128__)

using Eight = v128_t;

inline Eight load(const uint16_t* from) { return wasm_v128_load(from); }
inline void store(uint16_t* to, Eight value) { wasm_v128_store(to, value); }
inline Eight splat(uint32_t value) { return wasm_i16x8_splat(static_cast<int16_t>(value)); }
inline Eight average(Eight a, Eight b) { return wasm_u16x8_avgr(a, b); }
inline Eight withoutLast(Eight eight) { return wasm_i16x8_replace_lane(eight, 7, 0); }
inline Eight splatLast(Eight eight) { return wasm_i16x8_splat(wasm_i16x8_extract_lane(eight, 7)); }
inline Eight towards(Eight from, Eight to, Eight rate) {
  const v128_t way = wasm_i16x8_sub(from, to);
  const v128_t low = wasm_i32x4_extmul_low_i16x8(way, rate), high = wasm_i32x4_extmul_high_i16x8(way, rate);
  return wasm_i16x8_add(from, wasm_i16x8_shuffle(low, high, 1, 3, 5, 7, 9, 11, 13, 15));
}
inline uint32_t countAbove(Eight low, Eight high, Eight limit) {
  const v128_t above = wasm_i8x16_narrow_i16x8(wasm_i16x8_gt(low, limit), wasm_i16x8_gt(high, limit));
  return static_cast<uint32_t>(__builtin_ctz(~static_cast<uint32_t>(wasm_i8x16_bitmask(above))));
}

inline void sumFours(int32_t* sum, const int32_t* fours, size_t stride, std::span<const uint32_t> which) {
  v128_t all = wasm_i32x4_splat(0);
  for (const uint32_t i : which) all = wasm_i32x4_add(all, wasm_v128_load(fours + i * stride));
  wasm_v128_store(sum, all);
}
inline void addCross(int32_t* sum, const int32_t* origin, const int32_t* first, const int32_t* second, int shift) {
  const auto from = [&](const int32_t* to) {
    const v128_t way = wasm_i32x4_shr(wasm_i32x4_sub(wasm_v128_load(to), wasm_v128_load(origin)), shift);
    return wasm_i16x8_narrow_i32x4(way, way);
  };
  const v128_t u = from(first), w = from(second), back = wasm_i16x8_neg(u);
  const v128_t a = wasm_i16x8_shuffle(u, back, 1, 10, 2, 8, 0, 9, 3, 11);
  const v128_t b = wasm_i16x8_shuffle(w, w, 2, 1, 0, 2, 1, 0, 3, 3);
  wasm_v128_store(sum, wasm_i32x4_add(wasm_v128_load(sum), wasm_i32x4_dot_i16x8(a, b)));
}

#else

using Eight = std::array<int32_t, 8>;

template <class Lane>
Eight each(Lane lane) {
  Eight result;
  for (size_t i = 0; i < 8; ++i) result[i] = lane(i);
  return result;
}
inline Eight load(const uint16_t* from) {
  return each([&](size_t i) { return int32_t{static_cast<int16_t>(from[i])}; });
}
inline void store(uint16_t* to, const Eight& value) {
  for (size_t i = 0; i < 8; ++i) to[i] = static_cast<uint16_t>(value[i]);
}
inline Eight splat(uint32_t value) {
  return each([&](size_t) { return static_cast<int32_t>(value); });
}
/// Rounded up; of numbers of the same sign.
inline Eight average(const Eight& a, const Eight& b) {
  return each([&](size_t i) { return (a[i] + b[i] + 1) >> 1; });
}
inline Eight withoutLast(const Eight& eight) {
  return each([&](size_t i) { return i == 7 ? 0 : eight[i]; });
}
inline Eight splatLast(const Eight& eight) {
  return each([&](size_t) { return eight[7]; });
}
/// from + (to - from) * -rate / 65536, rounded down.
inline Eight towards(const Eight& from, const Eight& to, const Eight& rate) {
  return each([&](size_t i) { return from[i] + ((from[i] - to[i]) * rate[i] >> 16); });
}
/// How many of 16 falling numbers are above a limit.
inline uint32_t countAbove(const Eight& low, const Eight& high, const Eight& limit) {
  uint32_t count = 0;
  for (size_t i = 0; i < 8; ++i) count += uint32_t{low[i] > limit[i]} + uint32_t{high[i] > limit[i]};
  return count;
}
/// The sum of some fours of numbers, which begin `stride` numbers apart at 16-byte boundaries.
inline void sumFours(int32_t* sum, const int32_t* fours, size_t stride, std::span<const uint32_t> which) {
  std::array<int32_t, 4> all{};
  for (const uint32_t i : which) {
    for (size_t k = 0; k < 4; ++k) all[k] += fours[i * stride + k];
  }
  for (size_t k = 0; k < 4; ++k) sum[k] = all[k];
}
/// Adds, modulo 2^32, the cross product of two vectors of three components, all at 16-byte boundaries with a fourth
/// number behind them: the ways from `origin`, shifted right until they fit into 16 bits.
inline void addCross(int32_t* sum, const int32_t* origin, const int32_t* first, const int32_t* second, int shift) {
  std::array<uint32_t, 3> u, w;
  for (size_t i = 0; i < 3; ++i) {
    u[i] = static_cast<uint32_t>((first[i] - origin[i]) >> shift);
    w[i] = static_cast<uint32_t>((second[i] - origin[i]) >> shift);
  }
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
    sum[i] = static_cast<int32_t>(static_cast<uint32_t>(sum[i]) + u[j] * w[k] - u[k] * w[j]);
  }
}

#endif

}  // namespace lanes

/// A distribution to code with: in lanes to search, and in memory to look up.
class Parts {
 public:
  explicit Parts(const Distribution& one) : Parts(lanes::load(&one.above[0]), lanes::load(&one.above[8])) {}
  /// The average of two.
  Parts(const Distribution& a, const Distribution& b)
      : Parts(lanes::average(lanes::load(&a.above[0]), lanes::load(&b.above[0])),
              lanes::average(lanes::load(&a.above[8]), lanes::load(&b.above[8]))) {}

  /// A symbol takes begin() to end() - 1 of 32768.
  uint32_t begin(uint32_t symbol) const { return lane_[size_t{8} + symbol]; }
  uint32_t end(uint32_t symbol) const { return lane_[size_t{7} + symbol]; }

  /// The symbol that takes `position`.
  uint32_t find(uint32_t position) const { return lanes::countAbove(low_, high_, lanes::splat(position)); }

 private:
  Parts(const lanes::Eight& low, const lanes::Eight& high) : low_(low), high_(lanes::withoutLast(high)) {
    lane_[7] = 32768;
    lanes::store(&lane_[8], low_);
    lanes::store(&lane_[16], high_);
  }

  const lanes::Eight low_, high_;
  alignas(16) std::array<uint16_t, 8 + kSymbols> lane_;
};

/// Moves every lane towards `target`, at the rate in the last lane, and that lane, too. Rounded down.
[[gnu::always_inline]] inline void approach(Distribution& distribution, const Distribution& target) {
  const lanes::Eight low = lanes::load(&distribution.above[0]), high = lanes::load(&distribution.above[8]);
  const lanes::Eight rate = lanes::splatLast(high);
  lanes::store(&distribution.above[0], lanes::towards(low, lanes::load(&target.above[0]), rate));
  lanes::store(&distribution.above[8], lanes::towards(high, lanes::load(&target.above[8]), rate));
}

}  // namespace tutte::values
