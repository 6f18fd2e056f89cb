#pragma once
// Attribute values over a mesh: whole numbers in, bytes out, and back.

#include <cstdint>
#include <span>
#include <vector>

#include "codec/bytes.h"
#include "codec/result.h"
#include "codec/value_graph.h"

namespace tutte {

/// How much time is spent on size: the number of statistics that are mixed. Part of the format.
enum class ValueProfile : uint8_t {
  kFast = 0,     ///< one context, no mixing
  kDefault = 1,  ///< two
  kSmall = 2,    ///< five
};

/// What the values are, besides the numbers.
struct ValueFormat {
  int components = 3;              ///< 1 to 4
  int32_t max = 0;                 ///< values are 0 to max, below 2^27
  ValueProfile profile = ValueProfile::kDefault;
  bool tangent = false;            ///< three components are points of a surface: correct towards its tangent plane
};

/// Appends the values, `components` per site in the order of site numbers, coded along `order` (valueOrder()).
void encodeValues(const ValueGraph& graph, std::span<const Index> order, const ValueFormat& format,
                  std::span<const int32_t> values, ByteWriter& out);

/// The values of any bytes, each within [0, max], or an error (kTruncated, kMalformed). All of `bytes` must be used.
Result<std::vector<int32_t>> decodeValues(const ValueGraph& graph, std::span<const Index> order,
                                          const ValueFormat& format, std::span<const uint8_t> bytes);

}  // namespace tutte
