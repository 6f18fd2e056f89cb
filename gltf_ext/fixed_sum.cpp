#include "gltf_ext/fixed_sum.h"

#include <cmath>

#include "gltf_ext/attribute_words.h"

namespace tutte {
namespace {

/// A number that stands for a component of kWords, or of kFractions with this denominator: what sums are made of.
uint32_t summand(const Attribute& attribute, const AttributeCoding& coding, const uint8_t* data) {
  if (coding.kind == CodingKind::kWords) return wordOf(data, attribute.type);
  return static_cast<uint32_t>(static_cast<int32_t>(std::nearbyint(double{loadFloat(data)} * coding.denominator)));
}

/// The sum of all components, if it is the same for all wedges.
std::optional<uint32_t> fixedSum(const Attribute& attribute, const AttributeCoding& coding) {
  std::optional<uint32_t> total;
  for (size_t at = 0; at < attribute.data.size();) {
    uint32_t sum = 0;
    for (int c = 0; c < attribute.components; ++c, at += sizeOf(attribute.type)) {
      sum += summand(attribute, coding, &attribute.data[at]);
    }
    if (total && *total != sum) return {};
    total = sum;
  }
  return total;
}

}  // namespace

void fixSum(const Attribute& attribute, const AttributeName& name, AttributeCoding& coding) {
  const bool may_sum = name.semantic == Semantic::kWeights || name.semantic == Semantic::kCustom;
  const bool whole = coding.kind == CodingKind::kWords || coding.kind == CodingKind::kFractions;
  if (!may_sum || name.is_target || !whole || attribute.components < 2) return;
  const std::optional<uint32_t> total = fixedSum(attribute, coding);
  coding.summed = total.has_value();
  coding.total = total.value_or(0);
}

}  // namespace tutte
