#include "gltf_ext/attribute_coding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gltf_ext/octahedron.h"

namespace tutte {
namespace {

/// True when every grid point is a finite float.
bool finiteGrid(const AttributeCoding& coding) {
  if (!(coding.range >= 0 && std::isfinite(coding.range))) return false;
  return std::all_of(coding.origin.begin(), coding.origin.end(), [&](float origin) {
    return std::isfinite(origin) && double{origin} + coding.range <= std::numeric_limits<float>::max();
  });
}

/// True when every grid point is a finite float.
bool finitePoints(const AttributeCoding& coding) {
  if (!(coding.step > 0 && std::isfinite(coding.step))) return false;
  for (size_t c = 0; c < coding.origin.size(); ++c) {
    const double last = double(coding.first[c]) + std::ldexp(1.0, coding.bits);
    const double reach = std::max(std::fabs(double(coding.first[c])), std::fabs(last)) * coding.step;
    if (!(std::fabs(coding.origin[c]) + reach <= std::numeric_limits<float>::max())) return false;
  }
  return true;
}

void writeFloat(float value, ByteWriter& out) { out.u32(std::bit_cast<uint32_t>(value)); }
float readFloat(ByteReader& in) { return std::bit_cast<float>(in.u32()); }

// The relation in bits 0 and 1; bit 2: each component has a system of its own. A system: digits in bits 0 to 4, bit 5
// for decimals; 150 + least; top - least.
constexpr uint8_t kRelationMask = 3, kOwnSystems = 4, kDigitsMask = 31, kDecimal = 32;
constexpr int kLeastBias = 150;

constexpr uint8_t kSummed = 128;  // added to the kind

bool sameSystems(const NumeralFormat& format) {
  return std::all_of(format.systems.begin(), format.systems.begin() + format.components,
                     [&](const NumeralSystem& system) { return system == format.systems[0]; });
}

void writeNumerals(const NumeralFormat& format, ByteWriter& out) {
  const bool same = sameSystems(format);
  out.byte(static_cast<uint8_t>(static_cast<int>(format.relation) | (same ? 0 : kOwnSystems)));
  for (int i = 0; i < (same ? 1 : format.components); ++i) {
    const NumeralSystem& system = format.systems[i];
    out.byte(static_cast<uint8_t>(system.digits | (system.radix == 10 ? kDecimal : 0)));
    out.byte(static_cast<uint8_t>(system.least + kLeastBias));
    out.byte(static_cast<uint8_t>(system.top - system.least));
  }
}

void readNumerals(ByteReader& in, const Attribute& attribute, NumeralFormat& format) {
  const uint8_t head = in.byte();
  format.components = head < 2 * kOwnSystems ? attribute.components : 0;  // 0 is not valid
  format.relation = static_cast<Relation>(head & kRelationMask);
  const int own = head & kOwnSystems ? attribute.components : 1;
  for (int i = 0; i < own; ++i) {
    NumeralSystem& system = format.systems[i];
    const uint8_t shape = in.byte();
    system.radix = shape & kDecimal ? 10 : 2;
    system.digits = shape < 2 * kDecimal ? shape & kDigitsMask : 0;
    system.least = in.byte() - kLeastBias;
    system.top = system.least + in.byte();
  }
  std::fill(format.systems.begin() + own, format.systems.end(), format.systems[0]);
}

// Per component: the number of words less 1, the first word, then each less the one before less 1.
void writePalette(const AttributeCoding& coding, ByteWriter& out) {
  for (const std::vector<uint32_t>& words : coding.palette) {
    out.varint(static_cast<uint32_t>(words.size() - 1));
    out.u32(words[0]);
    for (size_t i = 1; i < words.size(); ++i) out.varint(words[i] - words[i - 1] - 1);
  }
}

void readPalette(ByteReader& in, const Attribute& attribute, AttributeCoding& coding) {
  size_t most = 1;
  for (int c = 0; c < attribute.components; ++c) {
    const uint32_t count = in.varint() + 1;
    std::vector<uint32_t>& words = coding.palette.emplace_back(1, in.u32());
    while (in.error() == Error::kNone && words.size() != count) {
      const uint64_t word = uint64_t{words.back()} + in.varint() + 1;
      if (word > 0xFFFFFFFFu) return coding.palette.clear();
      words.push_back(static_cast<uint32_t>(word));
    }
    most = std::max(most, words.size());
  }
  coding.bits = static_cast<int>(std::bit_width(most - 1));
  if (coding.bits > kMaxBits) coding.palette.clear();
}

void readFields(ByteReader& in, const Attribute& attribute, AttributeCoding& coding) {
  if (coding.kind == CodingKind::kConstant) {
    const auto bytes = in.take(attribute.stride());
    coding.constant.assign(bytes.begin(), bytes.end());
    return;
  }
  if (coding.kind == CodingKind::kSplitWords) return;
  if (coding.kind == CodingKind::kNumerals) return readNumerals(in, attribute, coding.numerals);
  if (coding.kind == CodingKind::kPalette) return readPalette(in, attribute, coding);
  coding.bits = in.byte();
  if (coding.kind == CodingKind::kQuantised) {
    for (int c = 0; c < attribute.components; ++c) coding.origin[c] = readFloat(in);
    coding.range = readFloat(in);
  }
  if (coding.kind == CodingKind::kGrid) {
    for (int c = 0; c < attribute.components; ++c) coding.origin[c] = readFloat(in);
    coding.step = readFloat(in);
    for (int c = 0; c < attribute.components; ++c) coding.first[c] = static_cast<int32_t>(in.u32());
  }
  if (coding.kind == CodingKind::kOctahedralSigned) coding.signs = in.byte();
  if (coding.kind == CodingKind::kWords || coding.kind == CodingKind::kFractions) coding.base = in.u32();
  if (coding.kind == CodingKind::kFractions) coding.denominator = in.varint();
  if (coding.summed) coding.total = in.varint();
}

}  // namespace

bool isValid(const AttributeCoding& coding, const Attribute& attribute) {
  const bool sums = coding.kind == CodingKind::kWords || coding.kind == CodingKind::kFractions;
  if (coding.summed && (!sums || attribute.components < 2)) return false;
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
    case CodingKind::kNumerals: return is_float && coding.numerals.valid();
    case CodingKind::kPalette: return is_float && !coding.palette.empty();
    case CodingKind::kGrid: return is_float && coding.bits >= 0 && coding.bits <= kMaxBits && finitePoints(coding);
  }
  return false;
}

double errorBound(const AttributeCoding& coding) {
  constexpr double kRounding = 0x1p-24;
  double magnitude = 0;
  switch (coding.kind) {
    case CodingKind::kOctahedral:
    case CodingKind::kOctahedralSigned: return 3.0 / octahedronCentre(coding.bits);
    case CodingKind::kQuantised:
      for (const float origin : coding.origin)
        magnitude = std::max(magnitude, std::fabs(origin) + double{coding.range});
      return coding.range / (std::ldexp(1.0, coding.bits) - 1) / 2 + magnitude * kRounding;
    case CodingKind::kGrid:
      for (size_t c = 0; c < coding.first.size(); ++c) {
        const double steps =
            std::max(std::fabs(double(coding.first[c])), std::fabs(coding.first[c] + std::ldexp(1.0, coding.bits)));
        magnitude = std::max(magnitude, std::fabs(coding.origin[c]) + steps * coding.step);
      }
      return coding.step / 2.0 + magnitude * kRounding;
    default: return 0;
  }
}

namespace {

const char* nameOf(CodingKind kind) {
  switch (kind) {
    case CodingKind::kConstant: return "constant";
    case CodingKind::kQuantised: return "quantised";
    case CodingKind::kOctahedral: return "octahedral";
    case CodingKind::kOctahedralSigned: return "octahedral with signs";
    case CodingKind::kWords: return "words";
    case CodingKind::kSplitWords: return "split words";
    case CodingKind::kFractions: return "fractions";
    case CodingKind::kNumerals: return "numerals";
    case CodingKind::kPalette: return "palette";
    case CodingKind::kGrid: return "grid";
  }
  return "unknown";
}

}  // namespace

std::string nameOf(const AttributeCoding& coding) {
  return std::string(nameOf(coding.kind)) + (coding.summed ? " with a fixed sum" : "");
}

void writeCoding(const AttributeCoding& coding, const Attribute& attribute, ByteWriter& out) {
  out.byte(static_cast<uint8_t>(static_cast<int>(coding.kind) | (coding.summed ? kSummed : 0)));
  if (coding.kind == CodingKind::kConstant) return out.append(coding.constant);
  if (coding.kind == CodingKind::kSplitWords) return;
  if (coding.kind == CodingKind::kNumerals) return writeNumerals(coding.numerals, out);
  if (coding.kind == CodingKind::kPalette) return writePalette(coding, out);
  out.byte(static_cast<uint8_t>(coding.bits));
  if (coding.kind == CodingKind::kQuantised) {
    for (int c = 0; c < attribute.components; ++c) writeFloat(coding.origin[c], out);
    writeFloat(coding.range, out);
  }
  if (coding.kind == CodingKind::kGrid) {
    for (int c = 0; c < attribute.components; ++c) writeFloat(coding.origin[c], out);
    writeFloat(coding.step, out);
    for (int c = 0; c < attribute.components; ++c) out.u32(static_cast<uint32_t>(coding.first[c]));
  }
  if (coding.kind == CodingKind::kOctahedralSigned) out.byte(coding.signs);
  if (coding.kind == CodingKind::kWords || coding.kind == CodingKind::kFractions) out.u32(coding.base);
  if (coding.kind == CodingKind::kFractions) out.varint(coding.denominator);
  if (coding.summed) out.varint(coding.total);
}

std::optional<AttributeCoding> readCoding(ByteReader& in, const Attribute& attribute) {
  AttributeCoding coding;
  const uint8_t head = in.byte(), kind = head & (kSummed - 1);
  if (kind > static_cast<uint8_t>(CodingKind::kGrid)) return std::nullopt;
  coding.kind = static_cast<CodingKind>(kind);
  coding.summed = (head & kSummed) != 0;
  readFields(in, attribute, coding);
  if (in.error() != Error::kNone || !isValid(coding, attribute)) return std::nullopt;
  return coding;
}

}  // namespace tutte
