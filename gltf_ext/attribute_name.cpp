#include "gltf_ext/attribute_name.h"

#include <array>
#include <limits>
#include <optional>

namespace tutte {
namespace {

constexpr uint8_t kTargetFlag = 0x80;
constexpr size_t kMaxNameBytes = 1024;

struct Standard {
  std::string_view name;
  bool has_set;
};

// In the order of Semantic, from kPosition on.
constexpr std::array<Standard, 7> kStandards{{{"POSITION", false},
                                              {"NORMAL", false},
                                              {"TANGENT", false},
                                              {"TEXCOORD", true},
                                              {"COLOR", true},
                                              {"JOINTS", true},
                                              {"WEIGHTS", true}}};

const Standard& standardOf(Semantic semantic) { return kStandards[static_cast<size_t>(semantic) - 1]; }

/// Digits without a leading zero; anything else would not come back as it was.
std::optional<uint32_t> parseNumber(std::string_view digits) {
  if (digits.empty() || digits.size() > 10 || (digits.size() > 1 && digits[0] == '0')) return std::nullopt;
  uint64_t value = 0;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') return std::nullopt;
    value = 10 * value + static_cast<uint64_t>(digit - '0');
  }
  if (value > std::numeric_limits<uint32_t>::max()) return std::nullopt;
  return static_cast<uint32_t>(value);
}

/// `mark` and a number. Written out, for what the library has takes more code than the rest of the names.
void appendNumber(std::string& text, char mark, uint32_t number) {
  std::array<char, 11> digits;
  size_t first = digits.size();
  do {
    digits[--first] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number > 0);
  digits[--first] = mark;
  text.append(&digits[first], digits.size() - first);
}

std::string_view takeTarget(std::string_view name, AttributeName& result) {
  const size_t at = name.rfind('@');
  if (at == std::string_view::npos) return name;
  const auto target = parseNumber(name.substr(at + 1));
  if (!target) return name;
  result.is_target = true;
  result.target = *target;
  return name.substr(0, at);
}

bool takeStandard(std::string_view name, AttributeName& result) {
  for (size_t i = 0; i < kStandards.size(); ++i) {
    const auto& [base, has_set] = kStandards[i];
    if (!name.starts_with(base)) continue;
    const std::string_view rest = name.substr(base.size());
    if (has_set != rest.starts_with('_') || (!has_set && !rest.empty())) continue;
    const auto set = has_set ? parseNumber(rest.substr(1)) : 0;
    if (!set) continue;
    result.semantic = static_cast<Semantic>(i + 1);
    result.set = *set;
    return true;
  }
  return false;
}

}  // namespace

AttributeName parseName(std::string_view name) {
  AttributeName result;
  const std::string_view base = takeTarget(name, result);
  if (!takeStandard(base, result)) result.custom = base;
  return result;
}

std::string nameOf(const AttributeName& name) {
  std::string text = name.custom;
  if (name.semantic != Semantic::kCustom) {
    text = standardOf(name.semantic).name;
    if (standardOf(name.semantic).has_set) appendNumber(text, '_', name.set);
  }
  if (name.is_target) appendNumber(text, '@', name.target);
  return text;
}

void writeName(const AttributeName& name, ByteWriter& out) {
  out.byte(static_cast<uint8_t>(static_cast<uint8_t>(name.semantic) | (name.is_target ? kTargetFlag : 0)));
  if (name.semantic == Semantic::kCustom) {
    out.varint(static_cast<uint32_t>(name.custom.size()));
    out.append({reinterpret_cast<const uint8_t*>(name.custom.data()), name.custom.size()});
  } else if (standardOf(name.semantic).has_set) {
    out.varint(name.set);
  }
  if (name.is_target) out.varint(name.target);
}

bool readName(ByteReader& in, AttributeName& name) {
  const uint8_t code = in.byte();
  const uint8_t semantic = code & static_cast<uint8_t>(~kTargetFlag);
  if (semantic > kStandards.size()) return false;
  name.semantic = static_cast<Semantic>(semantic);
  name.is_target = (code & kTargetFlag) != 0;
  if (name.semantic == Semantic::kCustom) {
    const uint32_t length = in.varint();
    if (length > kMaxNameBytes) return false;
    const auto bytes = in.take(length);
    name.custom.assign(bytes.begin(), bytes.end());
  } else if (standardOf(name.semantic).has_set) {
    name.set = in.varint();
  }
  if (name.is_target) name.target = in.varint();
  return in.error() == Error::kNone;
}

}  // namespace tutte
