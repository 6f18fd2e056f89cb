#pragma once
// Errors are values: every function of the codec that can fail returns a Result.

#include <cassert>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace tutte {

/// Why the codec refused its input. The numbers are part of the C ABI and never change.
enum class Error : uint8_t {
  kNone = 0,
  kTruncated = 1,           ///< the bytes end before the mesh does
  kMalformed = 2,           ///< the bytes break a rule of the format
  kUnsupportedVersion = 3,  ///< another version of the format
  kLimitExceeded = 4,       ///< more vertices, faces or corners than the caller's Limits allow
  kIndexOutOfRange = 5,     ///< (encoding) a corner names a vertex that does not exist
  kCountMismatch = 6,       ///< the sizes of two arrays contradict each other
  kTooLarge = 7,            ///< (encoding) more than 2^30 corners
  kChecksum = 8,            ///< a section's bytes do not match their checksum
  kMissingSection = 9,      ///< a payload lacks a section that its counts require
  kTrailingBytes = 10,      ///< bytes after the end of the last section
  kOutOfMemory = 11,        ///< the system refused memory
  kAttributes = 12,         ///< the attribute section is damaged or of an unknown kind
};

/// A sentence for users, without a trailing full stop.
constexpr std::string_view describe(Error error) {
  switch (error) {
    case Error::kNone: return "no error";
    case Error::kTruncated: return "the data ends before the mesh does";
    case Error::kMalformed: return "the data breaks a rule of the format";
    case Error::kUnsupportedVersion: return "the data has an unsupported format version";
    case Error::kLimitExceeded: return "the mesh is larger than the limits allow";
    case Error::kIndexOutOfRange: return "a corner names a vertex that does not exist";
    case Error::kCountMismatch: return "two counts contradict each other";
    case Error::kTooLarge: return "the mesh has more than 2^30 corners";
    case Error::kChecksum: return "a checksum does not match: the data is damaged";
    case Error::kMissingSection: return "a required section is missing";
    case Error::kTrailingBytes: return "there are bytes after the end of the data";
    case Error::kOutOfMemory: return "out of memory";
    case Error::kAttributes: return "the attribute section is damaged";
  }
  return "unknown error";
}

/// A value or the reason why there is none. `E` is any type constructible from its failure.
template <class T, class E = Error>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(E error) : error_(std::move(error)) {}

  explicit operator bool() const { return value_.has_value(); }
  bool ok() const { return value_.has_value(); }
  const E& error() const {
    assert(!value_);
    return error_;
  }
  T& operator*() & { return *value_; }
  const T& operator*() const& { return *value_; }
  T&& operator*() && { return *std::move(value_); }
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }

 private:
  std::optional<T> value_;
  E error_{};
};

}  // namespace tutte
