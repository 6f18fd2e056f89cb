#include "tools/ply_header.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "tools/text.h"

namespace tutte {
namespace {

std::optional<PlyType> typeOf(std::string_view word) {
  using enum PlyType;
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", kInt8},
                                                                                {"int8", kInt8},
                                                                                {"uchar", kUint8},
                                                                                {"uint8", kUint8},
                                                                                {"short", kInt16},
                                                                                {"int16", kInt16},
                                                                                {"ushort", kUint16},
                                                                                {"uint16", kUint16},
                                                                                {"int", kInt32},
                                                                                {"int32", kInt32},
                                                                                {"uint", kUint32},
                                                                                {"uint32", kUint32},
                                                                                {"float", kFloat},
                                                                                {"float32", kFloat},
                                                                                {"double", kDouble},
                                                                                {"float64", kDouble}}};
  for (const auto& [name, type] : kTypes) {
    if (name == word) return type;
  }
  return {};
}

class HeaderReader {
 public:
  explicit HeaderReader(std::span<const uint8_t> bytes)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {}

  Outcome<PlyHeader> run() {
    std::string_view line;
    if (!takeLine(line) || trimmed(line) != "ply") return fail("the file does not begin with 'ply'; give a PLY file");
    bool format_given = false;
    while (takeLine(line)) {
      const std::string_view word = nextWord(line);
      if (word == "end_header") {
        if (!format_given) return fail("the format line is missing; add one such as 'format ascii 1.0'");
        header_.size = at_;
        header_.lines = line_;
        return std::move(header_);
      }
      if (word == "format") {
        if (!(format_given = takeFormat(line))) return fail("unknown format; PLY has ascii and two binary ones");
      } else if (word == "element") {
        if (!takeElement(line)) return fail("an element needs a name and a count");
      } else if (word == "property") {
        if (header_.elements.empty() || !takeProperty(line)) return fail("this property cannot be understood");
      } else if (word != "comment" && word != "obj_info" && !word.empty()) {
        return fail("'" + std::string(word.substr(0, 40)) + "' does not belong into a PLY header");
      }
    }
    return fail("the header does not end; 'end_header' is missing");
  }

 private:
  Failure fail(std::string what) const {
    return {FailureKind::kInvalid, "line " + std::to_string(line_), std::move(what)};
  }

  bool takeLine(std::string_view& line) {
    ++line_;
    const size_t end = text_.find_first_of("\r\n", at_);
    if (end == text_.npos) return false;
    line = text_.substr(at_, end - at_);
    at_ = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1);
    return true;
  }

  bool takeFormat(std::string_view line) {
    const std::string_view format = nextWord(line);
    if (format == "ascii")
      header_.format = PlyFormat::kText;
    else if (format == "binary_little_endian")
      header_.format = PlyFormat::kLittleEndian;
    else if (format == "binary_big_endian")
      header_.format = PlyFormat::kBigEndian;
    else
      return false;
    return nextWord(line) == "1.0";
  }

  bool takeElement(std::string_view line) {
    PlyElement element{.name = std::string(nextWord(line)), .properties = {}};
    const auto count = parseInteger<uint64_t>(nextWord(line));
    element.count = count.value_or(0);
    header_.elements.push_back(std::move(element));
    return count.has_value();
  }

  bool takeProperty(std::string_view line) {
    PlyProperty property;
    std::string_view word = nextWord(line);
    if (word == "list") {
      property.is_list = true;
      const auto count_type = typeOf(nextWord(line));
      if (!count_type || *count_type >= PlyType::kFloat) return false;
      property.count_type = *count_type;
      word = nextWord(line);
    }
    const auto type = typeOf(word);
    property.name = nextWord(line);
    property.type = type.value_or(PlyType::kFloat);
    header_.elements.back().properties.push_back(property);
    return type && !property.name.empty();
  }

  std::string_view text_;
  size_t at_ = 0;
  size_t line_ = 0;
  PlyHeader header_;
};

}  // namespace

uint32_t sizeOf(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8: return 1;
    case PlyType::kInt16:
    case PlyType::kUint16: return 2;
    case PlyType::kDouble: return 8;
    default: return 4;
  }
}

Outcome<PlyHeader> readPlyHeader(std::span<const uint8_t> bytes) { return HeaderReader(bytes).run(); }

}  // namespace tutte
