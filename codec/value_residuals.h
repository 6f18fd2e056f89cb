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
  /// `mixing`: the smallest profile; otherwise by classes.
  explicit Residuals(bool mixing) {
    if (mixing)
      mixing_.emplace();
    else
      classes_.emplace();
  }

  /// `expect()` gives an Expectation; what is not asked of it need not be computed.
  template <class Port, class Expect>
  [[gnu::always_inline]] int32_t code(Port& port, Expect expect, int32_t residual) {
    return classes_ ? classes_->code(port, expect(), residual) : mixing_->code(port, expect(), residual);
  }

 private:
  std::optional<ClassCoder> classes_;
  std::optional<MixingCoder> mixing_;
};

}  // namespace tutte::values
