#pragma once
// A shape with its connectivity coded, ready for attributes.

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "codec/encode.h"
#include "gltf_ext/attributes.h"
#include "tests/shapes/shapes.h"

namespace tutte {

/// `vertex`: of each wedge, in coded order; `topology()` finds the seams of any attributes.
struct CodedMesh {
  Connectivity connectivity;
  std::vector<Index> wedges;                ///< per coded corner
  std::vector<Index> vertex;                ///< per wedge: the shape's vertex
  std::vector<std::vector<uint8_t>> seams;  ///< filled by topology()

  Index wedgeCount() const { return static_cast<Index>(vertex.size()); }

  AttributeTopology topology(const std::vector<Attribute>& attributes);
};

/// One wedge per vertex; with `split`, one wedge per corner of every second face, so that there are seams.
CodedMesh codeMesh(const shapes::Shape& shape, bool split = false);

/// An attribute whose components are `value(wedge, component)`.
template <class T, class Value>
Attribute makeAttribute(std::string name, ComponentType type, int components, Index wedge_count, Value value) {
  Attribute attribute;
  attribute.name = std::move(name);
  attribute.type = type;
  attribute.components = static_cast<uint8_t>(components);
  attribute.data.resize(size_t{wedge_count} * attribute.stride());
  for (Index w = 0; w < wedge_count; ++w) {
    for (int c = 0; c < components; ++c) {
      const auto number = static_cast<T>(value(w, c));
      std::memcpy(&attribute.data[w * attribute.stride() + c * sizeof(T)], &number, sizeof(T));
    }
  }
  return attribute;
}

template <class Value>
Attribute makeFloats(std::string name, int components, Index wedge_count, Value value) {
  return makeAttribute<float>(std::move(name), ComponentType::kFloat, components, wedge_count, value);
}

inline float floatAt(const Attribute& attribute, Index wedge, int component) {
  float value;
  std::memcpy(&value, &attribute.data[wedge * attribute.stride() + component * sizeof(float)], sizeof(float));
  return value;
}

/// The shape's positions, or invented ones; equal for all wedges of a vertex.
Attribute positionsOf(const CodedMesh& mesh, const shapes::Shape& shape);

}  // namespace tutte
