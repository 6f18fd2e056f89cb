#pragma once
// Eight 16-bit integers at a time, with the few operations that mixing needs. All variants give the same bits.

#include <algorithm>
#include <array>
#include <cstdint>

#if defined(__SSSE3__)
#include <tmmintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace tutte {

#if defined(__SSE2__)

class Lanes {
 public:
  explicit Lanes(const std::array<int16_t, 8>& a)
      : lanes_(_mm_setr_epi16(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7])) {}

  /// From and to memory that is aligned to 16 bytes.
  static Lanes load(const int16_t* from) { return Lanes(_mm_load_si128(reinterpret_cast<const __m128i*>(from))); }
  void store(int16_t* to) const { _mm_store_si128(reinterpret_cast<__m128i*>(to), lanes_); }

  /// This plus input * rate / 32768, rounded, per lane, within 16 bits. |input| < 32768.
  Lanes plusProduct(Lanes input, int16_t rate) const {
    const __m128i in = input.lanes_, rates = _mm_set1_epi16(rate);
#if defined(__SSSE3__)
    const __m128i product = _mm_mulhrs_epi16(in, rates);
#else
    const __m128i high = _mm_mulhi_epi16(in, rates), low = _mm_mullo_epi16(in, rates);
    const __m128i rounded = _mm_avg_epu16(_mm_srli_epi16(low, 14), _mm_setzero_si128());
    const __m128i product = _mm_add_epi16(_mm_add_epi16(high, high), rounded);
#endif
    return Lanes(_mm_adds_epi16(lanes_, product));
  }

  /// Sums of products of neighbours.
  struct Sums {
    __m128i sums;
    Sums operator+(Sums other) const { return {_mm_add_epi32(sums, other.sums)}; }
    int32_t total() const {
      const __m128i two = _mm_add_epi32(sums, _mm_shuffle_epi32(sums, 0x4E));
      return _mm_cvtsi128_si32(_mm_add_epi32(two, _mm_shuffle_epi32(two, 0xB1)));
    }
  };
  Sums times(Lanes other) const { return {_mm_madd_epi16(lanes_, other.lanes_)}; }

 private:
  explicit Lanes(__m128i lanes) : lanes_(lanes) {}

  __m128i lanes_;
};

#elif defined(__wasm_simd128__)

class Lanes {
 public:
  explicit Lanes(const std::array<int16_t, 8>& a)
      : lanes_(wasm_i16x8_make(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7])) {}

  static Lanes load(const int16_t* from) { return Lanes(wasm_v128_load(from)); }
  void store(int16_t* to) const { wasm_v128_store(to, lanes_); }

  Lanes plusProduct(Lanes input, int16_t rate) const {
    return Lanes(wasm_i16x8_add_sat(lanes_, wasm_i16x8_q15mulr_sat(input.lanes_, wasm_i16x8_splat(rate))));
  }

  struct Sums {
    v128_t sums;
    Sums operator+(Sums other) const { return {wasm_i32x4_add(sums, other.sums)}; }
    int32_t total() const {
      const v128_t two = wasm_i32x4_add(sums, wasm_i32x4_shuffle(sums, sums, 2, 3, 0, 1));
      return wasm_i32x4_extract_lane(wasm_i32x4_add(two, wasm_i32x4_shuffle(two, two, 1, 0, 3, 2)), 0);
    }
  };
  Sums times(Lanes other) const { return {wasm_i32x4_dot_i16x8(lanes_, other.lanes_)}; }

 private:
  explicit Lanes(v128_t lanes) : lanes_(lanes) {}

  v128_t lanes_;
};

#else

class Lanes {
 public:
  explicit Lanes(const std::array<int16_t, 8>& lanes) : lanes_(lanes) {}

  static Lanes load(const int16_t* from) {
    std::array<int16_t, 8> lanes;
    std::copy_n(from, 8, lanes.begin());
    return Lanes(lanes);
  }
  void store(int16_t* to) const { std::copy_n(lanes_.begin(), 8, to); }

  Lanes plusProduct(Lanes input, int16_t rate) const {
    Lanes result = *this;
    for (int i = 0; i < 8; ++i) {
      const int32_t sum = lanes_[i] + ((input.lanes_[i] * rate + 0x4000) >> 15);
      result.lanes_[i] = static_cast<int16_t>(std::clamp(sum, -32768, 32767));
    }
    return result;
  }

  struct Sums {
    uint32_t sum;  // wraps as vectors do, where damaged input makes it
    Sums operator+(Sums other) const { return {sum + other.sum}; }
    int32_t total() const { return static_cast<int32_t>(sum); }
  };
  Sums times(Lanes other) const {
    uint32_t sum = 0;
    for (int i = 0; i < 8; ++i) sum += static_cast<uint32_t>(lanes_[i] * other.lanes_[i]);
    return {sum};
  }

 private:
  std::array<int16_t, 8> lanes_;
};

#endif

}  // namespace tutte
