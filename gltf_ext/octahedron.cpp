#include "gltf_ext/octahedron.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tutte {
namespace {

/// The integer vector with |x| + |y| + |z| = centre that is nearest along the given one.
std::array<int32_t, 3> onOctahedron(const std::array<double, 3>& vector, int32_t centre) {
  const double largest = std::max({std::fabs(vector[0]), std::fabs(vector[1]), std::fabs(vector[2])});
  const std::array<double, 3> scaled{vector[0] / largest, vector[1] / largest, vector[2] / largest};
  const double sum = std::fabs(scaled[0]) + std::fabs(scaled[1]) + std::fabs(scaled[2]);
  std::array<int32_t, 3> result{};
  for (int i = 0; i < 2; ++i) result[i] = static_cast<int32_t>(std::floor(scaled[i] / sum * centre + 0.5));
  const int32_t rest = centre - std::abs(result[0]) - std::abs(result[1]);
  if (rest < 0) result[1] += result[1] > 0 ? rest : -rest;
  result[2] = std::max(rest, 0);
  if (scaled[2] < 0) result[2] = -result[2];
  return result;
}

/// Points of the square's edge that mean the same vector get one name.
OctahedronPoint canonical(int32_t s, int32_t t, int32_t centre) {
  const int32_t last = 2 * centre;
  const bool corner = (s == 0 || s == last) && (t == 0 || t == last);
  if (corner) return {last, last};
  if (s == 0 && t > centre) return {s, last - t};
  if (s == last && t < centre) return {s, last - t};
  if (t == last && s < centre) return {last - s, t};
  if (t == 0 && s > centre) return {last - s, t};
  return {s, t};
}

}  // namespace

OctahedronPoint vectorToPoint(const std::array<double, 3>& vector, int bits) {
  const int32_t centre = octahedronCentre(bits);
  const auto [x, y, z] = onOctahedron(vector, centre);
  if (x >= 0) return canonical(y + centre, z + centre, centre);
  const int32_t s = y < 0 ? std::abs(z) : 2 * centre - std::abs(z);
  const int32_t t = z < 0 ? std::abs(y) : 2 * centre - std::abs(y);
  return canonical(s, t, centre);
}

std::array<float, 3> pointToVector(const OctahedronPoint& point, int bits) {
  const int32_t centre = octahedronCentre(bits);
  int64_t y = point[0] - centre, z = point[1] - centre;
  const int64_t x = centre - std::abs(y) - std::abs(z);
  const int64_t fold = std::max<int64_t>(-x, 0);
  y += y < 0 ? fold : -fold;
  z += z < 0 ? fold : -fold;
  const double length = std::sqrt(static_cast<double>(x * x + y * y + z * z));
  return {static_cast<float>(static_cast<double>(x) / length), static_cast<float>(static_cast<double>(y) / length),
          static_cast<float>(static_cast<double>(z) / length)};
}

}  // namespace tutte
