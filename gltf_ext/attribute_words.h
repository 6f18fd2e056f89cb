#pragma once
// Single values as words, whatever their type.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "gltf_ext/polygon_mesh.h"

namespace tutte {

inline uint32_t loadBytes(const uint8_t* data, uint32_t size) {
  uint32_t value = 0;
  for (uint32_t i = 0; i < size; ++i) value |= uint32_t{data[i]} << (8 * i);
  return value;
}

inline void storeBytes(uint8_t* data, uint32_t size, uint32_t value) {
  for (uint32_t i = 0; i < size; ++i) data[i] = static_cast<uint8_t>(value >> (8 * i));
}

inline float loadFloat(const uint8_t* data) { return std::bit_cast<float>(loadBytes(data, 4)); }

/// As one store, where that is the order of bytes: compilers do not always see it.
[[gnu::always_inline]] inline void storeFourBytes(uint8_t* data, uint32_t value) {
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(data, &value, 4);
  } else {
    storeBytes(data, 4, value);
  }
}
inline void storeFloat(uint8_t* data, float value) { storeFourBytes(data, std::bit_cast<uint32_t>(value)); }

constexpr bool isSigned(ComponentType type) { return type == ComponentType::kInt8 || type == ComponentType::kInt16; }

constexpr uint32_t largestWord(ComponentType type) {
  return sizeOf(type) == 4 ? 0xFFFFFFFFu : (1u << 8 * sizeOf(type)) - 1;
}

/// An unsigned word that grows with the value: signed integers are shifted by half their range; of floats, negative
/// ones have all bits inverted and the others their sign bit set.
inline uint32_t wordOf(const uint8_t* data, ComponentType type) {
  const uint32_t bits = loadBytes(data, sizeOf(type));
  if (type == ComponentType::kFloat) return bits >> 31 ? ~bits : bits | 0x80000000u;
  return isSigned(type) ? bits ^ 1u << (8 * sizeOf(type) - 1) : bits;
}

/// The number of the grid's point that is nearest to a value: origin + number * step.
inline double gridPoint(float value, float origin, float step) {
  return std::floor((double{value} - origin) / step + 0.5);
}

/// The reverse of wordOf(). `word` must not exceed largestWord(type).
inline void storeWord(uint8_t* data, ComponentType type, uint32_t word) {
  if (type == ComponentType::kFloat) word = word >> 31 ? word & 0x7FFFFFFFu : ~word;
  if (isSigned(type)) word ^= 1u << (8 * sizeOf(type) - 1);
  storeBytes(data, sizeOf(type), word);
}

}  // namespace tutte
