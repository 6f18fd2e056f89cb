#pragma once
// Residuals: the differences between values and their predictions. The profile decides how they are coded.

#include <cstdint>
#include <optional>

#include "codec/value_classes.h"
#include "codec/value_expectation.h"
#include "codec/value_mixing.h"

namespace tutte::values {

/// One text and one copy for values of all kinds and numbers of components.
class Residuals {
 public:
  /// `mixing`: the smallest profile; otherwise by classes, with one or two contexts.
  Residuals(bool mixing, bool two_contexts) {
    if (mixing)
      mixing_.emplace();
    else
      classes_.emplace(two_contexts);
  }

  template <class Port>
  [[gnu::noinline]] int64_t code(Port& port, const Expectation& about, int64_t residual) {
    return classes_ ? classes_->code(port, about, residual) : mixing_->code(port, about, residual);
  }

 private:
  std::optional<ClassCoder> classes_;
  std::optional<MixingCoder> mixing_;
};

}  // namespace tutte::values
