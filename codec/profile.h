#pragma once

#include <cstddef>
#include <cstdint>

namespace tutte {

/// Which statistics code the symbols: more contexts cost time and save bytes.
enum class Profile : uint8_t {
  kPaper = 0,    ///< the paper's contexts and symbols, for comparison
  kFast = 1,     ///< one context
  kDefault = 2,  ///< seven contexts for valences and three for degrees, mixed
  kSmall = 3,    ///< fifteen contexts, mixed by three sets of weights, and a final map
};

/// What the encoder takes where the user leaves it open: the best statistics for meshes so small that their time does
/// not count, the fastest for huge ones.
constexpr Profile profileFor(size_t corners) {
  if (corners <= 2'000) return Profile::kSmall;
  return corners <= 40'000'000 ? Profile::kDefault : Profile::kFast;
}

}  // namespace tutte
