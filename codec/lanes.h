#pragma once
// Eight 16-bit integers at a time, with the few operations that mixing needs: for SSE, for WebAssembly, and without
// vectors. All give the same bits.

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

  /// This and that, taken without sign: (this * that) / 65536.
  Lanes highProduct(Lanes other) const { return Lanes(_mm_mulhi_epu16(lanes_, other.lanes_)); }
  Lanes operator-(Lanes other) const { return Lanes(_mm_sub_epi16(lanes_, other.lanes_)); }
  Lanes operator^(Lanes other) const { return Lanes(_mm_xor_si128(lanes_, other.lanes_)); }
  template <int kShift>
  Lanes shifted() const {
    return Lanes(_mm_srli_epi16(lanes_, kShift));
  }
  Lanes atLeast(int16_t least) const { return Lanes(_mm_max_epi16(lanes_, _mm_set1_epi16(least))); }
  /// One lane, without sign.
  template <int kLane>
  uint32_t lane() const {
    return static_cast<uint32_t>(_mm_extract_epi16(lanes_, kLane));
  }
  static Lanes all(int16_t value) { return Lanes(_mm_set1_epi16(value)); }

  /// The high or the low halves of eight words.
  struct Halves;
  static Halves split(const std::array<uint32_t, 8>& words);
  static std::array<uint32_t, 8> join(const Halves& halves);

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

struct Lanes::Halves {
  Lanes high, low;
};

inline Lanes::Halves Lanes::split(const std::array<uint32_t, 8>& w) {
  const auto word = [&](int i) { return static_cast<int>(w[i]); };
  const __m128i first = _mm_setr_epi32(word(0), word(1), word(2), word(3));
  const __m128i second = _mm_setr_epi32(word(4), word(5), word(6), word(7));
  const auto lows = [](__m128i words) { return _mm_srai_epi32(_mm_slli_epi32(words, 16), 16); };
  return {Lanes(_mm_packs_epi32(_mm_srai_epi32(first, 16), _mm_srai_epi32(second, 16))),
          Lanes(_mm_packs_epi32(lows(first), lows(second)))};
}

inline std::array<uint32_t, 8> Lanes::join(const Halves& halves) {
  const __m128i first = _mm_unpacklo_epi16(halves.low.lanes_, halves.high.lanes_);
  const __m128i second = _mm_unpackhi_epi16(halves.low.lanes_, halves.high.lanes_);
  const auto word = [](__m128i words) { return static_cast<uint32_t>(_mm_cvtsi128_si32(words)); };
  return {word(first),
          word(_mm_shuffle_epi32(first, 0x55)),
          word(_mm_unpackhi_epi32(first, first)),
          word(_mm_shuffle_epi32(first, 0xFF)),
          word(second),
          word(_mm_shuffle_epi32(second, 0x55)),
          word(_mm_unpackhi_epi32(second, second)),
          word(_mm_shuffle_epi32(second, 0xFF))};
}

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

  Lanes highProduct(Lanes other) const {
    const v128_t low = wasm_u32x4_extmul_low_u16x8(lanes_, other.lanes_);
    const v128_t high = wasm_u32x4_extmul_high_u16x8(lanes_, other.lanes_);
    return Lanes(wasm_i16x8_shuffle(low, high, 1, 3, 5, 7, 9, 11, 13, 15));
  }
  Lanes operator-(Lanes other) const { return Lanes(wasm_i16x8_sub(lanes_, other.lanes_)); }
  Lanes operator^(Lanes other) const { return Lanes(wasm_v128_xor(lanes_, other.lanes_)); }
  template <int kShift>
  Lanes shifted() const {
    return Lanes(wasm_u16x8_shr(lanes_, kShift));
  }
  Lanes atLeast(int16_t least) const { return Lanes(wasm_i16x8_max(lanes_, wasm_i16x8_splat(least))); }
  template <int kLane>
  uint32_t lane() const {
    return wasm_u16x8_extract_lane(lanes_, kLane);
  }
  static Lanes all(int16_t value) { return Lanes(wasm_i16x8_splat(value)); }

  struct Halves;
  static Halves split(const std::array<uint32_t, 8>& words);
  static std::array<uint32_t, 8> join(const Halves& halves);

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

struct Lanes::Halves {
  Lanes high, low;
};

inline Lanes::Halves Lanes::split(const std::array<uint32_t, 8>& w) {
  const v128_t first = wasm_u32x4_make(w[0], w[1], w[2], w[3]), second = wasm_u32x4_make(w[4], w[5], w[6], w[7]);
  return {Lanes(wasm_i16x8_shuffle(first, second, 1, 3, 5, 7, 9, 11, 13, 15)),
          Lanes(wasm_i16x8_shuffle(first, second, 0, 2, 4, 6, 8, 10, 12, 14))};
}

inline std::array<uint32_t, 8> Lanes::join(const Halves& halves) {
  const v128_t first = wasm_i16x8_shuffle(halves.low.lanes_, halves.high.lanes_, 0, 8, 1, 9, 2, 10, 3, 11);
  const v128_t second = wasm_i16x8_shuffle(halves.low.lanes_, halves.high.lanes_, 4, 12, 5, 13, 6, 14, 7, 15);
  return {wasm_u32x4_extract_lane(first, 0),  wasm_u32x4_extract_lane(first, 1),  wasm_u32x4_extract_lane(first, 2),
          wasm_u32x4_extract_lane(first, 3),  wasm_u32x4_extract_lane(second, 0), wasm_u32x4_extract_lane(second, 1),
          wasm_u32x4_extract_lane(second, 2), wasm_u32x4_extract_lane(second, 3)};
}

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

  Lanes highProduct(Lanes other) const {
    return each(other, [](uint32_t a, uint32_t b) { return a * b >> 16; });
  }
  Lanes operator-(Lanes other) const {
    return each(other, [](uint32_t a, uint32_t b) { return a - b; });
  }
  Lanes operator^(Lanes other) const {
    return each(other, [](uint32_t a, uint32_t b) { return a ^ b; });
  }
  template <int kShift>
  Lanes shifted() const {
    return each(*this, [](uint32_t a, uint32_t) { return a >> kShift; });
  }
  Lanes atLeast(int16_t least) const {
    Lanes result = *this;
    for (int16_t& lane : result.lanes_) lane = std::max(lane, least);
    return result;
  }
  template <int kLane>
  uint32_t lane() const {
    return static_cast<uint16_t>(lanes_[kLane]);
  }
  static Lanes all(int16_t value) {
    std::array<int16_t, 8> lanes;
    lanes.fill(value);
    return Lanes(lanes);
  }

  struct Halves;
  static Halves split(const std::array<uint32_t, 8>& words);
  static std::array<uint32_t, 8> join(const Halves& halves);

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
  template <class Operation>
  Lanes each(const Lanes& other, Operation operation) const {
    Lanes result = *this;
    for (int i = 0; i < 8; ++i) {
      const uint32_t value = operation(static_cast<uint16_t>(lanes_[i]), static_cast<uint16_t>(other.lanes_[i]));
      result.lanes_[i] = static_cast<int16_t>(value);
    }
    return result;
  }

  std::array<int16_t, 8> lanes_;
};

struct Lanes::Halves {
  Lanes high, low;
};

inline Lanes::Halves Lanes::split(const std::array<uint32_t, 8>& words) {
  std::array<int16_t, 8> high, low;
  for (int i = 0; i < 8; ++i) {
    high[i] = static_cast<int16_t>(words[i] >> 16);
    low[i] = static_cast<int16_t>(words[i] & 0xFFFF);
  }
  return {Lanes(high), Lanes(low)};
}

inline std::array<uint32_t, 8> Lanes::join(const Halves& halves) {
  std::array<uint32_t, 8> words;
  for (int i = 0; i < 8; ++i) {
    words[i] = static_cast<uint32_t>(halves.high.lanes_[i]) << 16 | static_cast<uint16_t>(halves.low.lanes_[i]);
  }
  return words;
}

#endif

}  // namespace tutte
