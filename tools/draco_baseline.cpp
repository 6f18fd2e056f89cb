#include "tools/draco_baseline.h"

#include <draco/compression/config/encoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_edgebreaker_encoder.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <memory>
#include <vector>

#include "gltf_ext/attribute_coding.h"

namespace tutte {
namespace {

using Clock = std::chrono::steady_clock;
using Triangle = std::array<Index, 3>;

constexpr uint64_t kHeaderBytes = 11;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Draco's encoder with a watch on its connectivity step.
class WatchedEncoder : public draco::MeshEdgebreakerEncoder {
 public:
  uint64_t connectivityBytes() const { return bytes_; }
  double connectivitySeconds() const { return seconds_; }

 protected:
  draco::Status EncodeConnectivity() override {
    const Clock::time_point start = Clock::now();
    const size_t before = buffer()->size();
    draco::Status status = MeshEdgebreakerEncoder::EncodeConnectivity();
    bytes_ = buffer()->size() - before;
    seconds_ = secondsSince(start);
    return status;
  }

 private:
  uint64_t bytes_ = 0;
  double seconds_ = 0;
};

/// The same for the decoder.
class WatchedDecoder : public draco::MeshEdgebreakerDecoder {
 public:
  double connectivitySeconds() const { return seconds_; }

 protected:
  bool DecodeConnectivity() override {
    const Clock::time_point start = Clock::now();
    const bool done = MeshEdgebreakerDecoder::DecodeConnectivity();
    seconds_ = secondsSince(start);
    return done;
  }

 private:
  double seconds_ = 0;
};

/// Triangles as indices into the mesh's corners, each with its added edges.
struct Triangles {
  std::vector<Triangle> corners;
  std::vector<uint8_t> added_edge;  ///< per triangle: 1 when the edge opposite to its second corner was added
};

Triangles fans(const Polygons& polygons) {
  Triangles result;
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

Triangles trianglesOf(const PolygonMesh& mesh) {
  if (mesh.triangulation.counts.empty()) return fans(mesh.polygons);
  Triangles result;
  const auto& corners = mesh.triangulation.corners;
  for (size_t i = 0; i + 3 <= corners.size(); i += 3) {
    result.corners.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  return result;
}

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
  MeshBuilder(const PolygonMesh& source, const Triangles& triangles) : source_(source), triangles_(triangles) {
    mesh_->set_num_points(static_cast<uint32_t>(3 * triangles.corners.size()));
    mesh_->SetNumFaces(triangles.corners.size());
    for (uint32_t f = 0; f < triangles.corners.size(); ++f) {
      mesh_->SetFace(draco::FaceIndex(f),
                     {draco::PointIndex(3 * f), draco::PointIndex(3 * f + 1), draco::PointIndex(3 * f + 2)});
    }
    for (const Attribute& attribute : source.attributes) add(attribute);
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
    metadata->AddEntryString("name", "added_edges");
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
  const Triangles& triangles_;
  std::unique_ptr<draco::Mesh> mesh_ = std::make_unique<draco::Mesh>();
};

draco::EncoderOptions encoderOptions(const PolygonMesh& mesh, const PackOptions& options, int level) {
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

Failure refused(const std::string& message) { return {FailureKind::kUnsupported, "Draco", message}; }

/// Keeps the lesser time, or the only one.
void best(double& kept, double seconds, bool first) { kept = first ? seconds : std::min(kept, seconds); }

Outcome<Done> encodeOnce(const draco::Mesh& mesh, const draco::EncoderOptions& options, bool first,
                         draco::EncoderBuffer& buffer, DracoFigures& figures) {
  WatchedEncoder encoder;
  encoder.SetMesh(mesh);
  buffer.Clear();
  const Clock::time_point start = Clock::now();
  const draco::Status status = encoder.Encode(options, &buffer);
  best(figures.encode_seconds, secondsSince(start), first);
  best(figures.connectivity_encode_seconds, encoder.connectivitySeconds(), first);
  if (!status.ok()) return refused(status.error_msg_string());
  figures.total_bytes = buffer.size();
  figures.connectivity_bytes = encoder.connectivityBytes();
  figures.attribute_bytes = figures.total_bytes - figures.connectivity_bytes - kHeaderBytes;
  return Done{};
}

Outcome<Done> decodeOnce(const draco::EncoderBuffer& bytes, bool first, DracoFigures& figures) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  WatchedDecoder decoder;
  draco::Mesh mesh;
  const draco::DecoderOptions options;
  const Clock::time_point start = Clock::now();
  const draco::Status status = decoder.Decode(options, &buffer, &mesh);
  best(figures.decode_seconds, secondsSince(start), first);
  best(figures.connectivity_decode_seconds, decoder.connectivitySeconds(), first);
  if (!status.ok()) return refused(status.error_msg_string());
  return Done{};
}

Outcome<DracoFigures> measure(std::unique_ptr<draco::Mesh> mesh, const draco::EncoderOptions& options,
                              int repetitions) {
  if (!mesh) return refused("values could not be welded");
  DracoFigures figures;
  draco::EncoderBuffer buffer;
  for (int i = 0; i < std::max(repetitions, 1); ++i) {
    if (const auto done = encodeOnce(*mesh, options, i == 0, buffer, figures); !done) return done.error();
    if (const auto done = decodeOnce(buffer, i == 0, figures); !done) return done.error();
  }
  return figures;
}

Outcome<DracoFigures> runDraco(const PolygonMesh& mesh, const PackOptions& options, const DracoRun& run,
                               bool keep_polygons) {
  try {
    const Triangles triangles = keep_polygons ? fans(mesh.polygons) : trianglesOf(mesh);
    if (triangles.corners.empty()) return refused("the mesh has no triangles");
    MeshBuilder builder(mesh, triangles);
    draco::EncoderOptions encoder_options = encoderOptions(mesh, options, run.compression_level);
    if (keep_polygons) {
      builder.markAddedEdges();
      const int marks = static_cast<int>(mesh.attributes.size());
      encoder_options.SetAttributeInt(marks, "prediction_scheme", draco::PREDICTION_NONE);  // as draco_encoder does
    }
    return measure(std::move(builder).finish(), encoder_options, run.repetitions);
  } catch (const std::exception& error) {
    return refused(error.what());
  }
}

}  // namespace

Outcome<DracoFigures> dracoTriangles(const PolygonMesh& mesh, const PackOptions& options, const DracoRun& run) {
  return runDraco(mesh, options, run, false);
}

Outcome<DracoFigures> dracoPolygons(const PolygonMesh& mesh, const PackOptions& options, const DracoRun& run) {
  return runDraco(mesh, options, run, true);
}

}  // namespace tutte
