#include "gltf_ext/json_access.h"

#include <cmath>

namespace tutte {
namespace {

/// Deepest nesting of arrays and objects, strings skipped.
int depthOf(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

Failure invalid(std::string where, std::string what) {
  return {FailureKind::kInvalid, std::move(where), std::move(what)};
}

Failure unsupported(std::string where, std::string what) {
  return {FailureKind::kUnsupported, std::move(where), std::move(what)};
}

Outcome<Json> parseJson(std::string_view text, const std::string& where) {
  if (depthOf(text) > kMaxJsonDepth) return invalid(where, "the JSON is nested deeper than 128 levels");
  Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) return invalid(where, "this is not valid JSON");
  if (!json.is_object()) return invalid(where, "the JSON is not an object");
  return json;
}

const Json* member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

const Json* objectMember(const Json& object, const char* key) {
  const Json* value = member(object, key);
  return value && value->is_object() ? value : nullptr;
}

std::string stringMember(const Json& object, const char* key) {
  const Json* value = member(object, key);
  return value && value->is_string() ? value->get<std::string>() : std::string();
}

std::optional<uint64_t> asInteger(const Json& value) {
  if (value.is_number_unsigned()) {
    const auto number = value.get<uint64_t>();
    return number <= kMaxJsonInteger ? std::optional(number) : std::nullopt;
  }
  if (value.is_number_integer()) {
    const auto number = value.get<int64_t>();
    return number >= 0 && static_cast<uint64_t>(number) <= kMaxJsonInteger
               ? std::optional(static_cast<uint64_t>(number))
               : std::nullopt;
  }
  if (!value.is_number_float()) return std::nullopt;
  const double number = value.get<double>();
  if (!(number >= 0 && number <= static_cast<double>(kMaxJsonInteger)) || number != std::floor(number)) {
    return std::nullopt;
  }
  return static_cast<uint64_t>(number);
}

Outcome<uint64_t> integerMember(const Json& object, const char* key, const std::string& where) {
  const Json* value = member(object, key);
  if (!value) return invalid(where, std::string("the property '") + key + "' is missing");
  const auto number = asInteger(*value);
  if (!number) return invalid(where + "/" + key, "this is not a non-negative integer");
  return *number;
}

Outcome<uint64_t> integerMember(const Json& object, const char* key, uint64_t absent, const std::string& where) {
  return member(object, key) ? integerMember(object, key, where) : Outcome<uint64_t>(absent);
}

Outcome<const Json*> elementOf(const Json& json, const char* array, uint64_t index) {
  const Json* list = member(json, array);
  if (!list || !list->is_array() || index >= list->size()) {
    return invalid(pointerTo(array, index), "something refers to this element, but it does not exist");
  }
  const Json& element = (*list)[index];
  if (!element.is_object()) return invalid(pointerTo(array, index), "this is not an object");
  return &element;
}

size_t countOf(const Json& json, const char* array) {
  const Json* list = member(json, array);
  return list && list->is_array() ? list->size() : 0;
}

std::string pointerTo(const char* array, uint64_t index) {
  return std::string("/") + array + "/" + std::to_string(index);
}

bool listsExtension(const Json& json, const char* list, const std::string& extension) {
  const Json* names = member(json, list);
  if (!names || !names->is_array()) return false;
  for (const Json& name : *names) {
    if (name == extension) return true;
  }
  return false;
}

void addExtension(Json& json, const char* list, const std::string& extension) {
  if (listsExtension(json, list, extension)) return;
  Json& names = json[list];
  if (!names.is_array()) names = Json::array();
  names.push_back(extension);
}

void removeExtension(Json& json, const char* list, const std::string& extension) {
  if (!listsExtension(json, list, extension)) return;
  Json kept = Json::array();
  for (const Json& name : json[list]) {
    if (name != extension) kept.push_back(name);
  }
  if (kept.empty()) {
    json.erase(list);
  } else {
    json[list] = std::move(kept);
  }
}

void eraseExtension(Json& object, const std::string& extension) {
  if (!objectMember(object, "extensions")) return;
  object["extensions"].erase(extension);
  if (object["extensions"].empty()) object.erase("extensions");
}

const Json* extensionOf(const Json& object, const char* extension) {
  const Json* extensions = objectMember(object, "extensions");
  return extensions ? objectMember(*extensions, extension) : nullptr;
}

}  // namespace tutte
