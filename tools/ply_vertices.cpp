#include "tools/ply_vertices.h"

#include <cctype>
#include <map>
#include <string_view>

#include "tools/values.h"

namespace tutte {
namespace {

/// What a vertex property is for us: an attribute and which of its components.
struct Target {
  const char* attribute = nullptr;
  uint8_t component = 0;
};

Target targetOf(const std::string& name) {
  static const std::map<std::string, Target> targets = {{"x", {"POSITION", 0}},
                                                        {"y", {"POSITION", 1}},
                                                        {"z", {"POSITION", 2}},
                                                        {"nx", {"NORMAL", 0}},
                                                        {"ny", {"NORMAL", 1}},
                                                        {"nz", {"NORMAL", 2}},
                                                        {"s", {"TEXCOORD_0", 0}},
                                                        {"t", {"TEXCOORD_0", 1}},
                                                        {"u", {"TEXCOORD_0", 0}},
                                                        {"v", {"TEXCOORD_0", 1}},
                                                        {"texture_u", {"TEXCOORD_0", 0}},
                                                        {"texture_v", {"TEXCOORD_0", 1}},
                                                        {"red", {"COLOR_0", 0}},
                                                        {"green", {"COLOR_0", 1}},
                                                        {"blue", {"COLOR_0", 2}},
                                                        {"alpha", {"COLOR_0", 3}},
                                                        {"r", {"COLOR_0", 0}},
                                                        {"g", {"COLOR_0", 1}},
                                                        {"b", {"COLOR_0", 2}},
                                                        {"a", {"COLOR_0", 3}},
                                                        {"diffuse_red", {"COLOR_0", 0}},
                                                        {"diffuse_green", {"COLOR_0", 1}},
                                                        {"diffuse_blue", {"COLOR_0", 2}}};
  const auto found = targets.find(name);
  return found == targets.end() ? Target{} : found->second;
}

std::string customName(const std::string& name) {
  std::string result = "_";
  for (char c : name) result += static_cast<char>(std::isalnum(static_cast<unsigned char>(c)) ? std::toupper(c) : '_');
  return result;
}

/// The attribute, if the file has at least its first `least` components. Byte colours stay bytes, and opaque.
void addAttribute(const PlyVertices& vertices, const char* name, uint8_t least, uint8_t most, IndexedMesh& mesh) {
  std::vector<const std::vector<float>*> columns(most);
  bool bytes = true;
  for (size_t i = 0; i < vertices.columns.size(); ++i) {
    const Target target = targetOf(vertices.properties[i].name);
    if (!target.attribute || target.attribute != std::string_view(name) || vertices.properties[i].is_list) continue;
    columns[target.component] = &vertices.columns[i];
    bytes = bytes && vertices.properties[i].type == PlyType::kUint8;
  }
  uint8_t components = 0;
  while (components < most && columns[components]) ++components;
  const bool position = name == std::string_view("POSITION");
  if (components < least && !position) return;
  const bool byte_colors = bytes && name == std::string_view("COLOR_0");
  if (byte_colors) components = 4;
  if (position) components = 3;
  std::vector<float> values;
  for (size_t vertex = 0; vertex < mesh.vertex_count; ++vertex) {
    for (int i = 0; i < components; ++i) {
      const float absent = i == 3 ? 255.0f : 0.0f;
      const float given = columns[i] ? (*columns[i])[vertex] : absent;
      values.push_back(name == std::string_view("TEXCOORD_0") && i == 1 ? 1 - given : given);
    }
  }
  mesh.vertex_attributes.push_back(byte_colors
                                       ? byteAttribute(name, 4, std::vector<uint8_t>(values.begin(), values.end()))
                                       : floatAttribute(name, components, values));
}

}  // namespace

void addVertexAttributes(const PlyVertices& vertices, IndexedMesh& mesh, std::vector<std::string>& warnings) {
  addAttribute(vertices, "POSITION", 3, 3, mesh);
  addAttribute(vertices, "NORMAL", 3, 3, mesh);
  addAttribute(vertices, "TEXCOORD_0", 2, 2, mesh);
  addAttribute(vertices, "COLOR_0", 3, 4, mesh);
  for (size_t i = 0; i < vertices.columns.size(); ++i) {
    const PlyProperty& property = vertices.properties[i];
    if (targetOf(property.name).attribute) continue;
    if (property.is_list) {
      warnings.push_back("list '" + property.name + "' of vertices is not carried over");
    } else {
      mesh.vertex_attributes.push_back(floatAttribute(customName(property.name), 1, vertices.columns[i]));
    }
  }
}

}  // namespace tutte
