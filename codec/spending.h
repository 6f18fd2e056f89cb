#pragma once
// Where the bits of a connectivity section go: for people who want to know what to improve.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "codec/mesh.h"
#include "codec/result.h"
#include "codec/topic.h"

namespace tutte {

/// The topic's name in reports, such as "valences".
std::string_view nameOf(Topic topic);

/// What one topic took.
struct TopicBits {
  double bits = 0;         ///< information, in bits: the sum of -log2 of the probabilities with which it was coded
  uint64_t decisions = 0;  ///< yes-or-no questions and numbers coded at once
};

/// All bits of a section: 8 * bytes = head_bits + sum of topics + end_bits.
struct Spending {
  std::array<TopicBits, kTopicCount> topics;
  double head_bits = 0;
  double end_bits = 0;  ///< what ending the symbols at a whole byte costs, or, below 0, saves

  const TopicBits& operator[](Topic topic) const { return topics[static_cast<size_t>(topic)]; }
};

/// Decodes a connectivity section as decode() does, and counts. Any bytes may be passed; the errors are those of
/// decode(). A few times slower than decode().
Result<Spending> spendingOf(std::span<const uint8_t> section, const Limits& limits = {});

}  // namespace tutte
