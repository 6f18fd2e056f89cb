#include "tools/places.h"

#include <cmath>

namespace tutte {
namespace {

Matrix multiply(const Matrix& a, const Matrix& b) {
  Matrix product{};
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      for (int i = 0; i < 4; ++i) product[4 * column + row] += a[4 * i + row] * b[4 * column + i];
    }
  }
  return product;
}

}  // namespace

std::vector<Place> placesOf(const Scene& scene) {
  std::vector<uint8_t> is_child(scene.nodes.size()), shown(scene.meshes.size());
  for (const SceneNode& node : scene.nodes) {
    for (Index child : node.children) is_child[child] = 1;
  }
  std::vector<std::pair<Index, Matrix>> open;
  for (Index node = 0; node < scene.nodes.size(); ++node) {
    if (!is_child[node]) open.push_back({node, scene.nodes[node].matrix});
  }
  std::vector<Place> places;
  for (size_t i = 0; i < open.size(); ++i) {
    const auto [number, matrix] = open[i];
    const SceneNode& node = scene.nodes[number];
    for (Index mesh : node.meshes) places.push_back({mesh, matrix}), shown[mesh] = 1;
    for (Index child : node.children) open.push_back({child, multiply(matrix, scene.nodes[child].matrix)});
  }
  for (Index mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    if (!shown[mesh]) places.push_back({mesh});
  }
  return places;
}

std::array<double, 3> transformPoint(const Matrix& matrix, const std::array<double, 3>& point) {
  if (matrix == kIdentity) return point;
  std::array<double, 3> result;
  for (int row = 0; row < 3; ++row) {
    result[row] = matrix[row] * point[0] + matrix[4 + row] * point[1] + matrix[8 + row] * point[2] + matrix[12 + row];
  }
  return result;
}

std::array<double, 3> transformNormal(const Matrix& matrix, const std::array<double, 3>& normal) {
  if (matrix == kIdentity) return normal;
  // The cofactors of the upper left 3x3 part: its inverse transposed, up to a factor.
  std::array<double, 3> result{};
  for (int row = 0; row < 3; ++row) {
    const int r1 = (row + 1) % 3, r2 = (row + 2) % 3;
    for (int column = 0; column < 3; ++column) {
      const int c1 = (column + 1) % 3, c2 = (column + 2) % 3;
      const double cofactor = matrix[4 * c1 + r1] * matrix[4 * c2 + r2] - matrix[4 * c2 + r1] * matrix[4 * c1 + r2];
      result[row] += cofactor * normal[column];
    }
  }
  const double length = std::hypot(result[0], result[1], result[2]);
  for (double& value : result) value = length > 0 ? value / length : 0;
  return result;
}

double largestScale(const Matrix& matrix) {
  double sum = 0;
  for (int i = 0; i < 12; ++i) sum += i % 4 == 3 ? 0 : matrix[i] * matrix[i];
  return matrix == kIdentity ? 1 : std::sqrt(sum);
}

}  // namespace tutte
