#include "gltf_ext/extension.h"

#include <array>

namespace tutte {
namespace {

constexpr std::array<const char*, kModeCount> kModeNames = {
    "TRIANGLES", "POLYGON_LOOPS", "POLYGON_LOOP_OFFSETS", "POLYGON_INDEX_OFFSETS", "DEGREES", "ATTRIBUTE", "WELD"};

/// Four components of four bytes.
constexpr uint64_t kMaxAttributeStride = 16;

std::optional<Mode> modeOf(const std::string& name) {
  for (size_t i = 0; i < kModeNames.size(); ++i) {
    if (name == kModeNames[i]) return static_cast<Mode>(i);
  }
  return std::nullopt;
}

Outcome<Done> checkStride(const CompressedView& view, const std::string& where) {
  const uint64_t stride = view.byte_stride;
  if (view.mode == Mode::kAttribute) {
    if (stride > 0 && stride <= kMaxAttributeStride && stride % 4 == 0) return Done{};
    return invalid(where + "/byteStride", "an attribute's byteStride is 4, 8, 12 or 16");
  }
  if (stride == 1 || stride == 2 || stride == 4) return Done{};
  return invalid(where + "/byteStride", "the byteStride of indices and counts is 1, 2 or 4");
}

}  // namespace

const char* nameOf(Mode mode) { return kModeNames[static_cast<size_t>(mode)]; }

Outcome<CompressedView> parseCompressedView(const Json& object, const std::string& where) {
  if (!object.is_object()) return invalid(where, "this is not an object");
  CompressedView view;
  struct Property {
    const char* name;
    uint64_t* value;
    bool required;
  };
  const Property properties[] = {{"buffer", &view.payload.buffer, true},
                                 {"byteOffset", &view.payload.byte_offset, false},
                                 {"byteLength", &view.payload.byte_length, true},
                                 {"byteStride", &view.byte_stride, true},
                                 {"count", &view.count, true},
                                 {"attribute", &view.attribute, false}};
  for (const Property& property : properties) {
    const auto value = property.required ? integerMember(object, property.name, where)
                                         : integerMember(object, property.name, 0, where);
    if (!value) return value.error();
    *property.value = *value;
  }
  const std::string name = stringMember(object, "mode");
  const auto mode = modeOf(name);
  if (name.empty()) return invalid(where + "/mode", "the property 'mode' is missing or not a string");
  if (!mode) return unsupported(where + "/mode", "the mode '" + name + "' is unknown");
  view.mode = *mode;
  const bool names_attribute = member(object, "attribute") != nullptr;
  if (names_attribute != (*mode == Mode::kAttribute)) {
    return invalid(where, "'attribute' goes with the mode ATTRIBUTE, and only with it");
  }
  if (view.payload.byte_length == 0) return invalid(where + "/byteLength", "a payload is not empty");
  if (view.count == 0 || view.count > 0xFFFFFFFFu) return invalid(where + "/count", "the count is out of range");
  const auto stride = checkStride(view, where);
  if (!stride) return stride.error();
  return view;
}

Json toJson(const CompressedView& view) {
  Json object = {{"buffer", view.payload.buffer},
                 {"byteOffset", view.payload.byte_offset},
                 {"byteLength", view.payload.byte_length},
                 {"byteStride", view.byte_stride},
                 {"count", view.count},
                 {"mode", nameOf(view.mode)}};
  if (view.mode == Mode::kAttribute) object["attribute"] = view.attribute;
  return object;
}

Outcome<std::optional<CompressedView>> compressedViewAt(const Json& json, uint64_t index) {
  const auto view = elementOf(json, "bufferViews", index);
  if (!view) return view.error();
  const Json* extensions = objectMember(**view, "extensions");
  const Json* object = extensions ? member(*extensions, kExtensionName) : nullptr;
  if (!object) return std::optional<CompressedView>();
  auto parsed = parseCompressedView(*object, pointerTo("bufferViews", index) + "/extensions/" + kExtensionName);
  if (!parsed) return parsed.error();
  return std::optional<CompressedView>(*parsed);
}

bool isFallbackBuffer(const Json& buffer) {
  const Json* extensions = objectMember(buffer, "extensions");
  if (!extensions) return false;
  for (const Json& extension : *extensions) {
    const Json* fallback = member(extension, "fallback");
    if (fallback && fallback->is_boolean() && fallback->get<bool>()) return true;
  }
  return false;
}

}  // namespace tutte
