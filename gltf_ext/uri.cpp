#include "gltf_ext/uri.h"

#include <algorithm>
#include <array>

#include "gltf_ext/json_access.h"

namespace tutte {
namespace {

constexpr std::string_view kBase64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

int hexValue(char c) {
  if (isDigit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::array<int8_t, 256> base64Values() {
  std::array<int8_t, 256> values;
  values.fill(-1);
  for (size_t i = 0; i < kBase64.size(); ++i) values[static_cast<uint8_t>(kBase64[i])] = static_cast<int8_t>(i);
  values['-'] = 62;  // the URL-safe alphabet occurs in the wild
  values['_'] = 63;
  return values;
}

std::optional<std::vector<uint8_t>> decodeBase64(std::string_view text) {
  static const std::array<int8_t, 256> values = base64Values();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<uint8_t> bytes;
  bytes.reserve(text.size() * 3 / 4);
  uint32_t bits = 0;
  int filled = 0;
  for (const char c : text) {
    const int value = values[static_cast<uint8_t>(c)];
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<uint32_t>(value);
    filled += 6;
    if (filled >= 8) {
      filled -= 8;
      bytes.push_back(static_cast<uint8_t>(bits >> filled));
    }
  }
  return bytes;
}

}  // namespace

bool hasScheme(std::string_view uri) {
  if (uri.starts_with("//")) return true;
  if (uri.empty() || !isLetter(uri.front())) return false;
  for (const char c : uri) {
    if (c == ':') return true;
    if (!isLetter(c) && !isDigit(c) && c != '+' && c != '-' && c != '.') return false;
  }
  return false;
}

bool isDataUri(std::string_view uri) { return uri.starts_with("data:"); }

Outcome<std::vector<uint8_t>> decodeDataUri(std::string_view uri, const std::string& where) {
  const size_t comma = uri.find(',');
  if (!isDataUri(uri) || comma == std::string_view::npos) return invalid(where, "this is not a data URI");
  const std::string_view head = uri.substr(0, comma), body = uri.substr(comma + 1);
  if (head.ends_with(";base64")) {
    auto bytes = decodeBase64(body);
    if (!bytes) return invalid(where, "the data URI is not valid base64");
    return *std::move(bytes);
  }
  const auto text = percentDecode(body);
  if (!text) return invalid(where, "the data URI has an invalid percent escape");
  return std::vector<uint8_t>(text->begin(), text->end());
}

std::string makeDataUri(const std::vector<uint8_t>& bytes) {
  std::string uri = "data:application/octet-stream;base64,";
  uri.reserve(uri.size() + (bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = std::min<size_t>(3, bytes.size() - i);
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < left ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) uri += k <= left ? kBase64[bits >> (18 - 6 * k) & 63] : '=';
  }
  return uri;
}

std::optional<std::string> percentDecode(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (text.size() - i < 3 || hexValue(text[i + 1]) < 0 || hexValue(text[i + 2]) < 0) return std::nullopt;
    decoded += static_cast<char>(hexValue(text[i + 1]) * 16 + hexValue(text[i + 2]));
    i += 2;
  }
  return decoded;
}

std::string percentEncode(std::string_view text) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    if (isLetter(c) || isDigit(c) || std::string_view("-._~/").find(c) != std::string_view::npos) {
      encoded += c;
    } else {
      encoded += {'%', kHex[static_cast<uint8_t>(c) >> 4], kHex[c & 15]};
    }
  }
  return encoded;
}

}  // namespace tutte
