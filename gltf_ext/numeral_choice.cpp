#include "gltf_ext/numeral_choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "gltf_ext/attribute_name.h"
#include "gltf_ext/attribute_words.h"

namespace tutte {
namespace {

// What an estimate assumes: so many bits of a value are predicted; a value that has no numeral costs so many.
constexpr double kPredicted = 8, kPlainCost = 36;

/// Where the digits of a number begin and end: it is below radix^(last + 1) and a multiple of radix^first.
struct Places {
  int first = 0;
  int last = 0;

  auto operator<=>(const Places&) const = default;
};

Places binaryPlaces(uint32_t magnitude) {
  const uint32_t exponent = magnitude >> 23;
  const uint32_t n = (magnitude & 0x7FFFFF) | (exponent > 0 ? 0x800000u : 0u);
  const int x = static_cast<int>(std::max(exponent, 1u)) - 150;
  return {x + std::countr_zero(n), x + static_cast<int>(std::bit_width(n)) - 1};
}

/// Of the shortest decimal number that the float is nearest to.
Places decimalPlaces(uint32_t magnitude) {
  char text[32];
  const float value = std::bit_cast<float>(magnitude);
  const char* const end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr;
  const char* const exponent = std::find(text, const_cast<char*>(end), 'e');
  int last = 0;
  const bool negative = exponent[1] == '-';
  std::from_chars(exponent + 2, end, last);
  last = negative ? -last : last;
  const auto decimals = static_cast<int>(exponent - text) - 1;  // and, if there are any, the point
  return {last - std::max(decimals - 1, 0), last};
}

/// The numbers of one component: how many there are of each shape.
struct Census {
  std::map<Places, size_t> binary, decimal;
  size_t not_finite = 0;
};

Census takeCensus(const Attribute& attribute, int component) {
  Census census;
  for (size_t at = 4 * component; at < attribute.data.size(); at += attribute.stride()) {
    const uint32_t magnitude = loadBytes(&attribute.data[at], 4) & 0x7FFFFFFF;
    if (magnitude >= 0x7F800000u) ++census.not_finite;
    if (magnitude == 0 || magnitude >= 0x7F800000u) continue;
    ++census.binary[binaryPlaces(magnitude)];
    ++census.decimal[decimalPlaces(magnitude)];
  }
  return census;
}

struct Choice {
  NumeralSystem system;
  double cost = INFINITY;
};

/// The cost of a system that ends at radix^least and has `digits` digits.
void consider(const std::map<Places, size_t>& places, int radix, int digits, int least, Choice& best) {
  const double unit = std::log2(radix);
  int top = least, largest = -200;
  for (const auto& [place, count] : places) largest = std::max(largest, place.last);
  double cost = 0;
  for (const auto& [place, count] : places) {
    const int x = std::max(least, place.last - digits + 1);
    const bool fits = place.first >= x && place.last - x < digits;
    cost += static_cast<double>(count) * (fits ? std::max(1.0, (largest - x + 1) * unit - kPredicted) : kPlainCost);
    if (fits) top = std::max(top, x);
  }
  const NumeralSystem system{radix, digits, least, top};
  if (cost < best.cost && system.valid()) best = {system, cost};
}

Choice bestOf(const std::map<Places, size_t>& places, int radix, int fewest, int most) {
  Choice best;
  std::vector<int> ends;
  for (const auto& [place, count] : places) ends.push_back(place.first);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (int digits = fewest; digits <= most; ++digits) {
    for (const int least : ends) consider(places, radix, digits, least, best);
  }
  return best;
}

/// All of them fit.
Choice exactBinary(const std::map<Places, size_t>& places) {
  int least = 200, digits = 1;
  for (const auto& [place, count] : places) {
    least = std::min(least, place.first);
    digits = std::max(digits, place.last - place.first + 1);
  }
  Choice choice;
  consider(places, 2, digits, least, choice);
  return choice;
}

NumeralSystem chooseSystem(const Attribute& attribute, int component) {
  const Census census = takeCensus(attribute, component);
  if (census.binary.empty()) return {2, 1, 0, 0};
  const Choice binary = exactBinary(census.binary);
  const Choice decimal = bestOf(census.decimal, 10, 1, NumeralSystem::kMostDecimal);
  return decimal.cost < binary.cost ? decimal.system : binary.system;
}

/// True when most values have a relation: a component is nearly free where it holds, and costs a few bits where not.
template <class Holds>
bool mostly(const Attribute& attribute, Holds holds) {
  size_t good = 0, all = 0;
  for (size_t at = 0; at < attribute.data.size(); at += attribute.stride(), ++all) {
    std::array<double, 4> value{};
    for (int c = 0; c < attribute.components; ++c) value[c] = loadFloat(&attribute.data[at + 4 * c]);
    good += holds(value);
  }
  return 4 * good >= 3 * all;
}

Relation findRelation(const Attribute& attribute) {
  const auto unit = [](const std::array<double, 4>& v) {
    return std::abs(std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) - 1) < 1e-4;
  };
  const auto sum = [](const std::array<double, 4>& v) { return std::abs(v[0] + v[1] + v[2] + v[3] - 1) < 1e-5; };
  if (attribute.components >= 3 && mostly(attribute, unit)) return Relation::kUnitVector;
  if (attribute.components >= 2 && mostly(attribute, sum)) return Relation::kUnitSum;
  return Relation::kNone;
}

/// One system for all of them: the coarsest that all numbers fit.
NumeralSystem joined(std::span<const NumeralSystem> systems) {
  NumeralSystem result = systems[0];
  for (const NumeralSystem& system : systems) {
    if (system.radix != result.radix) return {};
    int last = std::max(system.top + system.digits, result.top + result.digits);
    result.digits = std::max(system.digits, result.digits);
    result.least = std::min(system.least, result.least);
    result.top = std::max(result.least, last - result.digits);
  }
  return result;
}

}  // namespace

NumeralFormat chooseNumerals(const Attribute& attribute) {
  NumeralFormat format;
  format.components = attribute.components;
  for (int c = 0; c < format.components; ++c) format.systems[c] = chooseSystem(attribute, c);
  format.relation = findRelation(attribute);
  if (format.relation == Relation::kNone) return format;
  const NumeralFormat plain = [&] {
    NumeralFormat copy = format;
    copy.relation = Relation::kNone;
    return copy;
  }();
  const int related = format.relation == Relation::kUnitVector ? 3 : format.components;
  const NumeralSystem system = joined({format.systems.data(), static_cast<size_t>(related)});
  std::fill_n(format.systems.begin(), related, system);
  return format.valid() ? format : plain;
}

uint32_t commonDenominator(const NumeralFormat& format) {
  if (format.relation != Relation::kNone) return 0;
  uint32_t denominator = 0;
  for (int i = 0; i < format.components; ++i) {
    const NumeralSystem& system = format.systems[i];
    if (system.radix != 10 || system.top != system.least || system.least > 0 || system.least < -9) return 0;
    denominator = std::max(denominator, static_cast<uint32_t>(system.power(-system.least)));
  }
  return denominator;
}

}  // namespace tutte
