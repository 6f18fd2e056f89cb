#pragma once
// Accessors of any asset, read with every bound checked, and new ones written.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/json_access.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// What an accessor says about its elements.
struct AccessorShape {
  uint64_t count = 0;
  uint32_t columns = 1;     ///< of a MAT type; otherwise 1
  uint32_t components = 1;  ///< per column
  ComponentType type = ComponentType::kFloat;
  bool normalized = false;

  bool isMatrix() const { return columns > 1; }
  /// Bytes of one element as it is stored: matrix columns begin at multiples of 4.
  uint32_t elementBytes() const;
};

/// Errors: kInvalid, kUnsupported (component types of extensions), at /accessors/`index`.
Outcome<AccessorShape> accessorShape(const Json& json, uint64_t index);

/// The bytes of a buffer view. Errors: kInvalid when it leaves its buffer; kUnsupported when it is compressed or its
/// buffer has no data. The span is valid as long as the asset's buffers are.
Outcome<std::span<const uint8_t>> viewBytes(const Asset& asset, uint64_t index);

/// All elements, tightly packed (matrix columns keep their padding), sparse values put in place. An accessor without a
/// buffer view is all zeros, and is refused when that would take more than 256 MiB.
Outcome<Bytes> readAccessor(const Asset& asset, uint64_t index);

/// The checks of readAccessor() without the data. `sparse_budget` is lowered by the number of sparse values, and when
/// it does not suffice the accessor is refused: so that many accessors over the same bytes cannot take much time.
Outcome<Done> checkAccessor(const Asset& asset, uint64_t index, uint64_t& sparse_budget);

/// A SCALAR accessor of unsigned integers. Errors: kInvalid for any other.
Outcome<std::vector<Index>> readIndices(const Asset& asset, uint64_t index);

/// Component `k` of tightly packed data as a number: what an accessor's min and max hold.
double componentAt(std::span<const uint8_t> data, size_t k, ComponentType type);

/// Sets "min" and "max" of an accessor from its decoded, tightly packed data; removes them where there is none.
void setBounds(Json& accessor, std::span<const uint8_t> data, uint32_t components, ComponentType type);

/// "SCALAR", "VEC2", "VEC3", "VEC4" for 1 to 4 components.
const char* typeName(uint32_t components);

/// Elements of `element_bytes` at distances of `stride`, zeros between.
Bytes padElements(std::span<const uint8_t> data, size_t element_bytes, size_t stride);

/// Adds a buffer with these bytes and a view of all of it; returns the view's index.
size_t appendView(Asset& asset, Bytes bytes, Json view = Json::object());

/// Adds an element to a top-level array; returns its index.
size_t appendElement(Json& json, const char* array, Json element);

}  // namespace tutte
