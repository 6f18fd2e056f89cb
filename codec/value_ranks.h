#pragma once
// Values that are few although they are large, such as coordinates on a coarse grid: coded by their ranks.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codec/bytes.h"

namespace tutte {

/// The different values of each component, ascending.
struct ValueRanks {
  std::vector<std::vector<int32_t>> values;  ///< per component

  int components() const { return static_cast<int>(values.size()); }

  /// The largest rank of any component.
  int32_t largest() const;
};

/// The different values, of which there are `components` per site, each in [0, max]; nothing when there are more than
/// `most` in a component. O(values + max), with max / 8 bytes.
std::optional<ValueRanks> findRanks(std::span<const int32_t> values, int components, int32_t max, size_t most);

/// The ranks instead of the values.
std::vector<int32_t> toRanks(const ValueRanks& ranks, std::span<const int32_t> values);

/// The values instead of the ranks; false when a rank is too large.
bool fromRanks(const ValueRanks& ranks, std::span<int32_t> values);

/// Per component: a varint, their number less 1; then each value less the previous one less 1, as varints (the previous
/// of the first is -1).
void writeRanks(const ValueRanks& ranks, ByteWriter& out);

/// Nothing when the bytes are no such table of values in [0, max].
std::optional<ValueRanks> readRanks(ByteReader& in, int components, int32_t max);

}  // namespace tutte
