#pragma once
// Points in the plane by place.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "codec/mesh.h"

namespace tutte {

struct Point2 {
  double x = 0, y = 0;
};

/// A square grid with about two points per cell, to look at the points of a neighbourhood only.
class PointGrid {
 public:
  /// O(points). They must be finite.
  void build(std::span<const Point2> points) {
    Point2 high{-kLargest, -kLargest};
    low_ = {kLargest, kLargest};
    for (const Point2& point : points) {
      low_ = {std::min(low_.x, point.x), std::min(low_.y, point.y)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(points.size()) / 2)), 1, 512);
    scale_ = points.empty() ? 0 : std::min(side_ / std::max(high.x - low_.x, high.y - low_.y), kLargest);
    fill(points);
  }

  /// Calls visit(number of the point) for the points of every cell that the box touches, until it returns true; tells
  /// whether it did. Every cell costs 1 of `budget`.
  template <class Visit>
  bool any(const Point2& low, const Point2& high, int64_t& budget, Visit visit) const {
    for (int y = cell(low.y - low_.y); y <= cell(high.y - low_.y); ++y) {
      for (int x = cell(low.x - low_.x); x <= cell(high.x - low_.x); ++x) {
        const size_t at = static_cast<size_t>(y) * side_ + x;
        --budget;
        for (Index i = starts_[at]; i < starts_[at + 1]; ++i) {
          if (visit(members_[i])) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr double kLargest = std::numeric_limits<double>::max();

  int cell(double offset) const { return static_cast<int>(std::clamp(offset * scale_, 0.0, side_ - 1.0)); }

  size_t cellOf(const Point2& at) const {
    return static_cast<size_t>(cell(at.y - low_.y)) * side_ + cell(at.x - low_.x);
  }

  void fill(std::span<const Point2> points) {
    starts_.assign(static_cast<size_t>(side_) * side_ + 1, 0);
    for (const Point2& point : points) ++starts_[cellOf(point) + 1];
    for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    members_.resize(points.size());
    std::vector<Index> ends(starts_.begin(), starts_.end() - 1);
    for (Index i = 0; i < points.size(); ++i) members_[ends[cellOf(points[i])]++] = i;
  }

  Point2 low_;
  double scale_ = 1;
  int side_ = 1;
  std::vector<Index> starts_;
  std::vector<Index> members_;
};

}  // namespace tutte
