#include "tools/draco_input.h"

#include "gltf_ext/attribute_coding.h"

namespace tutte {
namespace {

draco::DataType dataType(ComponentType type) {
  switch (type) {
    case ComponentType::kInt8: return draco::DT_INT8;
    case ComponentType::kUint8: return draco::DT_UINT8;
    case ComponentType::kInt16: return draco::DT_INT16;
    case ComponentType::kUint16: return draco::DT_UINT16;
    case ComponentType::kUint32: return draco::DT_UINT32;
    default: return draco::DT_FLOAT32;
  }
}

draco::GeometryAttribute::Type semanticOf(const Attribute& attribute) {
  const AttributeName name = parseName(attribute.name);
  const bool is_float = attribute.type == ComponentType::kFloat;
  if (name.is_target) return draco::GeometryAttribute::GENERIC;
  if (name.semantic == Semantic::kPosition) return draco::GeometryAttribute::POSITION;
  if (name.semantic == Semantic::kTexcoord) return draco::GeometryAttribute::TEX_COORD;
  if (name.semantic == Semantic::kColor) return draco::GeometryAttribute::COLOR;
  const bool normal = name.semantic == Semantic::kNormal && is_float && attribute.components == 3;
  return normal ? draco::GeometryAttribute::NORMAL : draco::GeometryAttribute::GENERIC;
}

/// Builds the draco::Mesh: a point per triangle corner, then everything equal is merged.
class MeshBuilder {
 public:
  /// The first `attributes` of the mesh.
  MeshBuilder(const PolygonMesh& source, const DracoTriangles& triangles, size_t attributes)
      : source_(source), triangles_(triangles) {
    mesh_->set_num_points(static_cast<uint32_t>(3 * triangles.corners.size()));
    mesh_->SetNumFaces(triangles.corners.size());
    for (uint32_t f = 0; f < triangles.corners.size(); ++f) {
      mesh_->SetFace(draco::FaceIndex(f),
                     {draco::PointIndex(3 * f), draco::PointIndex(3 * f + 1), draco::PointIndex(3 * f + 2)});
    }
    for (size_t i = 0; i < attributes; ++i) add(source.attributes[i]);
  }

  void markAddedEdges() {
    draco::PointAttribute& marks = newAttribute(draco::GeometryAttribute::GENERIC, 1, draco::DT_UINT8, false, 2);
    for (const uint8_t value : {uint8_t{0}, uint8_t{1}})
      marks.SetAttributeValue(draco::AttributeValueIndex(value), &value);
    for (uint32_t f = 0; f < triangles_.corners.size(); ++f) {
      for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t mark = i == 1 && triangles_.added_edge[f] ? 1 : 0;
        marks.SetPointMapEntry(draco::PointIndex(3 * f + i), draco::AttributeValueIndex(mark));
      }
    }
    auto metadata = std::make_unique<draco::AttributeMetadata>();
    metadata->AddEntryString("name", kAddedEdges);
    mesh_->AddAttributeMetadata(mesh_->num_attributes() - 1, std::move(metadata));
  }

  std::unique_ptr<draco::Mesh> finish() && {
    if (!mesh_->DeduplicateAttributeValues()) return nullptr;
    mesh_->DeduplicatePointIds();
    return std::move(mesh_);
  }

 private:
  draco::PointAttribute& newAttribute(draco::GeometryAttribute::Type type, int components, draco::DataType data_type,
                                      bool normalized, uint32_t values) {
    draco::GeometryAttribute description;
    description.Init(type, nullptr, static_cast<uint8_t>(components), data_type, normalized,
                     components * draco::DataTypeLength(data_type), 0);
    const int id = mesh_->AddAttribute(description, false, values);
    return *mesh_->attribute(id);
  }

  void add(const Attribute& attribute) {
    draco::PointAttribute& target = newAttribute(semanticOf(attribute), attribute.components, dataType(attribute.type),
                                                 attribute.normalized, source_.wedge_count);
    target.buffer()->Write(0, attribute.data.data(), attribute.data.size());
    for (uint32_t f = 0; f < triangles_.corners.size(); ++f) {
      for (uint32_t i = 0; i < 3; ++i) {
        const Index wedge = source_.wedgeOf(triangles_.corners[f][i]);
        target.SetPointMapEntry(draco::PointIndex(3 * f + i), draco::AttributeValueIndex(wedge));
      }
    }
  }

  const PolygonMesh& source_;
  const DracoTriangles& triangles_;
  std::unique_ptr<draco::Mesh> mesh_ = std::make_unique<draco::Mesh>();
};

}  // namespace

DracoTriangles fanTriangles(const Polygons& polygons) {
  DracoTriangles result;
  Index first = 0;
  for (const Index degree : polygons.face_degrees) {
    for (Index i = 1; i + 1 < degree; ++i) {
      result.corners.push_back({first, first + i, first + i + 1});
      result.added_edge.push_back(i + 2 < degree);
    }
    first += degree;
  }
  return result;
}

DracoTriangles givenTriangles(const PolygonMesh& mesh) {
  if (mesh.triangulation.counts.empty()) return fanTriangles(mesh.polygons);
  DracoTriangles result;
  const auto& corners = mesh.triangulation.corners;
  for (size_t i = 0; i + 3 <= corners.size(); i += 3) {
    result.corners.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  return result;
}

std::unique_ptr<draco::Mesh> dracoMesh(const PolygonMesh& mesh, const DracoTriangles& triangles, size_t attributes,
                                       bool mark_added_edges) {
  MeshBuilder builder(mesh, triangles, attributes);
  if (mark_added_edges) builder.markAddedEdges();
  return std::move(builder).finish();
}

draco::EncoderOptions dracoOptions(const PolygonMesh& mesh, const PackOptions& options, int level) {
  draco::EncoderOptions result = draco::EncoderOptions::CreateDefaultOptions();
  result.SetSpeed(10 - level, 10 - level);
  for (size_t i = 0; i < mesh.attributes.size(); ++i) {
    const Attribute& attribute = mesh.attributes[i];
    const int bits = quantisationBits(parseName(attribute.name), options);
    if (attribute.type == ComponentType::kFloat && bits > 0) {
      result.SetAttributeInt(static_cast<int>(i), "quantization_bits", bits);
    }
  }
  return result;
}

}  // namespace tutte
