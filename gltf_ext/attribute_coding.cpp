#include "gltf_ext/attribute_coding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gltf_ext/attribute_words.h"

namespace tutte {
namespace {

constexpr int kMaxBits = 24;      // of kQuantised and kOctahedral: what a float holds
constexpr int kMaxWordBits = 27;  // sums of a few still fit 32 bits
constexpr uint32_t kFractionZero = 0x80000000u;
constexpr uint32_t kLargestNumerator = 1u << 24;

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

AttributeCoding exactCoding(const Attribute& attribute) {
  if (attribute.type == ComponentType::kFloat) {
    if (auto coding = fractionCoding(attribute)) return *coding;
  }
  return wordCoding(attribute);
}

/// True when every grid point is a finite float.
bool finiteGrid(const AttributeCoding& coding) {
  if (!(coding.range >= 0 && std::isfinite(coding.range))) return false;
  return std::all_of(coding.origin.begin(), coding.origin.end(), [&](float origin) {
    return std::isfinite(origin) && double{origin} + coding.range <= std::numeric_limits<float>::max();
  });
}

AttributeCoding quantisedCoding(const Attribute& attribute, int bits) {
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
  if (!finite || range > std::numeric_limits<float>::max()) return exactCoding(attribute);
  coding.range = static_cast<float>(range);
  if (coding.range < range) coding.range = std::nextafter(coding.range, std::numeric_limits<float>::max());
  return finiteGrid(coding) ? coding : exactCoding(attribute);
}

/// Colors between 0 and 1 must stay there, and so the grid must not go beyond.
AttributeCoding colorCoding(const Attribute& attribute, int bits) {
  AttributeCoding coding = quantisedCoding(attribute, bits);
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

AttributeCoding normalCoding(const Attribute& attribute, int bits) {
  if (attribute.components != 3 || !unitVectors(attribute, bits)) return quantisedCoding(attribute, bits);
  AttributeCoding coding;
  coding.kind = CodingKind::kOctahedral;
  coding.bits = bits;
  return coding;
}

AttributeCoding tangentCoding(const Attribute& attribute, int bits) {
  if (attribute.components != 4 || !unitVectors(attribute, bits)) return exactCoding(attribute);
  bool negative = false, positive = false;
  const bool signs = everyFloat(attribute, [&](float value, size_t component) {
    if (component != 3) return true;
    negative |= value == -1;
    positive |= value == 1;
    return value == -1 || value == 1;
  });
  if (!signs) return exactCoding(attribute);
  AttributeCoding coding;
  coding.kind = CodingKind::kOctahedralSigned;
  coding.bits = bits;
  coding.signs = negative && positive ? 2 : positive ? 1 : 0;
  return coding;
}

AttributeCoding lossyCoding(const Attribute& attribute, const AttributeName& name, int bits) {
  if (!name.is_target && name.semantic == Semantic::kNormal) return normalCoding(attribute, bits);
  if (!name.is_target && name.semantic == Semantic::kTangent) return tangentCoding(attribute, bits);
  const auto fractions = fractionCoding(attribute);
  if (fractions && fractions->bits <= bits) return *fractions;
  return !name.is_target && name.semantic == Semantic::kColor ? colorCoding(attribute, bits)
                                                              : quantisedCoding(attribute, bits);
}

void writeFloat(float value, ByteWriter& out) { out.u32(std::bit_cast<uint32_t>(value)); }
float readFloat(ByteReader& in) { return std::bit_cast<float>(in.u32()); }

bool valid(const AttributeCoding& coding, const Attribute& attribute) {
  const bool is_float = attribute.type == ComponentType::kFloat;
  switch (coding.kind) {
    case CodingKind::kConstant: return true;
    case CodingKind::kQuantised: return is_float && coding.bits >= 1 && coding.bits <= kMaxBits && finiteGrid(coding);
    case CodingKind::kOctahedral:
      return is_float && attribute.components == 3 && coding.bits >= 2 && coding.bits <= kMaxBits;
    case CodingKind::kOctahedralSigned:
      return is_float && attribute.components == 4 && coding.bits >= 2 && coding.bits <= kMaxBits && coding.signs <= 2;
    case CodingKind::kWords: return coding.bits >= 0 && coding.bits <= kMaxWordBits;
    case CodingKind::kSplitWords: return sizeOf(attribute.type) == 4;
    case CodingKind::kFractions:
      return is_float && coding.bits >= 0 && coding.bits <= kMaxWordBits && coding.denominator != 0;
  }
  return false;
}

void readFields(ByteReader& in, const Attribute& attribute, AttributeCoding& coding) {
  if (coding.kind == CodingKind::kConstant) {
    const auto bytes = in.take(attribute.stride());
    coding.constant.assign(bytes.begin(), bytes.end());
    return;
  }
  if (coding.kind == CodingKind::kSplitWords) return;
  coding.bits = in.byte();
  if (coding.kind == CodingKind::kQuantised) {
    for (int c = 0; c < attribute.components; ++c) coding.origin[c] = readFloat(in);
    coding.range = readFloat(in);
  }
  if (coding.kind == CodingKind::kOctahedralSigned) coding.signs = in.byte();
  if (coding.kind == CodingKind::kWords || coding.kind == CodingKind::kFractions) coding.base = in.u32();
  if (coding.kind == CodingKind::kFractions) coding.denominator = in.varint();
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

AttributeCoding chooseCoding(const Attribute& attribute, const PackOptions& options) {
  if (isConstant(attribute)) return constantCoding(attribute);
  const AttributeName name = parseName(attribute.name);
  const int bits = quantisationBits(name, options);
  const bool lossy = attribute.type == ComponentType::kFloat && bits > 0;
  return lossy ? lossyCoding(attribute, name, bits) : exactCoding(attribute);
}

void writeCoding(const AttributeCoding& coding, const Attribute& attribute, ByteWriter& out) {
  out.byte(static_cast<uint8_t>(coding.kind));
  if (coding.kind == CodingKind::kConstant) return out.append(coding.constant);
  if (coding.kind == CodingKind::kSplitWords) return;
  out.byte(static_cast<uint8_t>(coding.bits));
  if (coding.kind == CodingKind::kQuantised) {
    for (int c = 0; c < attribute.components; ++c) writeFloat(coding.origin[c], out);
    writeFloat(coding.range, out);
  }
  if (coding.kind == CodingKind::kOctahedralSigned) out.byte(coding.signs);
  if (coding.kind == CodingKind::kWords || coding.kind == CodingKind::kFractions) out.u32(coding.base);
  if (coding.kind == CodingKind::kFractions) out.varint(coding.denominator);
}

std::optional<AttributeCoding> readCoding(ByteReader& in, const Attribute& attribute) {
  AttributeCoding coding;
  const uint8_t kind = in.byte();
  if (kind > static_cast<uint8_t>(CodingKind::kFractions)) return std::nullopt;
  coding.kind = static_cast<CodingKind>(kind);
  readFields(in, attribute, coding);
  if (in.error() != Error::kNone || !valid(coding, attribute)) return std::nullopt;
  return coding;
}

}  // namespace tutte
