#pragma once
// URIs in glTF: their schemes, data URIs, percent escapes.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf_ext/failure.h"

namespace tutte {

/// True for "https:...", "data:..." and their like, and for "//host/...".
bool hasScheme(std::string_view uri);

/// True for "data:...".
bool isDataUri(std::string_view uri);

/// The bytes of a base64 or percent-encoded data URI. Errors: kInvalid at `where`.
Outcome<std::vector<uint8_t>> decodeDataUri(std::string_view uri, const std::string& where);

/// A base64 data URI of type application/octet-stream.
std::string makeDataUri(const std::vector<uint8_t>& bytes);

/// "a%20b" to "a b"; nothing when a % is not followed by two hexadecimal digits.
std::optional<std::string> percentDecode(std::string_view text);

/// The reverse, for file names.
std::string percentEncode(std::string_view text);

}  // namespace tutte
