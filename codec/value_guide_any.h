#pragma once
// All guides as one class, which chooses at run time: for programs whose size counts (TUTTE_COMPACT), because what uses
// guides then exists once.

#include <cstdint>
#include <optional>
#include <span>

#include "codec/value_directions.h"
#include "codec/value_guides.h"

namespace tutte::values {

/// The guide of a kind of values, in vectors of four, whose components are the same as in vectors of two.
class AnyGuide {
 public:
  static SurroundingsFinder::Wanted wanted(ValueKind kind) {
    switch (kind) {
      case ValueKind::kTexcoord: return TexcoordGuide<4>::wanted(kind);
      case ValueKind::kDirection: return DirectionGuide<4>::wanted(kind);
      default: return {};
    }
  }

  AnyGuide(const ValueGraph& graph, const Nodes<4>& nodes, std::span<const int32_t> places, int32_t max, ValueKind kind,
           Weighting weighting) {
    if (kind == ValueKind::kTexcoord) texcoord_.emplace(graph, nodes, places, max, kind, weighting);
    if (kind == ValueKind::kDirection) direction_.emplace(graph, nodes, places, max, kind, weighting);
  }

  bool predictsAlone() const { return direction_.has_value(); }

  void refine(const Surroundings& around, const Vec<4, int32_t>& last, Stencil<4, int32_t>& stencil) {
    if (texcoord_) texcoord_->refine(around, last, stencil);
    if (direction_) direction_->refine(around, last, stencil);
  }

  void learn(Index site, const Vec<4, int32_t>& value) {
    if (texcoord_) texcoord_->learn(site, value);
    if (direction_) direction_->learn(site, value);
  }

 private:
  std::optional<TexcoordGuide<4>> texcoord_;
  std::optional<DirectionGuide<4>> direction_;
};

}  // namespace tutte::values
