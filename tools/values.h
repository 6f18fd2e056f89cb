#pragma once
// Attribute values as numbers.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// The attribute of that name, or nullptr.
const Attribute* findAttribute(const PolygonMesh& mesh, std::string_view name);

/// A float attribute with these values.
Attribute floatAttribute(std::string name, uint8_t components, std::span<const float> values);

/// A normalised byte attribute with these values.
Attribute byteAttribute(std::string name, uint8_t components, std::span<const uint8_t> values);

/// All values of an attribute as it is stored, `components` per wedge; normalised integers become 0..1 or -1..1.
std::vector<float> floatsOf(const Attribute& attribute);

}  // namespace tutte
