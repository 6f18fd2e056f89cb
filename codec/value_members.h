#pragma once
// Predictions of one quality for one site, one to four of them: what they say together.

#include <algorithm>
#include <cstddef>
#include <span>

#include "codec/value_nodes.h"

namespace tutte::values {

/// Their average, rounded; of three, the last one counts twice. At least one.
template <int C, class T>
[[gnu::always_inline]] inline Vec<C, T> averageOf(std::span<const Vec<C, T>> members) {
  const Vec<C, T>* const m = members.data();
  if (members.size() == 1) return m[0];
  if (members.size() == 2) return eachOf<C, T>([&](size_t i) { return (m[0][i] + m[1][i] + 1) >> 1; });
  const Vec<C, T>& last = m[members.size() - 1];
  return eachOf<C, T>([&](size_t i) { return (m[0][i] + m[1][i] + m[2][i] + last[i] + 2) >> 2; });
}

/// How far the others are from the first, at most.
template <int C, class T>
[[gnu::always_inline]] inline Vec<C, T> spreadOf(std::span<const Vec<C, T>> members) {
  const Vec<C, T>& first = members[0];
  Vec<C, T> most{};
  for (size_t m = 1; m < members.size(); ++m) {
    most = eachOf<C, T>([&](size_t i) {
      const T off = members[m][i] - first[i];
      return std::max(most[i], off < 0 ? -off : off);
    });
  }
  return most;
}

}  // namespace tutte::values
