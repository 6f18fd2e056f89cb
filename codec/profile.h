#pragma once

#include <cstdint>

namespace tutte {

/// Which statistics code the symbols: more contexts cost time and save bytes.
enum class Profile : uint8_t {
  kPaper = 0,    ///< the paper's contexts and symbols, for comparison
  kFast = 1,     ///< one context
  kDefault = 2,  ///< seven contexts for valences and five for degrees, mixed
  kSmall = 3,    ///< fifteen contexts, mixed by three sets of weights, and a final map
};

}  // namespace tutte
