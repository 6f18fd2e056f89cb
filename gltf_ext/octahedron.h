#pragma once
// Unit vectors as points of an octahedron unfolded onto a square, in the convention of Draco's normal predictors.

#include <array>
#include <cstdint>

namespace tutte {

/// A point of the square: both coordinates in [0, 2 * octahedronCentre(bits)].
using OctahedronPoint = std::array<int32_t, 2>;

/// The coordinate of the square's middle, for `bits` bits per coordinate (2 to 24).
constexpr int32_t octahedronCentre(int bits) { return (1 << (bits - 1)) - 1; }

/// The grid point of a vector that is not 0: no component of pointToVector() differs from the unit vector along it by
/// more than 2.2 / octahedronCentre(bits).
OctahedronPoint vectorToPoint(const std::array<double, 3>& vector, int bits);

/// The unit vector of a grid point, by a fixed formula: fold the square back to integers (x, y, z) with
/// |x| + |y| + |z| = centre, divide each by sqrt(x^2 + y^2 + z^2) in double precision, round to float. The same on
/// every platform.
std::array<float, 3> pointToVector(const OctahedronPoint& point, int bits);

}  // namespace tutte
