// The range coder against sizes and bytes that can be worked out by hand, and the adaptive models above it.

#include "codec/range_coder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "codec/model.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;
using shapes::Random;

struct Decision {
  Probability one;
  bool value;
};

Bytes written(const std::vector<Decision>& decisions) {
  RangeWriter writer;
  for (const Decision& decision : decisions) writer.code(decision.one, decision.value);
  return std::move(writer).finish();
}

void expectRead(const Bytes& bytes, const std::vector<Decision>& decisions) {
  RangeReader reader(bytes);
  for (size_t i = 0; i < decisions.size(); ++i) {
    ASSERT_EQ(reader.code(decisions[i].one), decisions[i].value) << "decision " << i << " of " << decisions.size();
  }
  EXPECT_FALSE(reader.overrun());
}

TEST(RangeCoder, NothingTakesNoBytes) { EXPECT_EQ(written({}), Bytes{}); }

TEST(RangeCoder, OnesBeginAtZero) {
  EXPECT_EQ(written({{32768, true}}), Bytes{});
  // Only the last word is shortened, so that a reader can tell when it has read too far.
  EXPECT_EQ(written(std::vector<Decision>(1000, {32768, true})), Bytes(1000 / 32 * 4));
}

TEST(RangeCoder, ZerosBeginAtTheSplit) {
  EXPECT_EQ(written({{32768, false}}), Bytes{0x80});
  EXPECT_EQ(written({{16384, false}}), Bytes{0x80});
  EXPECT_EQ(written({{32768, false}, {32768, false}}), Bytes{0xC0});
  EXPECT_EQ(written({{32768, false}, {32768, true}, {32768, false}}), Bytes{0xA0});
  EXPECT_EQ(written({{32768, true}, {32768, false}}), Bytes{0x40});
}

TEST(RangeCoder, UniformDividesEvenly) {
  RangeWriter writer;
  writer.uniform(256, 0xAB);
  writer.uniform(256, 0xCD);
  const Bytes bytes = std::move(writer).finish();
  EXPECT_EQ(bytes, (Bytes{0xAB, 0xCD}));
}

TEST(RangeCoder, RandomDecisionsComeBack) {
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    std::vector<Decision> decisions(random.below(300));
    for (Decision& decision : decisions) {
      const Probability one = random.below(3) == 0 ? 1 + random.below(40) : 1 + random.below(65535);
      decision = {one, random.below(65536) < one};
    }
    ASSERT_NO_FATAL_FAILURE(expectRead(written(decisions), decisions)) << "seed " << seed;
  }
}

TEST(RangeCoder, UnlikelyDecisionsComeBack) {
  for (bool value : {false, true}) {
    const std::vector<Decision> decisions(500, {value ? 1u : 65535u, value});
    expectRead(written(decisions), decisions);
  }
}

TEST(RangeCoder, CarriesRunThroughManyBytes) {
  // The interval is led just below a half, and steps over it at the end.
  for (size_t length : {10u, 31u, 32u, 33u, 64u, 200u}) {
    std::vector<Decision> decisions(length, {32768, false});
    decisions.front() = {32768, true};
    decisions.push_back({65535, false});
    expectRead(written(decisions), decisions);
    decisions.push_back({1, true});
    decisions.push_back({3, false});
    expectRead(written(decisions), decisions);
  }
}

TEST(RangeCoder, MixedCallsComeBack) {
  for (uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const Random replay = random;
    const auto play = [](auto& port, Random dice) {
      for (int i = 0; i < 100; ++i) {
        const Index total = 1 + dice.below(i % 7 == 0 ? 1u << 31 : 1000);
        const Index value = dice.below(total);
        if (dice.below(2)) {
          EXPECT_EQ(port.code(32768, value & 1), value & 1);
        } else {
          EXPECT_EQ(port.uniform(total, value), value);
        }
      }
    };
    RangeWriter writer;
    play(writer, random);
    const Bytes bytes = std::move(writer).finish();
    RangeReader reader(bytes);
    play(reader, replay);
  }
}

TEST(RangeCoder, SizeIsTheEntropy) {
  Random random(7);
  std::vector<Decision> decisions(100000);
  double bits = 0;
  for (Decision& decision : decisions) {
    const Probability one = 1 + random.below(65535);
    decision = {one, random.below(65536) < one};
    bits -= std::log2((decision.value ? one : 65536 - one) / 65536.0);
  }
  EXPECT_LE(double(written(decisions).size()), bits / 8 * 1.0001 + 2);
}

TEST(RangeCoder, ReadersNoticeThatTheyRanDry) {
  const Bytes bytes{0x12, 0x34};
  RangeReader reader(bytes);
  for (int i = 0; i < 1000 && !reader.overrun(); ++i) reader.code(32768);
  EXPECT_TRUE(reader.overrun());
}

TEST(Bit, AdaptsByTheDocumentedSteps) {
  Bit bit;
  EXPECT_EQ(bit.clamped(), 32768u);
  bit.update(true);  // (65535 - 32768) * floor(655360 / 19) >> 16
  EXPECT_EQ(bit.clamped(), 32768u + (32767u * 34492u >> 16));
  for (int i = 0; i < 10000; ++i) bit.update(true);
  EXPECT_LE(bit.clamped(), 65504u);
  EXPECT_GT(bit.clamped(), 65000u);
  for (int i = 0; i < 10000; ++i) bit.update(false);
  EXPECT_GE(bit.clamped(), 32u);
  EXPECT_LT(bit.clamped(), 500u);
}

TEST(NumberModel, NumbersOfAllSizesComeBack) {
  std::vector<Index> numbers = {0, 1, 2, 3, 7, 8, 1000, 65535, 65536, 0x3FFFFFFF, 0x7FFFFFFE};
  Random random(3);
  for (int i = 0; i < 3000; ++i) numbers.push_back(random.below(1u << random.below(31)));
  RangeWriter writer;
  NumberModel model;
  for (Index number : numbers) EXPECT_EQ(model.code(writer, number), number);
  const Bytes bytes = std::move(writer).finish();
  RangeReader reader(bytes);
  NumberModel same;
  for (Index number : numbers) ASSERT_EQ(same.code(reader), number);
}

}  // namespace
}  // namespace tutte
