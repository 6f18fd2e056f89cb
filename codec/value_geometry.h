#pragma once
// Integer geometry for predictions: roots, unit vectors, the octahedron.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "codec/made_table.h"

namespace tutte::values {

using Vector3 = std::array<int64_t, 3>;

/// The roots of 0 to 255, in 1/16, rounded up from above: kRoots[x] >= 16 sqrt(x + 1).
TUTTE_TABLE std::array<uint16_t, 256> kRoots = madeTable([] {
  std::array<uint16_t, 256> roots{};
  uint16_t root = 0;
  for (uint32_t x = 0; x < 256; ++x) {
    while (uint32_t{root} * root < 256 * (x + 1)) ++root;
    roots[x] = root;
  }
  return roots;
});

/// sqrt(x) to some fourteen binary digits, for x below 2^62; from above, so that Newton's steps fall.
inline int64_t nearRoot(uint64_t x) {
  const int half = std::max(0, (static_cast<int>(std::bit_width(x)) - 7) >> 1);
  const uint64_t root = ((uint64_t{kRoots[x >> 2 * half]} << half) >> 4) + 1;
  return static_cast<int64_t>((root + x / root) >> 1);
}

/// floor(sqrt(x)) for x below 2^62.
inline int64_t squareRoot(uint64_t x) {
  auto root = static_cast<uint64_t>(nearRoot(x));
  // A second step is enough for x below 2^48.
  if (x >= uint64_t{1} << 48) root = (root + x / root) >> 1;
  root = (root + x / root) >> 1;
  return static_cast<int64_t>(root - (root * root > x));
}

inline int64_t dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline int64_t largestMagnitude(const Vector3& v) {
  return std::max({v[0] < 0 ? -v[0] : v[0], v[1] < 0 ? -v[1] : v[1], v[2] < 0 ? -v[2] : v[2]});
}

/// Shifts a vector right until no component has more than `bits` bits.
inline Vector3 shortened(Vector3 v, int bits) {
  const int excess = static_cast<int>(std::bit_width(static_cast<uint64_t>(largestMagnitude(v)))) - bits;
  if (excess > 0) {
    for (int64_t& x : v) x >>= excess;
  }
  return v;
}

inline constexpr int kUnitBits = 14;

/// The vector at length 2^kUnitBits; 0 stays 0.
inline Vector3 unit(Vector3 v) {
  v = shortened(v, 24);
  const int64_t length = squareRoot(static_cast<uint64_t>(dot(v, v)));
  if (length == 0) return {};
  const int64_t inverse = (int64_t{1} << 45) / length;
  for (int64_t& x : v) x = x * inverse >> (45 - kUnitBits);
  return v;
}

/// The length of the cross product of two vectors below 2^21, in 31 bits.
struct Sine {
  explicit Sine(Vector3 product)
      : shift(std::max(0, static_cast<int>(std::bit_width(static_cast<uint64_t>(largestMagnitude(product)))) - 30)) {
    for (int64_t& x : product) x >>= shift;
    value = squareRoot(static_cast<uint64_t>(dot(product, product)));
  }

  int shift;  ///< how many more there were
  int64_t value;
};

/// The angle between two vectors whose products these are, 0 to 2^14 for 0 to 180 degrees, to half a percent.
inline int64_t angle(const Sine& sine, int64_t dot_product) {
  const int64_t cosine = dot_product >> sine.shift;
  const int64_t flat = cosine < 0 ? -cosine : cosine;
  if (sine.value == 0 && flat == 0) return 0;
  const bool steep = sine.value > flat;
  const int64_t t = steep ? (flat << 12) / sine.value : (sine.value << 12) / flat;  // tangent, in 1/4096
  // atan(t) is near t (pi/4 + 0.273 (1 - t)); pi/4 is 4096 here, 0.273 is 1424.
  const int64_t eighth = t * (4096 + (1424 * (4096 - t) >> 12)) >> 12;
  const int64_t quarter = steep ? 8192 - eighth : eighth;
  return cosine < 0 ? 16384 - quarter : quarter;
}

/// A point of the unfolded octahedron, both coordinates in [0, 2 * centre], as a unit vector.
inline Vector3 fromOctahedron(int64_t s, int64_t t, int64_t centre) {
  const auto magnitude = [](int64_t x) { return x < 0 ? -x : x; };
  int64_t y = s - centre, z = t - centre;
  const int64_t x = centre - magnitude(y) - magnitude(z);
  const int64_t fold = std::max<int64_t>(-x, 0);
  y += y < 0 ? fold : -fold;
  z += z < 0 ? fold : -fold;
  return unit({x, y, z});
}

/// The reverse, with kFraction binary digits: coordinates in [0, 2 * centre << fraction]. `v` is not 0 and below 2^24.
inline std::array<int64_t, 2> toOctahedron(const Vector3& v, int64_t centre, int fraction) {
  const auto magnitude = [](int64_t x) { return x < 0 ? -x : x; };
  const int64_t sum = magnitude(v[0]) + magnitude(v[1]) + magnitude(v[2]);
  const int64_t middle = centre << fraction, scale = (middle << 24) / sum;
  const int64_t y = v[1] * scale >> 24, z = v[2] * scale >> 24;
  if (v[0] >= 0) return {y + middle, z + middle};
  return {y < 0 ? magnitude(z) : 2 * middle - magnitude(z), z < 0 ? magnitude(y) : 2 * middle - magnitude(y)};
}

}  // namespace tutte::values
