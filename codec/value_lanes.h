#pragma once
// Sixteen 16-bit numbers at once. Vector code and scalar code give the same bits.

#include <array>
#include <bit>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
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
