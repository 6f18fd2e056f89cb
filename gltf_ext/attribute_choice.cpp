// Which coding suits an attribute.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/attribute_words.h"
#include "gltf_ext/fixed_sum.h"
#include "gltf_ext/numeral_choice.h"

namespace tutte {
namespace {

constexpr int kMaxSurfaceBits = 20;  // of positions that the integer coder takes for points of a surface
constexpr uint32_t kFractionZero = 0x80000000u;
constexpr uint32_t kLargestNumerator = 1u << 24;
constexpr size_t kMostPalette = 4096;
constexpr double kFarthest = 1 << 30;  // of kGrid, in steps from the origin

/// Calls visit(value, component) for every component of every wedge until it returns false.
template <class Visit>
bool everyFloat(const Attribute& attribute, Visit visit) {
  for (size_t at = 0; at + 4 <= attribute.data.size(); at += 4) {
    if (!visit(loadFloat(&attribute.data[at]), at / 4 % attribute.components)) return false;
  }
  return true;
}

bool isConstant(const Attribute& attribute) {
  const auto& data = attribute.data;
  return std::equal(data.begin() + std::min<size_t>(attribute.stride(), data.size()), data.end(), data.begin());
}

AttributeCoding constantCoding(const Attribute& attribute) {
  AttributeCoding coding;
  coding.constant.assign(attribute.stride(), 0);
  if (!attribute.data.empty()) std::copy_n(attribute.data.begin(), attribute.stride(), coding.constant.begin());
  return coding;
}

AttributeCoding wordCoding(const Attribute& attribute) {
  uint32_t least = 0xFFFFFFFFu, largest = 0;
  for (size_t at = 0; at < attribute.data.size(); at += sizeOf(attribute.type)) {
    const uint32_t word = wordOf(&attribute.data[at], attribute.type);
    least = std::min(least, word);
    largest = std::max(largest, word);
  }
  AttributeCoding coding;
  coding.bits = static_cast<int>(std::bit_width(largest - least));
  coding.kind = coding.bits <= kMaxWordBits ? CodingKind::kWords : CodingKind::kSplitWords;
  coding.base = least;
  return coding;
}

/// All values as numerators over one denominator, if every float comes back with the same bits.
std::optional<AttributeCoding> fractionCoding(const Attribute& attribute, uint32_t denominator) {
  double least = kLargestNumerator, largest = -least;
  const bool exact = everyFloat(attribute, [&](float value, size_t) {
    const double numerator = std::nearbyint(double{value} * denominator);
    if (!(std::fabs(numerator) <= kLargestNumerator)) return false;
    least = std::min(least, numerator);
    largest = std::max(largest, numerator);
    const auto back = static_cast<float>(numerator / denominator);
    return back == value && !(value == 0 && std::signbit(value));
  });
  if (!exact) return std::nullopt;
  AttributeCoding coding;
  coding.kind = CodingKind::kFractions;
  coding.denominator = denominator;
  coding.base = kFractionZero + static_cast<uint32_t>(static_cast<int32_t>(least));
  coding.bits = static_cast<int>(std::bit_width(static_cast<uint32_t>(largest - least)));
  return coding;
}

std::optional<AttributeCoding> fractionCoding(const Attribute& attribute) {
  for (const uint32_t denominator : {1u, 255u, 65535u}) {
    if (auto coding = fractionCoding(attribute, denominator)) return coding;
  }
  return std::nullopt;
}

AttributeCoding numeralCoding(const Attribute& attribute) {
  const NumeralFormat format = chooseNumerals(attribute);
  if (const uint32_t denominator = commonDenominator(format)) {
    // The coder of whole numbers knows more about surfaces.
    const auto fractions = fractionCoding(attribute, denominator);
    if (fractions && fractions->bits <= kMaxSurfaceBits) return *fractions;
  }
  AttributeCoding coding;
  coding.kind = CodingKind::kNumerals;
  coding.numerals = format;
  return coding;
}

AttributeCoding exactCoding(const Attribute& attribute, const PackOptions& options) {
  if (attribute.type != ComponentType::kFloat) return wordCoding(attribute);
  if (auto coding = fractionCoding(attribute)) return *coding;
  return options.attribute_coder == AttributeCoder::kDraco ? wordCoding(attribute) : numeralCoding(attribute);
}

/// What the options say about the error of such an attribute.
const ErrorBound& boundFor(const AttributeName& name, const ErrorBounds& errors) {
  static constexpr ErrorBound kNone;
  switch (name.semantic) {
    case Semantic::kPosition: return errors.position;
    case Semantic::kNormal:
    case Semantic::kTangent: return name.is_target ? errors.generic : kNone;
    case Semantic::kTexcoord: return name.is_target ? errors.generic : errors.texcoord;
    case Semantic::kColor: return name.is_target ? errors.generic : errors.color;
    case Semantic::kJoints:
    case Semantic::kWeights: return kNone;
    default: return errors.generic;
  }
}

AttributeCoding quantisedCoding(const Attribute& attribute, int bits, const PackOptions& options) {
  AttributeCoding coding;
  coding.kind = CodingKind::kQuantised;
  coding.bits = bits;
  std::array<float, 4> largest;
  coding.origin.fill(std::numeric_limits<float>::max());
  largest.fill(std::numeric_limits<float>::lowest());
  const bool finite = everyFloat(attribute, [&](float value, size_t component) {
    coding.origin[component] = std::min(coding.origin[component], value);
    largest[component] = std::max(largest[component], value);
    return std::isfinite(value);
  });
  double range = 0;
  for (int c = 0; c < attribute.components; ++c) range = std::max(range, double{largest[c]} - coding.origin[c]);
  std::fill(coding.origin.begin() + attribute.components, coding.origin.end(), 0.0f);
  if (!finite || range > std::numeric_limits<float>::max()) return exactCoding(attribute, options);
  coding.range = static_cast<float>(range);
  if (coding.range < range) coding.range = std::nextafter(coding.range, std::numeric_limits<float>::max());
  return isValid(coding, attribute) ? coding : exactCoding(attribute, options);
}

/// Colors between 0 and 1 must stay there, and so the grid must not go beyond.
AttributeCoding colorCoding(const Attribute& attribute, int bits, const PackOptions& options) {
  AttributeCoding coding = quantisedCoding(attribute, bits, options);
  const bool proper = everyFloat(attribute, [](float value, size_t) { return value >= 0 && value <= 1; });
  if (coding.kind != CodingKind::kQuantised || !proper) return coding;
  coding.origin.fill(0);
  coding.range = 1;
  return coding;
}

/// True when the first three components of every value are a unit vector, as far as `bits` can tell.
bool unitVectors(const Attribute& attribute, int bits) {
  for (size_t at = 0; at < attribute.data.size(); at += attribute.stride()) {
    const double x = loadFloat(&attribute.data[at]), y = loadFloat(&attribute.data[at + 4]),
                 z = loadFloat(&attribute.data[at + 8]);
    if (!(std::fabs(std::sqrt(x * x + y * y + z * z) - 1) <= std::ldexp(1.0, -bits))) return false;
  }
  return true;
}

AttributeCoding normalCoding(const Attribute& attribute, int bits, const PackOptions& options) {
  if (attribute.components != 3 || !unitVectors(attribute, bits)) return quantisedCoding(attribute, bits, options);
  AttributeCoding coding;
  coding.kind = CodingKind::kOctahedral;
  coding.bits = bits;
  return coding;
}

AttributeCoding tangentCoding(const Attribute& attribute, int bits, const PackOptions& options) {
  if (attribute.components != 4 || !unitVectors(attribute, bits)) return exactCoding(attribute, options);
  bool negative = false, positive = false;
  const bool signs = everyFloat(attribute, [&](float value, size_t component) {
    if (component != 3) return true;
    negative |= value == -1;
    positive |= value == 1;
    return value == -1 || value == 1;
  });
  if (!signs) return exactCoding(attribute, options);
  AttributeCoding coding;
  coding.kind = CodingKind::kOctahedralSigned;
  coding.bits = bits;
  coding.signs = negative && positive ? 2 : positive ? 1 : 0;
  return coding;
}

/// Nothing when a value is not finite, or too far away in steps.
std::optional<AttributeCoding> gridCoding(const Attribute& attribute, const AttributeName& name,
                                          const PositionGrid& grid) {
  AttributeCoding coding;
  coding.kind = CodingKind::kGrid;
  coding.step = grid.step;
  if (!name.is_target) std::copy(grid.origin.begin(), grid.origin.end(), coding.origin.begin());
  std::array<double, 4> least, largest;
  least.fill(kFarthest);
  largest.fill(-kFarthest);
  const bool near = everyFloat(attribute, [&](float value, size_t c) {
    const double point = gridPoint(value, coding.origin[c], coding.step);
    least[c] = std::min(least[c], point);
    largest[c] = std::max(largest[c], point);
    return std::fabs(point) < kFarthest;
  });
  if (!near) return std::nullopt;
  double extent = 0;
  for (int c = 0; c < attribute.components; ++c) {
    coding.first[c] = static_cast<int32_t>(least[c]);
    extent = std::max(extent, largest[c] - least[c]);
  }
  if (extent >= 1 << kMaxBits) return std::nullopt;
  coding.bits = static_cast<int>(std::bit_width(static_cast<uint32_t>(extent)));
  return isValid(coding, attribute) ? std::optional(coding) : std::nullopt;
}

AttributeCoding boundedCoding(const Attribute& attribute, const AttributeName& name, int bits,
                              const PackOptions& options) {
  if (name.semantic == Semantic::kPosition && options.grid) {
    const auto coding = gridCoding(attribute, name, *options.grid);
    return coding ? *coding : exactCoding(attribute, options);
  }
  AttributeCoding coding = quantisedCoding(attribute, bits, options);
  const ErrorBound& bound = boundFor(name, options.errors);
  if (bound.size == 0 || coding.kind != CodingKind::kQuantised) return coding;
  const double size = bound.relative ? bound.size * coding.range : bound.size;
  for (coding.bits = 1; coding.bits <= kMaxBits; ++coding.bits) {
    if (errorBound(coding) <= size) return coding;
  }
  return exactCoding(attribute, options);
}

AttributeCoding lossyCoding(const Attribute& attribute, const AttributeName& name, int bits,
                            const PackOptions& options) {
  if (!name.is_target && name.semantic == Semantic::kNormal) return normalCoding(attribute, bits, options);
  if (!name.is_target && name.semantic == Semantic::kTangent) return tangentCoding(attribute, bits, options);
  const auto fractions = fractionCoding(attribute);
  const bool shared = name.semantic == Semantic::kPosition && options.grid;
  if (fractions && fractions->bits <= bits && !shared) return *fractions;
  const bool color = !name.is_target && name.semantic == Semantic::kColor && options.errors.color.size == 0;
  return color ? colorCoding(attribute, bits, options) : boundedCoding(attribute, name, bits, options);
}

}  // namespace

int quantisationBits(const AttributeName& name, const PackOptions& options) {
  switch (name.semantic) {
    case Semantic::kPosition: return options.position_bits;
    case Semantic::kNormal:
    case Semantic::kTangent: return name.is_target ? options.generic_bits : options.normal_bits;
    case Semantic::kTexcoord: return name.is_target ? options.generic_bits : options.texcoord_bits;
    case Semantic::kColor: return name.is_target ? options.generic_bits : options.color_bits;
    case Semantic::kJoints:
    case Semantic::kWeights: return 0;
    default: return options.generic_bits;
  }
}

std::optional<AttributeCoding> paletteCoding(const Attribute& attribute) {
  const size_t values = attribute.data.size() / 4, most = std::min<size_t>(kMostPalette, values / 4 + 4);
  std::vector<std::set<uint32_t>> words(attribute.components);
  for (size_t i = 0; i < values; ++i) {
    std::set<uint32_t>& own = words[i % attribute.components];
    own.insert(wordOf(&attribute.data[4 * i], ComponentType::kFloat));
    if (own.size() > most) return std::nullopt;
  }
  AttributeCoding coding;
  coding.kind = CodingKind::kPalette;
  size_t largest = 1;
  for (const auto& own : words) {
    coding.palette.emplace_back(own.begin(), own.end());
    largest = std::max(largest, own.size());
  }
  coding.bits = static_cast<int>(std::bit_width(largest - 1));
  return values > 0 ? std::optional(coding) : std::nullopt;
}

AttributeCoding chooseCoding(const Attribute& attribute, const PackOptions& options) {
  if (isConstant(attribute)) return constantCoding(attribute);
  const AttributeName name = parseName(attribute.name);
  const int bits = quantisationBits(name, options);
  const bool wanted = bits > 0 || boundFor(name, options.errors).size > 0;
  const bool lossy = attribute.type == ComponentType::kFloat && wanted;
  AttributeCoding coding = lossy ? lossyCoding(attribute, name, bits, options) : exactCoding(attribute, options);
  fixSum(attribute, name, coding);
  return coding;
}

}  // namespace tutte
