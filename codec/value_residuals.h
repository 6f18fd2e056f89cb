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

  /// Calls visit(coder) with one of the coders.
  template <class Visit>
  [[gnu::always_inline]] void withCoder(Visit visit) {
    classes_ ? visit(*classes_) : visit(*mixing_);
  }

 private:
  std::optional<ClassCoder> classes_;
  std::optional<MixingCoder> mixing_;
};

}  // namespace tutte::values
