#include "gltf_ext/accessors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "gltf_ext/extension.h"

namespace tutte {
namespace {

/// The most that an accessor without data may make us allocate.
constexpr uint64_t kMaxZeroBytes = uint64_t{256} << 20;

struct TypeShape {
  const char* name;
  uint32_t columns;
  uint32_t components;
};
constexpr TypeShape kTypes[] = {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4},
                                {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};

bool isComponentType(uint64_t number) { return (number >= 5120 && number <= 5123) || number == 5125 || number == 5126; }

/// Elements inside a view: where the first one is, and how far apart they are.
struct Elements {
  std::span<const uint8_t> bytes;
  uint64_t stride = 0;

  const uint8_t* at(uint64_t i) const { return bytes.data() + i * stride; }
};

/// Checks that `count` elements fit into the view behind `object` (an accessor or a part of a sparse one).
Outcome<Elements> elementsOf(const Asset& asset, const Json& object, uint64_t count, uint64_t element_bytes,
                             bool allow_stride, const std::string& where) {
  const auto index = integerMember(object, "bufferView", where);
  if (!index) return index.error();
  const auto bytes = viewBytes(asset, *index);
  if (!bytes) return bytes.error();
  const auto offset = integerMember(object, "byteOffset", 0, where);
  if (!offset) return offset.error();
  const Json& view = asset.json["bufferViews"][*index];
  const auto stride = integerMember(view, "byteStride", element_bytes, pointerTo("bufferViews", *index));
  if (!stride) return stride.error();
  const uint64_t step = allow_stride ? *stride : element_bytes;
  if (step < element_bytes || step > 4096)
    return invalid(where, "the byteStride is smaller than an element or too large");
  if (*offset > bytes->size()) return invalid(where + "/byteOffset", "the accessor begins behind its buffer view");
  const uint64_t available = bytes->size() - *offset;
  if (count == 0) return Elements{bytes->subspan(*offset), step};
  if (available < element_bytes || (available - element_bytes) / step < count - 1) {
    return invalid(where, "the accessor is longer than its buffer view");
  }
  return Elements{bytes->subspan(*offset), step};
}

Outcome<std::vector<Index>> readSparseIndices(const Asset& asset, const Json& sparse, uint64_t count, uint64_t limit,
                                              const std::string& where) {
  const Json* part = objectMember(sparse, "indices");
  if (!part) return invalid(where, "a sparse accessor needs indices");
  const auto type = integerMember(*part, "componentType", where + "/indices");
  if (!type) return type.error();
  if (*type != 5121 && *type != 5123 && *type != 5125) return invalid(where + "/indices", "these are not integers");
  const uint64_t size = sizeOf(static_cast<ComponentType>(*type));
  const auto elements = elementsOf(asset, *part, count, size, false, where + "/indices");
  if (!elements) return elements.error();
  std::vector<Index> indices(count);
  for (uint64_t i = 0; i < count; ++i) {
    std::memcpy(&indices[i], elements->at(i), size);
    if (indices[i] >= limit || (i > 0 && indices[i] <= indices[i - 1])) {
      return invalid(where + "/indices", "sparse indices must rise and stay below the accessor's count");
    }
  }
  return indices;
}

/// Which elements a sparse accessor replaces, and by what.
struct SparseParts {
  std::vector<Index> indices;
  Elements values;
};

Outcome<SparseParts> sparseParts(const Asset& asset, const Json& sparse, const AccessorShape& shape,
                                 const std::string& where) {
  const auto count = integerMember(sparse, "count", where);
  if (!count) return count.error();
  if (*count > shape.count) return invalid(where + "/count", "more sparse values than the accessor has elements");
  auto indices = readSparseIndices(asset, sparse, *count, shape.count, where);
  if (!indices) return indices.error();
  const Json* part = objectMember(sparse, "values");
  if (!part) return invalid(where, "a sparse accessor needs values");
  const auto values = elementsOf(asset, *part, *count, shape.elementBytes(), false, where + "/values");
  if (!values) return values.error();
  return SparseParts{*std::move(indices), *values};
}

Outcome<Done> applySparse(const Asset& asset, const Json& sparse, const AccessorShape& shape, Bytes& data,
                          const std::string& where) {
  const auto parts = sparseParts(asset, sparse, shape, where);
  if (!parts) return parts.error();
  const uint64_t size = shape.elementBytes();
  for (size_t i = 0; i < parts->indices.size(); ++i) {
    std::memcpy(data.data() + parts->indices[i] * size, parts->values.at(i), size);
  }
  return Done{};
}

Outcome<Bytes> readDense(const Asset& asset, const Json& accessor, const AccessorShape& shape,
                         const std::string& where) {
  const uint64_t size = shape.elementBytes();
  if (!member(accessor, "bufferView")) {
    if (shape.count > kMaxZeroBytes / size) return unsupported(where, "an accessor of zeros is too large");
    return Bytes(shape.count * size);
  }
  const auto elements = elementsOf(asset, accessor, shape.count, size, true, where);
  if (!elements) return elements.error();
  Bytes data(shape.count * size);
  for (uint64_t i = 0; i < shape.count; ++i) std::memcpy(data.data() + i * size, elements->at(i), size);
  return data;
}

}  // namespace

uint32_t AccessorShape::elementBytes() const {
  const uint32_t column = components * sizeOf(type);
  return isMatrix() ? (column + 3) / 4 * 4 * columns : column;
}

Outcome<AccessorShape> accessorShape(const Json& json, uint64_t index) {
  const std::string where = pointerTo("accessors", index);
  const auto accessor = elementOf(json, "accessors", index);
  if (!accessor) return accessor.error();
  const auto count = integerMember(**accessor, "count", where);
  if (!count) return count.error();
  const auto type = integerMember(**accessor, "componentType", where);
  if (!type) return type.error();
  if (!isComponentType(*type)) return unsupported(where + "/componentType", "this component type is unknown");
  if (*count == 0 || *count > 0xFFFFFFFFu) return invalid(where + "/count", "the count is out of range");
  const Json* normalized = member(**accessor, "normalized");
  AccessorShape shape{*count, 1, 1, static_cast<ComponentType>(*type), normalized && *normalized == true};
  const std::string name = stringMember(**accessor, "type");
  for (const TypeShape& known : kTypes) {
    if (name != known.name) continue;
    shape.columns = known.columns;
    shape.components = known.components;
    return shape;
  }
  return invalid(where + "/type", "this type is unknown");
}

Outcome<std::span<const uint8_t>> viewBytes(const Asset& asset, uint64_t index) {
  const std::string where = pointerTo("bufferViews", index);
  const auto view = elementOf(asset.json, "bufferViews", index);
  if (!view) return view.error();
  const auto buffer = integerMember(**view, "buffer", where);
  if (!buffer) return buffer.error();
  const auto offset = integerMember(**view, "byteOffset", 0, where);
  if (!offset) return offset.error();
  const auto length = integerMember(**view, "byteLength", where);
  if (!length) return length.error();
  if (*buffer >= asset.buffers.size()) return invalid(where + "/buffer", "there is no such buffer");
  const Bytes& bytes = asset.buffers[*buffer];
  if (bytes.empty() && *length > 0) {
    return unsupported(where, "the buffer has no data here: its views are compressed by an extension");
  }
  if (*offset > bytes.size() || *length > bytes.size() - *offset) {
    return invalid(where, "the buffer view does not lie inside its buffer");
  }
  return std::span(bytes).subspan(*offset, *length);
}

Outcome<Bytes> readAccessor(const Asset& asset, uint64_t index) {
  const std::string where = pointerTo("accessors", index);
  const auto shape = accessorShape(asset.json, index);
  if (!shape) return shape.error();
  const Json& accessor = asset.json["accessors"][index];
  auto data = readDense(asset, accessor, *shape, where);
  if (!data) return data;
  if (const Json* sparse = member(accessor, "sparse")) {
    const auto applied = applySparse(asset, *sparse, *shape, *data, where + "/sparse");
    if (!applied) return applied.error();
  }
  return data;
}

Outcome<Done> checkAccessor(const Asset& asset, uint64_t index, uint64_t& sparse_budget) {
  const std::string where = pointerTo("accessors", index);
  const auto shape = accessorShape(asset.json, index);
  if (!shape) return shape.error();
  const Json& accessor = asset.json["accessors"][index];
  if (member(accessor, "bufferView")) {
    const auto dense = elementsOf(asset, accessor, shape->count, shape->elementBytes(), true, where);
    if (!dense) return dense.error();
  }
  const Json* sparse = member(accessor, "sparse");
  if (!sparse) return Done{};
  const auto count = integerMember(*sparse, "count", where + "/sparse");
  if (!count) return count.error();
  if (*count > sparse_budget) return invalid(where + "/sparse/count", "the sparse accessors overlap too much");
  sparse_budget -= *count;
  const auto parts = sparseParts(asset, *sparse, *shape, where + "/sparse");
  if (!parts) return parts.error();
  return Done{};
}

Outcome<std::vector<Index>> readIndices(const Asset& asset, uint64_t index) {
  const auto shape = accessorShape(asset.json, index);
  if (!shape) return shape.error();
  const bool integers = shape->type == ComponentType::kUint8 || shape->type == ComponentType::kUint16 ||
                        shape->type == ComponentType::kUint32;
  if (!integers || shape->components != 1) {
    return invalid(pointerTo("accessors", index), "indices must be unsigned SCALARs");
  }
  const auto data = readAccessor(asset, index);
  if (!data) return data.error();
  const size_t size = sizeOf(shape->type);
  std::vector<Index> indices(shape->count);
  for (size_t i = 0; i < indices.size(); ++i) std::memcpy(&indices[i], data->data() + i * size, size);
  return indices;
}

double componentAt(std::span<const uint8_t> data, size_t k, ComponentType type) {
  const auto load = [&]<class T>(T value) {
    std::memcpy(&value, data.data() + k * sizeof(T), sizeof(T));
    return static_cast<double>(value);
  };
  switch (type) {
    case ComponentType::kInt8: return load(int8_t{});
    case ComponentType::kUint8: return load(uint8_t{});
    case ComponentType::kInt16: return load(int16_t{});
    case ComponentType::kUint16: return load(uint16_t{});
    case ComponentType::kUint32: return load(uint32_t{});
    case ComponentType::kFloat: return load(float{});
  }
  return 0;
}

void setBounds(Json& accessor, std::span<const uint8_t> data, uint32_t components, ComponentType type) {
  const size_t count = data.size() / (components * sizeOf(type));
  if (count == 0) {
    accessor.erase("min");
    accessor.erase("max");
    return;
  }
  std::array<double, 4> low, high;
  for (size_t k = 0; k < components; ++k) low[k] = high[k] = componentAt(data, k, type);
  for (size_t i = components; i < count * components; ++i) {
    const double value = componentAt(data, i, type);
    low[i % components] = std::min(low[i % components], value);
    high[i % components] = std::max(high[i % components], value);
  }
  for (size_t k = 0; k < components; ++k) {
    if (!std::isfinite(low[k]) || !std::isfinite(high[k])) return setBounds(accessor, {}, components, type);
  }
  const auto list = [&](const std::array<double, 4>& values) {
    Json array = Json::array();
    for (size_t k = 0; k < components; ++k) {
      if (type == ComponentType::kFloat) {
        array.push_back(values[k]);
      } else {
        array.push_back(static_cast<int64_t>(values[k]));
      }
    }
    return array;
  };
  accessor["min"] = list(low);
  accessor["max"] = list(high);
}

const char* typeName(uint32_t components) { return kTypes[components - 1].name; }

Bytes padElements(std::span<const uint8_t> data, size_t element_bytes, size_t stride) {
  if (element_bytes == stride) return Bytes(data.begin(), data.end());
  const size_t count = data.size() / element_bytes;
  Bytes padded(count * stride);
  for (size_t i = 0; i < count; ++i) {
    std::memcpy(padded.data() + i * stride, data.data() + i * element_bytes, element_bytes);
  }
  return padded;
}

size_t appendElement(Json& json, const char* array, Json element) {
  Json& list = json[array];
  if (!list.is_array()) list = Json::array();
  list.push_back(std::move(element));
  return list.size() - 1;
}

size_t appendView(Asset& asset, Bytes bytes, Json view) {
  view["buffer"] = appendElement(asset.json, "buffers", {{"byteLength", bytes.size()}});
  view["byteOffset"] = 0;
  view["byteLength"] = bytes.size();
  asset.buffers.resize(countOf(asset.json, "buffers"));
  asset.buffers.back() = std::move(bytes);
  return appendElement(asset.json, "bufferViews", std::move(view));
}

}  // namespace tutte
