#pragma once
// Logistic mixing: several adaptive probabilities of one binary decision become one, with weights that learn which of
// them to trust. 16-bit integers, eight at a time; the vector code and the scalar code give the same bits.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "codec/logistic.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace tutte {

/// An adaptive probability (high 16 bits) and how often it was updated (low 16 bits), in one word.
class Slot {
 public:
  int16_t stretched() const { return logistic::kStretch4[word_ >> 20]; }
  uint32_t probability() const { return word_ >> 16; }
  uint32_t seen() const { return word_ & 0xFFFF; }

  void update(bool bit) {
    const uint32_t seen = word_ & 0xFFFF;
    const int64_t error = (bit ? 65535 : 0) - static_cast<int64_t>(word_ >> 16);
    word_ += static_cast<uint32_t>((error * kRate[seen]) >> 16) << 16;
    word_ += seen < kLimit;
  }

 private:
  static constexpr uint32_t kLimit = 255;
  // 65536 / (n + 1.9)
  static constexpr std::array<int32_t, kLimit + 1> kRate = [] {
    std::array<int32_t, kLimit + 1> rate{};
    for (uint32_t n = 0; n <= kLimit; ++n) rate[n] = static_cast<int32_t>(655360 / (10 * n + 19));
    return rate;
  }();

  uint32_t word_ = 0x80000000u;
};

/// `kInputs` weights (a multiple of 8), 16384 standing for 1.
template <int kInputs>
struct alignas(16) Lanes {
  std::array<int16_t, kInputs> lane{};

  /// Sum of products, modulo 2^32.
  int32_t dot(const Lanes& other) const {
#if defined(__SSE2__)
    __m128i sum = _mm_setzero_si128();
    for (int i = 0; i < kInputs; i += 8) sum = _mm_add_epi32(sum, _mm_madd_epi16(load(i), other.load(i)));
    sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, 0x4E));
    sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, 0xB1));
    return _mm_cvtsi128_si32(sum);
#elif defined(__wasm_simd128__)
    v128_t sum = wasm_i32x4_splat(0);
    for (int i = 0; i < kInputs; i += 8) sum = wasm_i32x4_add(sum, wasm_i32x4_dot_i16x8(load(i), other.load(i)));
    return wasm_i32x4_extract_lane(sum, 0) + wasm_i32x4_extract_lane(sum, 1) + wasm_i32x4_extract_lane(sum, 2) +
           wasm_i32x4_extract_lane(sum, 3);
#else
    uint32_t sum = 0;  // wraps as vectors do, where damaged input makes it
    for (int i = 0; i < kInputs; ++i) sum += static_cast<uint32_t>(lane[i] * other.lane[i]);
    return static_cast<int32_t>(sum);
#endif
  }

  /// Adds input * rate / 32768, rounded, to every lane, within 16 bits.
  void learn(const Lanes& input, int16_t rate) {
#if defined(__SSE2__)
    const __m128i rates = _mm_set1_epi16(rate), one = _mm_set1_epi16(1);
    for (int i = 0; i < kInputs; i += 8) {
      const __m128i in = input.load(i);
      const __m128i high = _mm_mulhi_epi16(in, rates), low = _mm_mullo_epi16(in, rates);
      const __m128i rounded = _mm_srli_epi16(_mm_add_epi16(_mm_srli_epi16(low, 14), one), 1);
      const __m128i step = _mm_add_epi16(_mm_slli_epi16(high, 1), rounded);
      _mm_store_si128(reinterpret_cast<__m128i*>(&lane[i]), _mm_adds_epi16(load(i), step));
    }
#elif defined(__wasm_simd128__)
    const v128_t rates = wasm_i16x8_splat(rate);
    for (int i = 0; i < kInputs; i += 8) {
      wasm_v128_store(&lane[i], wasm_i16x8_add_sat(load(i), wasm_i16x8_q15mulr_sat(input.load(i), rates)));
    }
#else
    for (int i = 0; i < kInputs; ++i) {
      const int32_t sum = lane[i] + ((input.lane[i] * rate + 0x4000) >> 15);
      lane[i] = static_cast<int16_t>(std::clamp(sum, -32768, 32767));
    }
#endif
  }

 private:
#if defined(__SSE2__)
  __m128i load(int i) const { return _mm_load_si128(reinterpret_cast<const __m128i*>(&lane[i])); }
#elif defined(__wasm_simd128__)
  v128_t load(int i) const { return wasm_v128_load(&lane[i]); }
#endif
};

/// The learning rate of a stream's weights: high at first, falling with the number of decisions.
class LearningRate {
 public:
  /// Must be called once per decision.
  void advance() {
    if ((decisions_++ & 63) == 0) rate_ = 200 + 1500 * 4000 / (4000 + static_cast<int64_t>(decisions_));
  }

  /// The weights' step for an error in 1/65536 of a probability.
  int16_t step(int32_t error) const { return static_cast<int16_t>((error * rate_) >> 13); }

 private:
  uint64_t decisions_ = 0;
  int64_t rate_ = 0;
};

/// A final correction: maps (decision, mixed probability) to what was seen there, between 33 points per decision.
class FinalMap {
 public:
  explicit FinalMap(int decisions) : points_(static_cast<size_t>(decisions)) {
    for (auto& point : points_) {
      for (int i = 0; i < 33; ++i) point[i] = static_cast<uint16_t>(squash(std::clamp(i * 128 - 2048, -2047, 2047)));
    }
  }

  uint32_t refine(int decision, int32_t stretched) {
    const int32_t position = stretched + 2048;
    at_ = &points_[static_cast<size_t>(decision)][static_cast<size_t>(position >> 7)];
    part_ = position & 127;
    return (at_[0] * static_cast<uint32_t>(128 - part_) + at_[1] * static_cast<uint32_t>(part_)) >> 7;
  }

  void update(bool bit) {
    const int32_t target = bit ? 65535 : 0;
    at_[0] = static_cast<uint16_t>(at_[0] + ((target - at_[0]) * (128 - part_) >> 13));
    at_[1] = static_cast<uint16_t>(at_[1] + ((target - at_[1]) * part_ >> 13));
  }

 private:
  std::vector<std::array<uint16_t, 33>> points_;
  uint16_t* at_ = nullptr;
  int32_t part_ = 0;
};

}  // namespace tutte
