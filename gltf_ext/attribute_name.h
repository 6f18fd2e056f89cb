#pragma once
// Attribute names, taken apart: what an attribute means decides how it is coded.

#include <cstdint>
#include <string>
#include <string_view>

#include "codec/bytes.h"

namespace tutte {

/// glTF's attribute semantics; the numbers are part of the format.
enum class Semantic : uint8_t {
  kCustom = 0,
  kPosition = 1,
  kNormal = 2,
  kTangent = 3,
  kTexcoord = 4,
  kColor = 5,
  kJoints = 6,
  kWeights = 7,
};

/// "TEXCOORD_1@4" is the semantic kTexcoord, set 1, of morph target 4.
struct AttributeName {
  Semantic semantic = Semantic::kCustom;
  uint32_t set = 0;        ///< of TEXCOORD, COLOR, JOINTS, WEIGHTS
  bool is_target = false;  ///< values are a morph target's displacements
  uint32_t target = 0;
  std::string custom;  ///< of kCustom: the name as it is, without the target

  bool operator==(const AttributeName&) const = default;
};

AttributeName parseName(std::string_view name);

/// The reverse of parseName(), for every name.
std::string nameOf(const AttributeName& name);

void writeName(const AttributeName& name, ByteWriter& out);

/// False when the bytes are no name; the reader may hold an error as well.
bool readName(ByteReader& in, AttributeName& name);

}  // namespace tutte
