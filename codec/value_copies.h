#pragma once
// Components that repeat earlier ones: their values are mostly the original's, moved, turned or stretched.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "codec/value_graph.h"
#include "codec/value_motion.h"
#include "codec/value_nodes.h"

namespace tutte::values {

/// Predicts the values of copies from those of their originals, as long as that goes better than without. 8 bytes per
/// site and 300 per copy.
template <int C, class T>
class Copies {
 public:
  using Values = Vec<C, T>;

  /// `turns`: values may be points of space, and copies turned.
  Copies(const ValueGraph& graph, const Nodes<C>& nodes, bool turns)
      : nodes_(nodes), turns_(turns), links_(graph.siteCount()), states_(graph.copies().size()) {
    for (Index copy = 0; copy < states_.size(); ++copy) {
      const ComponentCopy& range = graph.copies()[copy];
      for (Index i = 0; i < range.count; ++i) {
        const Index site = graph.site(range.corner + i), original = graph.site(range.original + i);
        if (links_[site].original == kNone && site != original) links_[site] = {original, copy};
      }
    }
  }

  /// Looks at a site; `own` is what is predicted without the original. True: prediction() is to be trusted more.
  bool look(Index site, const Values& own) {
    const Link link = links_[site];
    state_ = link.original != kNone && nodes_.known(link.original) ? &states_[link.copy] : nullptr;
    predicted_ = state_ != nullptr && state_->motion.known();
    if (state_ == nullptr) return false;
    source_ = nodes_[link.original].value;
    if (!predicted_) return false;
    if (!state_->begun) begin();
    own_ = own;
    prediction_ = state_->motion.template applied<T>(source_);
    return state_->error <= state_->own_error;
  }

  const Values& prediction() const { return prediction_; }

  /// How far it was off at the last sites of the copy, per component, in 1/16.
  int32_t scale(int width) const { return static_cast<int32_t>(state_->error / (4 * width)); }

  /// The value of the site that was looked at.
  void learn(const Vec<C, int32_t>& value) {
    if (state_ == nullptr) return;
    if (predicted_) {
      const int64_t error = distance(value, prediction_), own_error = distance(value, own_);
      state_->error += error - (state_->error >> 2);
      state_->own_error += own_error - (state_->own_error >> 2);
      usual_error_ += (4 * error - usual_error_) >> 4;
      usual_own_error_ += (4 * own_error - usual_own_error_) >> 4;
    }
    state_->motion.learn(source_, value, turns_);
  }

 private:
  struct Link {
    Index original = kNone, copy = 0;
  };

  struct State {
    Motion<C> motion;
    bool begun = false;
    int64_t error = 0, own_error = 0;  // four times what is usual
  };

  // A copy is expected to be like those before.
  void begin() {
    state_->begun = true;
    state_->error = usual_error_;
    state_->own_error = usual_own_error_;
  }

  static int64_t distance(const Vec<C, int32_t>& value, const Values& prediction) {
    int64_t sum = 0;
    for (size_t i = 0; i < value.size(); ++i) {
      const int64_t off = (int64_t{value[i]} << kFraction) - prediction[i];
      sum += std::min<int64_t>(off < 0 ? -off : off, kMostError);
    }
    return sum;
  }

  static constexpr int64_t kMostError = 1 << 14;

  const Nodes<C>& nodes_;
  const bool turns_;
  std::vector<Link> links_;    // per site
  std::vector<State> states_;  // per copy
  int64_t usual_error_ = 0, usual_own_error_ = 0;

  // Of the current site.
  State* state_ = nullptr;
  bool predicted_ = false;
  Vec<C, int32_t> source_{};
  Values own_{}, prediction_{};
};

}  // namespace tutte::values
