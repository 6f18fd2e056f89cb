#pragma once
// Residuals: the differences between values and their predictions. The profile decides how they are coded.

#include <cstdint>
#include <optional>

#include "codec/value_classes.h"
#include "codec/value_expectation.h"
#include "codec/value_mixing.h"

namespace tutte::values {

class Residuals {
 public:
  /// `mixing`: the smallest profile; otherwise by classes, with one or two contexts. `sites`: how many there are.
  Residuals(bool mixing, bool two_contexts, Index sites) : two_contexts_(two_contexts) {
    mixing ? void(mixing_.emplace(sites)) : void(classes_.emplace());
  }

  /// Calls visit(coder) with one of the coders, or with this, which is one, too: where a program's size counts, what
  /// visits exists once.
  template <class Visit>
  [[gnu::always_inline]] void withCoder(Visit visit) {
#if defined(TUTTE_COMPACT)
    visit(*this);
#else
    if (mixing_) return visit(*mixing_);
    if (two_contexts_) [[likely]] {
      visit(Classes<true>{*classes_});
    } else {
      visit(Classes<false>{*classes_});
    }
#endif
  }

  /// Whether expectations must be complete.
  bool wantsAll() const { return mixing_.has_value(); }

  template <class Port>
  [[gnu::always_inline]] int32_t code(Port& port, const Expectation& about, int32_t residual) {
    return classes_ ? classes_->code(port, about, residual, two_contexts_) : mixing_->code(port, about, residual);
  }

 private:
  /// A text for each number of contexts.
  template <bool two>
  struct Classes {
    ClassCoder& coder;

    static constexpr bool wantsAll() { return false; }
    template <class Port>
    [[gnu::always_inline]] int32_t code(Port& port, const Expectation& about, int32_t residual) const {
      return coder.code(port, about, residual, two);
    }
  };

  const bool two_contexts_;
  std::optional<ClassCoder> classes_;
  std::optional<MixingCoder> mixing_;
};

}  // namespace tutte::values
