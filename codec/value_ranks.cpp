#include "codec/value_ranks.h"

#include <algorithm>

namespace tutte {

int32_t ValueRanks::largest() const {
  size_t most = 1;
  for (const auto& list : values) most = std::max(most, list.size());
  return static_cast<int32_t>(most - 1);
}

std::optional<ValueRanks> findRanks(std::span<const int32_t> values, int components, int32_t max, size_t most) {
  ValueRanks ranks;
  for (int c = 0; c < components; ++c) {
    std::vector<bool> seen(static_cast<size_t>(max) + 1);
    std::vector<int32_t>& list = ranks.values.emplace_back();
    for (size_t i = c; i < values.size(); i += components) {
      if (seen[values[i]]) continue;
      if (list.size() == most) return std::nullopt;
      seen[values[i]] = true;
      list.push_back(values[i]);
    }
    std::ranges::sort(list);
  }
  return ranks;
}

std::vector<int32_t> toRanks(const ValueRanks& ranks, std::span<const int32_t> values) {
  std::vector<int32_t> result(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    const std::vector<int32_t>& list = ranks.values[i % ranks.components()];
    result[i] = static_cast<int32_t>(std::lower_bound(list.begin(), list.end(), values[i]) - list.begin());
  }
  return result;
}

bool fromRanks(const ValueRanks& ranks, std::span<int32_t> values) {
  for (size_t i = 0; i < values.size(); ++i) {
    const std::vector<int32_t>& list = ranks.values[i % ranks.components()];
    if (static_cast<size_t>(values[i]) >= list.size()) return false;
    values[i] = list[values[i]];
  }
  return true;
}

void writeRanks(const ValueRanks& ranks, ByteWriter& out) {
  for (const std::vector<int32_t>& list : ranks.values) {
    out.varint(static_cast<uint32_t>(list.size() - 1));
    int32_t previous = -1;
    for (const int32_t value : list) {
      out.varint(static_cast<uint32_t>(value - previous - 1));
      previous = value;
    }
  }
}

std::optional<ValueRanks> readRanks(ByteReader& in, int components, int32_t max) {
  ValueRanks ranks;
  for (int c = 0; c < components; ++c) {
    std::vector<int32_t>& list = ranks.values.emplace_back();
    int64_t value = -1;
    for (int64_t count = int64_t{in.varint()} + 1; count > 0; --count) {
      value += int64_t{in.varint()} + 1;
      if (in.error() != Error::kNone || value > max) return std::nullopt;
      list.push_back(static_cast<int32_t>(value));
    }
  }
  return ranks;
}

}  // namespace tutte
