#include "gltf_ext/grid_plan.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gltf_ext/attribute_words.h"

namespace tutte {
namespace {

constexpr int kLostBits = 2;  // that a mesh may lose against a grid of its own

/// Several boxes together.
struct Group {
  std::array<float, 3> least, largest;

  explicit Group(const PositionBox& box) : least(box.least), largest(box.largest) {}

  void add(const PositionBox& box) {
    for (int i = 0; i < 3; ++i) least[i] = std::min(least[i], box.least[i]);
    for (int i = 0; i < 3; ++i) largest[i] = std::max(largest[i], box.largest[i]);
  }
  double extent() const {
    double result = 0;
    for (int i = 0; i < 3; ++i) result = std::max(result, double{largest[i]} - least[i]);
    return result;
  }
  double magnitude() const {
    double result = 0;
    for (int i = 0; i < 3; ++i) result = std::max({result, std::fabs(double{least[i]}), std::fabs(double{largest[i]})});
    return result;
  }
};

/// The largest float that is not above a number.
float below(double number) {
  const auto nearest = static_cast<float>(number);
  return nearest > number ? std::nextafter(nearest, 0.0f) : nearest;
}

Outcome<float> stepWithin(const ErrorBound& bound, double extent, double magnitude) {
  const double size = bound.relative ? bound.size * extent : bound.size;
  // A decoded position is rounded to float, which costs up to half a unit of its last place; a little is for binary64.
  const double left = (size - magnitude * 0x1p-24) * (1 - 0x1p-20);
  if (left < size / 16) {
    return Failure{FailureKind::kUsage, "",
                   "this error bound is below what floats of this size can tell apart; use --lossless"};
  }
  return below(2 * left);
}

class GridPlanner {
 public:
  GridPlanner(std::span<const PositionBox> boxes, const PackOptions& options, GridScope scope)
      : boxes_(boxes), options_(options), scope_(scope) {
    for (const PositionBox& box : boxes) {
      if (!box.known) continue;
      const auto [place, is_new] = groups_.try_emplace(box.mesh, box);
      if (!is_new) place->second.add(box);
      all_ ? all_->add(box) : void(all_.emplace(box));
    }
    for (const auto& [mesh, group] : groups_) extent_ = std::max(extent_, group.extent());
  }

  Outcome<std::vector<std::optional<PositionGrid>>> run() const {
    std::vector<std::optional<PositionGrid>> grids(boxes_.size());
    const bool bounded = options_.errors.position.size > 0;
    const auto known = std::ranges::count(boxes_, true, &PositionBox::known);
    if (known == 0 || extent_ == 0 || (!bounded && (known == 1 || options_.position_bits == 0))) return grids;
    for (size_t i = 0; i < grids.size(); ++i) {
      if (!boxes_[i].known) continue;
      const auto grid = gridOf(groups_.at(boxes_[i].mesh));
      if (!grid) return grid.error();
      if (grid->step > 0) grids[i] = *grid;
    }
    return grids;
  }

 private:
  Outcome<PositionGrid> gridOf(const Group& group) const {
    const bool shared = scope_ == GridScope::kFile;
    PositionGrid grid{shared ? all_->least : group.least, 0};
    if (options_.errors.position.size > 0) {
      const auto step = stepWithin(options_.errors.position, extent_, all_->magnitude());
      if (!step) return step.error();
      grid.step = *step;
      return grid;
    }
    const double steps = std::ldexp(1.0, options_.position_bits) - 1;
    grid.step = static_cast<float>((shared ? extent_ : group.extent()) / steps);
    for (double most = extent_ / (1 << kLostBits); shared && group.extent() < most && grid.step > 0x1p-100f;) {
      grid.step /= 1 << kLostBits;
      most /= 1 << kLostBits;
    }
    return grid;
  }

  std::span<const PositionBox> boxes_;
  const PackOptions& options_;
  const GridScope scope_;
  std::map<size_t, Group> groups_;
  std::optional<Group> all_;
  double extent_ = 0;
};

}  // namespace

PositionBox boxOf(const Attribute& positions, size_t mesh) {
  PositionBox box;
  box.mesh = mesh;
  box.known = positions.type == ComponentType::kFloat && positions.components == 3 && !positions.data.empty();
  if (!box.known) return box;
  for (int i = 0; i < 3; ++i) box.least[i] = box.largest[i] = loadFloat(&positions.data[4 * i]);
  for (size_t at = 0; at < positions.data.size(); at += 4) {
    const float value = loadFloat(&positions.data[at]);
    const size_t axis = at / 4 % 3;
    box.known = box.known && std::isfinite(value);
    box.least[axis] = std::min(box.least[axis], value);
    box.largest[axis] = std::max(box.largest[axis], value);
  }
  return box;
}

Outcome<std::vector<std::optional<PositionGrid>>> planGrids(std::span<const PositionBox> boxes,
                                                            const PackOptions& options, GridScope scope) {
  return GridPlanner(boxes, options, scope).run();
}

}  // namespace tutte
