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
  /// `mixing`: the smallest profile; otherwise by classes, with one or two contexts.
  Residuals(bool mixing, bool two_contexts) {
    if (mixing)
      mixing_.emplace();
    else
      classes_.emplace(two_contexts);
  }

  /// Calls visit(coder) with one of the coders, or with this, which is one, too: where a program's size counts, what
  /// visits exists once.
  template <class Visit>
  [[gnu::always_inline]] void withCoder(Visit visit) {
#if defined(TUTTE_COMPACT)
    visit(*this);
#else
    classes_ ? visit(*classes_) : visit(*mixing_);
#endif
  }

  /// Whether expectations must be complete.
  bool wantsAll() const { return mixing_.has_value(); }

  template <class Port>
  [[gnu::always_inline]] int32_t code(Port& port, const Expectation& about, int32_t residual) {
    return classes_ ? classes_->code(port, about, residual) : mixing_->code(port, about, residual);
  }

 private:
  std::optional<ClassCoder> classes_;
  std::optional<MixingCoder> mixing_;
};

}  // namespace tutte::values
