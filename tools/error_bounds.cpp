// The option --error.

#include <array>
#include <memory>

#include "tools/command.h"
#include "tools/text.h"

namespace tutte {
namespace {

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array<Unit, 6> kUnits{{{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"km", 1e3}, {"m", 1}, {"", 1}}};

/// Positive, finite.
std::optional<double> parseSize(std::string_view text) {
  const auto number = parseFloat(text);
  return number && *number > 0 ? std::optional<double>(std::stod(std::string(text))) : std::nullopt;
}

/// "0.1mm", "0.01%", "0.001"; other attributes than positions have no length.
std::optional<ErrorBound> parseBound(std::string_view text, bool length) {
  if (text.ends_with('%')) {
    const auto percent = parseSize(text.substr(0, text.size() - 1));
    return percent && *percent < 100 ? std::optional(ErrorBound{*percent / 100, true}) : std::nullopt;
  }
  for (const Unit& unit : kUnits) {
    if (!text.ends_with(unit.name) || (!length && !unit.name.empty())) continue;
    const auto size = parseSize(text.substr(0, text.size() - unit.name.size()));
    return size ? std::optional(ErrorBound{*size * unit.metres, false}) : std::nullopt;
  }
  return {};
}

ErrorBound* boundNamed(std::string_view name, ErrorBounds& errors) {
  if (name == "POSITION") return &errors.position;
  if (name == "TEXCOORD") return &errors.texcoord;
  if (name == "COLOR") return &errors.color;
  return name == "OTHER" ? &errors.generic : nullptr;
}

/// An error message, or nothing.
std::string takeBound(const std::string& text, ErrorBounds& errors) {
  const size_t equals = text.find('=');
  const std::string name = equals == text.npos ? "POSITION" : text.substr(0, equals);
  ErrorBound* const target = boundNamed(name, errors);
  if (!target) return "'" + name + "' has no error bound; name POSITION, TEXCOORD, COLOR or OTHER";
  const auto bound = parseBound(text.substr(equals == text.npos ? 0 : equals + 1), name == "POSITION");
  if (!bound) {
    return "'" + text + "' is no error bound; give a number above 0" +
           (name == "POSITION" ? ", with um, mm, cm, m, km or % behind it" : ", with % behind it or nothing");
  }
  *target = *bound;
  return "";
}

}  // namespace

void addErrorBounds(CLI::App& command, ErrorBounds& errors) {
  const auto texts = std::make_shared<std::vector<std::string>>();
  command
      .add_option("--error", *texts,
                  "the largest error of a coordinate, such as 0.1mm or 0.01% of the size, instead "
                  "of bits; for others TEXCOORD=, COLOR=, OTHER=")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Validator([&errors, texts](std::string& text) { return takeBound(text, errors); }, ""))
      ->type_name("BOUND,...")
      ->group("Quantisation");
}

}  // namespace tutte
