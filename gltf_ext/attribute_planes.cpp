// Attribute data <-> planes of whole numbers: the formulas of attribute_coding.h.

#include <algorithm>
#include <cmath>

#include "gltf_ext/attribute_coding.h"
#include "gltf_ext/attribute_words.h"
#include "gltf_ext/octahedron.h"

namespace tutte {
namespace {

constexpr uint32_t kFractionZero = 0x80000000u;
constexpr int kSignsMixed = 2;

// Draco's predictors multiply: beyond these bits their 64-bit products could overflow.
constexpr int kMaxParentBits = 20;
constexpr int kMaxTexcoordBits = 18;

int32_t largest(int bits) { return static_cast<int32_t>((1u << bits) - 1); }

PlaneKind kindOf(const Attribute& attribute, const AttributeCoding& coding, size_t index) {
  const AttributeName name = parseName(attribute.name);
  const int components = attribute.components;
  if (name.is_target || coding.kind == CodingKind::kPalette) return PlaneKind::kSmooth;
  if (name.semantic == Semantic::kPosition && index == 0 && components == 3 && coding.bits <= kMaxParentBits) {
    return PlaneKind::kPosition;
  }
  if (name.semantic == Semantic::kTexcoord && components == 2 && coding.bits <= kMaxTexcoordBits) {
    return PlaneKind::kTexcoord;
  }
  const bool label =
      (coding.kind == CodingKind::kWords || coding.kind == CodingKind::kFractions) &&
      (name.semantic == Semantic::kCustom || name.semantic == Semantic::kJoints || name.semantic == Semantic::kWeights);
  return label ? PlaneKind::kLabel : PlaneKind::kSmooth;
}

Plane plane(PlaneKind kind, size_t attribute, int components, int32_t max) {
  Plane result;
  result.kind = kind;
  result.attribute = attribute;
  result.components = static_cast<uint8_t>(components);
  result.max = max;
  return result;
}

template <class Each>
void forEachComponent(const Attribute& attribute, Each each) {
  const uint32_t size = sizeOf(attribute.type);
  for (size_t i = 0; i * size < attribute.data.size(); ++i) each(i, &attribute.data[i * size]);
}

/// For each component that planes hold: without the first, where a sum tells it.
template <class Each>
void forEachCoded(const Attribute& attribute, const AttributeCoding& coding, Each each) {
  size_t number = 0;
  forEachComponent(attribute, [&](size_t i, const uint8_t* data) {
    if (!coding.summed || i % attribute.components != 0) each(number++, data);
  });
}

void quantise(const Attribute& attribute, const AttributeCoding& coding, Plane& out) {
  const double steps = largest(coding.bits);
  forEachComponent(attribute, [&](size_t i, const uint8_t* data) {
    const double offset = double{loadFloat(data)} - coding.origin[i % attribute.components];
    const double number = coding.range > 0 ? std::floor(offset * steps / coding.range + 0.5) : 0;
    out.values[i] = static_cast<int32_t>(std::clamp(number, 0.0, steps));
  });
}

void toOctahedron(const Attribute& attribute, const AttributeCoding& coding, std::span<Plane> planes) {
  const uint32_t stride = attribute.stride();
  for (size_t w = 0; w * stride < attribute.data.size(); ++w) {
    const uint8_t* data = &attribute.data[w * stride];
    const auto point = vectorToPoint({loadFloat(data), loadFloat(data + 4), loadFloat(data + 8)}, coding.bits);
    std::copy(point.begin(), point.end(), &planes[0].values[2 * w]);
    if (planes.size() > 1) planes[1].values[w] = loadFloat(data + 12) > 0;
  }
}

void toWords(const Attribute& attribute, const AttributeCoding& coding, std::span<Plane> planes) {
  forEachCoded(attribute, coding, [&](size_t i, const uint8_t* data) {
    const uint32_t word = wordOf(data, attribute.type);
    if (coding.kind == CodingKind::kWords) {
      planes[0].values[i] = static_cast<int32_t>(word - coding.base);
    } else {
      planes[0].values[i] = static_cast<int32_t>(word >> 16);
      planes[1].values[i] = static_cast<int32_t>(word & 0xFFFF);
    }
  });
}

void toFractions(const Attribute& attribute, const AttributeCoding& coding, Plane& out) {
  forEachCoded(attribute, coding, [&](size_t i, const uint8_t* data) {
    const auto numerator = static_cast<int32_t>(std::nearbyint(double{loadFloat(data)} * coding.denominator));
    out.values[i] = static_cast<int32_t>(static_cast<uint32_t>(numerator) + kFractionZero - coding.base);
  });
}

template <size_t kComponents, class Make>
void storeFloats(std::span<const int32_t> numbers, uint8_t* data, Make make) {
  for (size_t i = 0; i + kComponents <= numbers.size(); i += kComponents) {
    for (size_t c = 0; c < kComponents; ++c, data += 4) storeFloat(data, make(numbers[i + c], c));
  }
}

/// Stores make(number, component) for each number.
template <class Make>
void storeFloats(const Plane& in, Attribute& out, Make make) {
  uint8_t* const data = out.data.data();
  switch (out.components) {
    case 1: return storeFloats<1>(in.values, data, make);
    case 2: return storeFloats<2>(in.values, data, make);
    case 3: return storeFloats<3>(in.values, data, make);
    default: return storeFloats<4>(in.values, data, make);
  }
}

void dequantise(const Plane& in, const AttributeCoding& coding, Attribute& out) {
  const double steps = largest(coding.bits), range = coding.range;
  storeFloats(in, out, [=, origin = coding.origin](int32_t number, size_t c) {
    return static_cast<float>(double{origin[c]} + number * range / steps);
  });
}

void fromOctahedron(std::span<const Plane> planes, const AttributeCoding& coding, Attribute& out) {
  for (size_t w = 0; 2 * w < planes[0].values.size(); ++w) {
    uint8_t* data = &out.data[w * out.stride()];
    const auto vector = pointToVector({planes[0].values[2 * w], planes[0].values[2 * w + 1]}, coding.bits);
    for (int c = 0; c < 3; ++c) storeFloat(data + 4 * c, vector[c]);
    if (out.components != 4) continue;
    const bool positive = coding.signs == kSignsMixed ? planes[1].values[w] != 0 : coding.signs != 0;
    storeFloat(data + 12, positive ? 1.0f : -1.0f);
  }
}

/// Calls store(component, word) for all components of all wedges until it returns false. The first component's word is
/// what the others' distances from `zero` leave of the sum, if a sum is fixed.
template <class Store>
bool forEachWord(const Plane& in, const AttributeCoding& coding, uint32_t zero, Store store) {
  const size_t components = in.components + coding.summed;
  size_t component = 0;
  for (const int32_t* value = in.values.data(); value != in.values.data() + in.values.size(); component += components) {
    uint32_t rest = coding.total;
    for (size_t c = coding.summed; c < components; ++c) {
      const uint64_t word = uint64_t{coding.base} + static_cast<uint32_t>(*value++);
      rest -= static_cast<uint32_t>(word) - zero;
      if (!store(component + c, word)) return false;
    }
    if (coding.summed && !store(component, uint64_t{rest + zero})) return false;
  }
  return true;
}

bool fromWords(const Plane& in, const AttributeCoding& coding, Attribute& out) {
  const uint32_t size = sizeOf(out.type);
  return forEachWord(in, coding, 0, [&](size_t i, uint64_t word) {
    if (word > largestWord(out.type)) return false;
    storeWord(&out.data[i * size], out.type, static_cast<uint32_t>(word));
    return true;
  });
}

void fromSplitWords(std::span<const Plane> planes, Attribute& out) {
  for (size_t i = 0; i < planes[0].values.size(); ++i) {
    const auto upper = static_cast<uint32_t>(planes[0].values[i]), lower = static_cast<uint32_t>(planes[1].values[i]);
    storeWord(&out.data[4 * i], out.type, upper << 16 | lower);
  }
}

bool fromFractions(const Plane& in, const AttributeCoding& coding, Attribute& out) {
  return forEachWord(in, coding, kFractionZero, [&](size_t i, uint64_t word) {
    const double numerator = static_cast<double>(static_cast<int64_t>(word) - int64_t{kFractionZero});
    storeFloat(&out.data[4 * i], static_cast<float>(numerator / coding.denominator));
    return true;
  });
}

void toPalette(const Attribute& attribute, const AttributeCoding& coding, Plane& out) {
  forEachComponent(attribute, [&](size_t i, const uint8_t* data) {
    const std::vector<uint32_t>& words = coding.palette[i % attribute.components];
    const auto at = std::lower_bound(words.begin(), words.end(), wordOf(data, ComponentType::kFloat));
    out.values[i] = static_cast<int32_t>(at - words.begin());
  });
}

bool fromPalette(const Plane& in, const AttributeCoding& coding, Attribute& out) {
  for (size_t i = 0; i < in.values.size(); ++i) {
    const std::vector<uint32_t>& words = coding.palette[i % out.components];
    if (static_cast<size_t>(in.values[i]) >= words.size()) return false;
    storeWord(&out.data[4 * i], ComponentType::kFloat, words[in.values[i]]);
  }
  return true;
}

void toGrid(const Attribute& attribute, const AttributeCoding& coding, Plane& out) {
  forEachComponent(attribute, [&](size_t i, const uint8_t* data) {
    const size_t c = i % attribute.components;
    out.values[i] = static_cast<int32_t>(gridPoint(loadFloat(data), coding.origin[c], coding.step) - coding.first[c]);
  });
}

void fromGrid(const Plane& in, const AttributeCoding& coding, Attribute& out) {
  const double step = coding.step;
  storeFloats(in, out, [=, origin = coding.origin, first = coding.first](int32_t number, size_t c) {
    return static_cast<float>(double{origin[c]} + (double(number) + first[c]) * step);
  });
}

bool inRange(const Plane& plane, Index wedge_count) {
  if (plane.values.size() != size_t{wedge_count} * plane.components) return false;
  uint32_t signs = 0;  // without decisions, so that compilers make vectors of it
  for (const int32_t value : plane.values) {
    signs |= static_cast<uint32_t>(value) | (static_cast<uint32_t>(plane.max) - static_cast<uint32_t>(value));
  }
  return signs >> 31 == 0;
}

}  // namespace

std::vector<Plane> planesOf(const Attribute& attribute, const AttributeCoding& coding, size_t index) {
  const int components = attribute.components;
  switch (coding.kind) {
    case CodingKind::kConstant:
    case CodingKind::kNumerals: return {};
    case CodingKind::kOctahedral: return {plane(PlaneKind::kNormal, index, 2, 2 * octahedronCentre(coding.bits))};
    case CodingKind::kOctahedralSigned: {
      std::vector<Plane> planes{plane(PlaneKind::kDirection, index, 2, 2 * octahedronCentre(coding.bits))};
      if (coding.signs == kSignsMixed) planes.push_back(plane(PlaneKind::kLabel, index, 1, 1));
      return planes;
    }
    case CodingKind::kSplitWords:
      return {plane(PlaneKind::kLabel, index, components, 0xFFFF), plane(PlaneKind::kLabel, index, components, 0xFFFF)};
    default: return {plane(kindOf(attribute, coding, index), index, components - coding.summed, largest(coding.bits))};
  }
}

void splitValues(const Attribute& attribute, const AttributeCoding& coding, std::span<Plane> planes) {
  const size_t wedges = attribute.data.size() / attribute.stride();
  for (Plane& plane : planes) plane.values.assign(wedges * plane.components, 0);
  switch (coding.kind) {
    case CodingKind::kConstant:
    case CodingKind::kNumerals: return;
    case CodingKind::kQuantised: return quantise(attribute, coding, planes[0]);
    case CodingKind::kPalette: return toPalette(attribute, coding, planes[0]);
    case CodingKind::kGrid: return toGrid(attribute, coding, planes[0]);
    case CodingKind::kOctahedral:
    case CodingKind::kOctahedralSigned: return toOctahedron(attribute, coding, planes);
    case CodingKind::kWords:
    case CodingKind::kSplitWords: return toWords(attribute, coding, planes);
    case CodingKind::kFractions: return toFractions(attribute, coding, planes[0]);
  }
}

bool joinValues(std::span<const Plane> planes, const AttributeCoding& coding, Index wedge_count, Attribute& attribute) {
  for (const Plane& plane : planes) {
    if (!inRange(plane, wedge_count)) return false;
  }
  if (coding.kind == CodingKind::kNumerals) return true;
  attribute.data.resize(size_t{wedge_count} * attribute.stride());
  switch (coding.kind) {
    case CodingKind::kConstant:
      for (size_t i = 0; i < attribute.data.size(); ++i) attribute.data[i] = coding.constant[i % attribute.stride()];
      return true;
    case CodingKind::kQuantised: return dequantise(planes[0], coding, attribute), true;
    case CodingKind::kPalette: return fromPalette(planes[0], coding, attribute);
    case CodingKind::kGrid: return fromGrid(planes[0], coding, attribute), true;
    case CodingKind::kOctahedral:
    case CodingKind::kOctahedralSigned: return fromOctahedron(planes, coding, attribute), true;
    case CodingKind::kWords: return fromWords(planes[0], coding, attribute);
    case CodingKind::kSplitWords: return fromSplitWords(planes, attribute), true;
    case CodingKind::kFractions: return fromFractions(planes[0], coding, attribute);
    case CodingKind::kNumerals: break;
  }
  return false;
}

}  // namespace tutte
