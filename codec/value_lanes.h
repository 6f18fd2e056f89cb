#pragma once
// Sixteen 16-bit numbers at once. Vector code and scalar code give the same bits.

#include <array>
#include <bit>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace tutte::values {

inline constexpr int kSymbols = 16;

/// A distribution of 16 symbols: lane i is the probability, in 1/32768, of a symbol above i. It falls from lane to lane
/// by at least 1; the last lane is 0.
struct alignas(32) Distribution {
  std::array<uint16_t, kSymbols> above{};
};

/// The thresholds of a distribution in a range of 2^15 to 2^16 - 1: `at[i]` is where symbols of i and above end, that
/// is, symbol i takes at[i + 1] to at[i] - 1.
struct alignas(32) Thresholds {
  std::array<uint16_t, 2 * kSymbols> lane;  // at[i] is lane[15 + i], so that at[1] begins a vector

  uint32_t at(int symbol) const { return lane[kSymbols - 1 + symbol]; }
};

#if defined(__SSE2__)

namespace lanes {
inline __m128i load(const uint16_t* from) { return _mm_load_si128(reinterpret_cast<const __m128i*>(from)); }
inline void store(uint16_t* to, __m128i value) { _mm_store_si128(reinterpret_cast<__m128i*>(to), value); }
}  // namespace lanes

inline void divide(const Distribution& distribution, uint32_t range, Thresholds& out) {
  const __m128i factor = _mm_set1_epi16(static_cast<int16_t>(range));
  out.lane[kSymbols - 1] = static_cast<uint16_t>(range);
  for (int i = 0; i < kSymbols; i += 8) {
    const __m128i twice = _mm_slli_epi16(lanes::load(&distribution.above[i]), 1);
    lanes::store(&out.lane[kSymbols + i], _mm_mulhi_epu16(twice, factor));
  }
}

/// The symbol whose part of the range `position` is in.
inline int find(const Thresholds& thresholds, uint32_t position) {
  const __m128i here = _mm_set1_epi16(static_cast<int16_t>(position)), zero = _mm_setzero_si128();
  const __m128i low = _mm_cmpeq_epi16(_mm_subs_epu16(lanes::load(&thresholds.lane[16]), here), zero);
  const __m128i high = _mm_cmpeq_epi16(_mm_subs_epu16(lanes::load(&thresholds.lane[24]), here), zero);
  return std::countr_zero(static_cast<uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(low, high))));
}

/// Moves every lane towards `target` by rate / 65536 of the distance, rounded down. rate < 2^15.
inline void approach(Distribution& distribution, const Distribution& target, int32_t rate) {
  const __m128i factor = _mm_set1_epi16(static_cast<int16_t>(rate));
  for (int i = 0; i < kSymbols; i += 8) {
    const __m128i now = lanes::load(&distribution.above[i]);
    const __m128i step = _mm_mulhi_epi16(_mm_sub_epi16(lanes::load(&target.above[i]), now), factor);
    lanes::store(&distribution.above[i], _mm_add_epi16(now, step));
  }
}

/// Lane by lane a + (b - a) * share / 65536, rounded down. share < 2^15.
inline void blend(const Distribution& a, const Distribution& b, int32_t share, Distribution& out) {
  const __m128i factor = _mm_set1_epi16(static_cast<int16_t>(share));
  for (int i = 0; i < kSymbols; i += 8) {
    const __m128i from = lanes::load(&a.above[i]);
    const __m128i step = _mm_mulhi_epi16(_mm_sub_epi16(lanes::load(&b.above[i]), from), factor);
    lanes::store(&out.above[i], _mm_add_epi16(from, step));
  }
}

#elif defined(__wasm_simd128__)

namespace lanes {
inline v128_t load(const uint16_t* from) { return wasm_v128_load(from); }
inline void store(uint16_t* to, v128_t value) { wasm_v128_store(to, value); }

// The upper halves of products of lanes.
inline v128_t highUnsigned(v128_t a, v128_t b) {
  return wasm_i16x8_shuffle(wasm_u32x4_extmul_low_u16x8(a, b), wasm_u32x4_extmul_high_u16x8(a, b), 1, 3, 5, 7, 9, 11,
                            13, 15);
}
inline v128_t highSigned(v128_t a, v128_t b) {
  return wasm_i16x8_shuffle(wasm_i32x4_extmul_low_i16x8(a, b), wasm_i32x4_extmul_high_i16x8(a, b), 1, 3, 5, 7, 9, 11,
                            13, 15);
}
inline v128_t towards(v128_t from, const uint16_t* to, v128_t factor) {
  return wasm_i16x8_add(from, highSigned(wasm_i16x8_sub(load(to), from), factor));
}
}  // namespace lanes

inline void divide(const Distribution& distribution, uint32_t range, Thresholds& out) {
  const v128_t factor = wasm_i16x8_splat(static_cast<int16_t>(range));
  out.lane[kSymbols - 1] = static_cast<uint16_t>(range);
  for (int i = 0; i < kSymbols; i += 8) {
    const v128_t twice = wasm_i16x8_shl(lanes::load(&distribution.above[i]), 1);
    lanes::store(&out.lane[kSymbols + i], lanes::highUnsigned(twice, factor));
  }
}

inline int find(const Thresholds& thresholds, uint32_t position) {
  const v128_t here = wasm_i16x8_splat(static_cast<int16_t>(position));
  const v128_t low = wasm_u16x8_le(lanes::load(&thresholds.lane[16]), here);
  const v128_t high = wasm_u16x8_le(lanes::load(&thresholds.lane[24]), here);
  return std::countr_zero(static_cast<uint32_t>(wasm_i8x16_bitmask(wasm_i8x16_narrow_i16x8(low, high))));
}

inline void approach(Distribution& distribution, const Distribution& target, int32_t rate) {
  const v128_t factor = wasm_i16x8_splat(static_cast<int16_t>(rate));
  for (int i = 0; i < kSymbols; i += 8) {
    const v128_t now = lanes::load(&distribution.above[i]);
    lanes::store(&distribution.above[i], lanes::towards(now, &target.above[i], factor));
  }
}

inline void blend(const Distribution& a, const Distribution& b, int32_t share, Distribution& out) {
  const v128_t factor = wasm_i16x8_splat(static_cast<int16_t>(share));
  for (int i = 0; i < kSymbols; i += 8) {
    lanes::store(&out.above[i], lanes::towards(lanes::load(&a.above[i]), &b.above[i], factor));
  }
}

#else

inline void divide(const Distribution& distribution, uint32_t range, Thresholds& out) {
  out.lane[kSymbols - 1] = static_cast<uint16_t>(range);
  for (int i = 0; i < kSymbols; ++i) {
    out.lane[kSymbols + i] = static_cast<uint16_t>(2u * distribution.above[i] * range >> 16);
  }
}

inline int find(const Thresholds& thresholds, uint32_t position) {
  int symbol = 0;
  for (int i = 1; i < kSymbols; ++i) symbol += thresholds.at(i) > position;
  return symbol;
}

inline void approach(Distribution& distribution, const Distribution& target, int32_t rate) {
  for (int i = 0; i < kSymbols; ++i) {
    const int32_t now = distribution.above[i];
    distribution.above[i] = static_cast<uint16_t>(now + ((target.above[i] - now) * rate >> 16));
  }
}

inline void blend(const Distribution& a, const Distribution& b, int32_t share, Distribution& out) {
  for (int i = 0; i < kSymbols; ++i) {
    const int32_t from = a.above[i];
    out.above[i] = static_cast<uint16_t>(from + ((b.above[i] - from) * share >> 16));
  }
}

#endif

}  // namespace tutte::values
