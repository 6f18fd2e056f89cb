// Which relation the components of an attribute are taken to have.

#include "gltf_ext/numeral_choice.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/gltf/coded_mesh.h"

namespace tutte {
namespace {

/// Three weights with six decimals, the sum of which is 1 but for one vertex in `every`.
Attribute weights(Index every) {
  return makeFloats("WEIGHTS_0", 3, 600, [every](Index w, int c) {
    const std::array<Index, 3> millionths{w * 337 % 300000, w * 7919 % 400000, w * 104729 % 200000};
    const Index last = 1000000 - millionths[0] - millionths[1];
    return (c == 2 && w % every != 0 ? last : millionths[static_cast<size_t>(c)]) / 1e6;
  });
}

TEST(NumeralChoice, ARelationIsFoundThatMostValuesHave) {
  EXPECT_EQ(chooseNumerals(weights(1000)).relation, Relation::kUnitSum);
  EXPECT_EQ(chooseNumerals(weights(5)).relation, Relation::kUnitSum);
  EXPECT_EQ(chooseNumerals(weights(2)).relation, Relation::kNone);
}

}  // namespace
}  // namespace tutte
