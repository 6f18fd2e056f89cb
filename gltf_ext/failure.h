#pragma once
// What glTF-side functions return when they fail: the kind (which is also the exit code of `tutte`), the place, and
// a sentence that says what is wrong and what to do.

#include <string>

#include "codec/result.h"

namespace tutte {

enum class FailureKind : int {
  kUsage = 1,         ///< the caller asked for something that makes no sense
  kInvalid = 2,       ///< the input breaks the rules of its format
  kUnsupported = 3,   ///< the input is valid, but uses something that we do not handle
  kVerification = 4,  ///< two meshes that should be equal differ
  kIo = 5,            ///< reading or writing failed
};

struct Failure {
  FailureKind kind = FailureKind::kInvalid;
  std::string where;  ///< a JSON pointer such as /bufferViews/3, a file name, or both; may be empty
  std::string what;
};

template <class T>
using Outcome = Result<T, Failure>;

/// For functions that return nothing but may fail.
struct Done {};

/// A codec error as a failure at a place.
inline Failure failureOf(Error error, std::string where) {
  const bool unsupported = error == Error::kUnsupportedVersion;
  return {unsupported ? FailureKind::kUnsupported : FailureKind::kInvalid, std::move(where),
          std::string(describe(error))};
}

}  // namespace tutte
