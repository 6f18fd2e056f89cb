#pragma once
// The head of a PLY file: which elements it holds and how their values are written.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gltf_ext/failure.h"

namespace tutte {

enum class PlyType : uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

/// Bytes of a value in a binary file.
uint32_t sizeOf(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat { kText, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::kText;
  std::vector<PlyElement> elements;
  size_t size = 0;   ///< where the values begin
  size_t lines = 0;  ///< of the header
};

/// `bytes` may be anything. Failures name the line.
Outcome<PlyHeader> readPlyHeader(std::span<const uint8_t> bytes);

}  // namespace tutte
