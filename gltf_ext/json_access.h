#pragma once
// JSON read without exceptions: every look-up checks kind and range, and names the place in its Failure.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "gltf_ext/failure.h"
#include "gltf_ext/guard.h"

namespace tutte {

using Json = nlohmann::json;

/// Integers in JSON are exact up to here.
inline constexpr uint64_t kMaxJsonInteger = uint64_t{1} << 53;

/// Nesting deeper than this is refused: several JSON libraries overflow the stack on it.
inline constexpr int kMaxJsonDepth = 128;

/// Parses JSON text of any origin. Errors: kInvalid (syntax, UTF-8, depth, or not an object).
Outcome<Json> parseJson(std::string_view text, const std::string& where);

/// The member `key`, or null when `object` is no object or has none.
const Json* member(const Json& object, const char* key);

/// The member `key` when it is an object, or null.
const Json* objectMember(const Json& object, const char* key);

/// The member `key` when it is a string, or "".
std::string stringMember(const Json& object, const char* key);

/// The value as a non-negative integer of at most 2^53 (4 and 4.0 are both integers), or nothing.
std::optional<uint64_t> asInteger(const Json& value);

/// A required non-negative integer member. Errors: kInvalid.
Outcome<uint64_t> integerMember(const Json& object, const char* key, const std::string& where);

/// The same with a default for an absent member.
Outcome<uint64_t> integerMember(const Json& object, const char* key, uint64_t absent, const std::string& where);

/// `json[array][index]`, which must be an object. Errors: kInvalid, with the pointer /array/index.
Outcome<const Json*> elementOf(const Json& json, const char* array, uint64_t index);

/// Elements of the top-level array `array`; 0 when there is none.
size_t countOf(const Json& json, const char* array);

/// "/accessors/3".
std::string pointerTo(const char* array, uint64_t index);

/// True when the array `list` ("extensionsUsed", "extensionsRequired") names `extension`.
bool listsExtension(const Json& json, const char* list, const std::string& extension);

/// Adds the name once; a missing or malformed list is made anew.
void addExtension(Json& json, const char* list, const std::string& extension);

/// Removes the name, and the list when it becomes empty.
void removeExtension(Json& json, const char* list, const std::string& extension);

/// Removes `extension` from an object's `extensions`, and that when it becomes empty.
void eraseExtension(Json& object, const std::string& extension);

/// The object's extension of that name, or null.
const Json* extensionOf(const Json& object, const char* extension);

/// Shorthand for a kInvalid failure.
Failure invalid(std::string where, std::string what);

/// Shorthand for a kUnsupported failure.
Failure unsupported(std::string where, std::string what);

/// Runs `work`, turning what a library below throws (memory, JSON types) into a Failure.
template <class T, class Work>
Outcome<T> guarded(Work&& work) {
  return caught([&]() -> Outcome<T> { return work(); },
                [](const Thrown& thrown) -> Outcome<T> {
                  return thrown.memory ? unsupported("", thrown.what) : invalid("", thrown.what);
                });
}

}  // namespace tutte
