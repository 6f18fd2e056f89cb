// The ports of the value coder: what was written comes back, whatever it is, and nothing else is taken for it.

#include "codec/value_port.h"

#include <gtest/gtest.h>

#include "codec/bytes.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

values::Distribution skewed(uint32_t likely) {
  values::Distribution distribution;
  for (uint32_t i = 0; i < values::kSymbols; ++i) {
    distribution.above[i] = static_cast<uint16_t>(3 * (values::kSymbols - 1 - i) + (i < likely ? 32768 - 48 : 0));
  }
  distribution.above[values::kSymbols - 1] = 60000;  // a rate, which is no probability
  return distribution;
}

/// Codes decisions, symbols and bits that depend on the seed alone; a reader is compared with them.
template <class Port>
bool matches(Port& port, int count, uint64_t seed) {
  shapes::Random random(seed);
  bool same = true;
  for (int i = 0; i < count; ++i) {
    const auto one = static_cast<uint32_t>(1 + random.below(65535));
    const bool bit = random.below(65536) < one;
    same &= port.code(one, bit) == bit;
    const auto symbol = static_cast<uint32_t>(random.below(values::kSymbols));
    const auto likely = random.below(2) == 0 ? symbol : static_cast<uint32_t>(random.below(values::kSymbols));
    const values::Distribution a = skewed(likely), b = skewed(7);
    same &= port.symbol(i % 2 == 0 ? values::Parts(a) : values::Parts(a, b), symbol) == symbol;
    const int digits = static_cast<int>(random.below(32));
    const auto number = static_cast<uint32_t>(random.next() & ((uint64_t{1} << digits) - 1));
    same &= port.bits(digits, number) == number;
  }
  return same;
}

bool reads(std::span<const uint8_t> bytes, int count, uint64_t seed) {
  ValueReader port(bytes);
  return matches(port, count, seed) && !port.wrongEnd();
}

TEST(ValuePort, WhatIsWrittenComesBack) {
  int lucky = 0;  // what is likely enough needs no bytes
  for (int count = 0; count < 300; ++count) {
    ValueWriter port;
    matches(port, count, 5);
    ByteWriter out;
    std::move(port).finish(out);
    EXPECT_TRUE(reads(out.bytes(), count, 5)) << count;
    lucky += reads(out.bytes(), count + 1, 5);
    if (count == 0) continue;
    EXPECT_FALSE(reads(out.bytes().first(out.bytes().size() - 1), count, 5)) << count;
  }
  EXPECT_LT(lucky, 3);
}

TEST(ValuePort, NothingTakesNoBytes) {
  ByteWriter out;
  ValueWriter().finish(out);
  EXPECT_EQ(out.bytes().size(), 0u);
}

TEST(ValuePort, CertainDecisionsAreNearlyFree) {
  ValueWriter port;
  for (int i = 0; i < 10000; ++i) port.code(65504, true);
  ByteWriter out;
  std::move(port).finish(out);
  EXPECT_LT(out.bytes().size(), 4u);
}

}  // namespace
}  // namespace tutte
