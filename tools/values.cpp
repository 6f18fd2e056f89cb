#include "tools/values.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace tutte {
namespace {

template <class T>
std::vector<float> convert(const Attribute& attribute) {
  std::vector<T> values(attribute.data.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), attribute.data.data(), values.size() * sizeof(T));
  const double scale = attribute.normalized ? 1.0 / static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
  std::vector<float> floats(values.size());
  std::transform(values.begin(), values.end(), floats.begin(), [&](T value) {
    const double scaled = static_cast<double>(value) * scale;
    return static_cast<float>(attribute.normalized ? std::max(scaled, -1.0) : scaled);
  });
  return floats;
}

}  // namespace

const Attribute* findAttribute(const PolygonMesh& mesh, std::string_view name) {
  const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                  [&](const Attribute& attribute) { return attribute.name == name; });
  return found == mesh.attributes.end() ? nullptr : &*found;
}

Attribute floatAttribute(std::string name, uint8_t components, std::span<const float> values) {
  Attribute attribute{.name = std::move(name), .components = components, .type = ComponentType::kFloat, .data = {}};
  const auto* bytes = reinterpret_cast<const uint8_t*>(values.data());
  attribute.data.assign(bytes, bytes + values.size_bytes());
  return attribute;
}

Attribute byteAttribute(std::string name, uint8_t components, std::span<const uint8_t> values) {
  return {.name = std::move(name),
          .components = components,
          .type = ComponentType::kUint8,
          .normalized = true,
          .data = {values.begin(), values.end()}};
}

std::vector<float> floatsOf(const Attribute& attribute) {
  switch (attribute.type) {
    case ComponentType::kInt8: return convert<int8_t>(attribute);
    case ComponentType::kUint8: return convert<uint8_t>(attribute);
    case ComponentType::kInt16: return convert<int16_t>(attribute);
    case ComponentType::kUint16: return convert<uint16_t>(attribute);
    case ComponentType::kUint32: return convert<uint32_t>(attribute);
    case ComponentType::kFloat: return convert<float>(attribute);
  }
  return {};
}

}  // namespace tutte
