#include <draco/compression/attributes/prediction_schemes/prediction_scheme_encoder_factory.h>
#include <draco/compression/attributes/prediction_schemes/prediction_scheme_normal_octahedron_canonicalized_encoding_transform.h>
#include <draco/compression/attributes/prediction_schemes/prediction_scheme_wrap_encoding_transform.h>
#include <draco/compression/attributes/sequential_integer_attribute_encoder.h>
#include <draco/compression/mesh/mesh_encoder.h>

#include <algorithm>
#include <cstring>

#include "gltf_ext/draco_planes.h"
#include "gltf_ext/draco_session.h"
#include "gltf_ext/guard.h"

namespace tutte {
namespace {

using IntScheme = draco::PredictionSchemeTypedEncoderInterface<int32_t>;
using Method = draco::PredictionSchemeMethod;

// Below this many values the flags of the constrained scheme may cost more than they save.
constexpr size_t kFewValues = 40;

/// One plane's numbers with one prediction method.
class PlaneEncoder : public draco::SequentialIntegerAttributeEncoder {
 public:
  PlaneEncoder(const Plane& plane, Method method) : plane_(plane), method_(method) {}

  /// After coding: lets predictors of other planes find positions.
  void becomeParent(const DracoSession& session) { session.mapWedges(*portable_attribute()); }

 protected:
  std::unique_ptr<IntScheme> CreateIntPredictionScheme(Method) override {
    if (plane_.octahedral()) {
      using Transform = draco::PredictionSchemeNormalOctahedronCanonicalizedEncodingTransform<int32_t>;
      return draco::CreatePredictionSchemeForEncoder<int32_t, Transform>(method_, attribute_id(), encoder(),
                                                                         Transform(plane_.max + 1));
    }
    using Transform = draco::PredictionSchemeWrapEncodingTransform<int32_t>;
    return draco::CreatePredictionSchemeForEncoder<int32_t, Transform>(method_, attribute_id(), encoder());
  }

 private:
  const Plane& plane_;
  Method method_;
};

/// The methods worth trying for a plane; the shortest result wins. (Draco's single parallelogram is not among them:
/// Debian's package lacks the header of its decoder, and it wins on the smallest meshes only.)
std::vector<Method> methodsFor(const Plane& plane, size_t values, bool has_parent) {
  constexpr Method parallelograms = draco::MESH_PREDICTION_CONSTRAINED_MULTI_PARALLELOGRAM;
  constexpr Method difference = draco::PREDICTION_DIFFERENCE;
  switch (plane.kind) {
    case PlaneKind::kTexcoord:
      if (!has_parent) return {parallelograms};
      return {draco::MESH_PREDICTION_TEX_COORDS_PORTABLE, parallelograms};
    case PlaneKind::kNormal:
      if (!has_parent) return {difference};
      return {draco::MESH_PREDICTION_GEOMETRIC_NORMAL, difference};
    case PlaneKind::kDirection: return {difference};
    case PlaneKind::kLabel: return {difference, parallelograms, draco::PREDICTION_NONE};
    default: break;
  }
  if (values < kFewValues) return {parallelograms, difference};
  return {parallelograms};
}

/// All planes, one after the other: the only attribute encoder of our stream.
class PlanesEncoder : public draco::AttributesEncoder {
 public:
  explicit PlanesEncoder(const DracoSession& session) : session_(session) {
    for (int id = 0; id < session.planeCount(); ++id) AddAttributeId(id);
  }

  uint8_t GetUniqueId() const override { return 0; }
  bool EncodeAttributesEncoderData(draco::EncoderBuffer*) override { return true; }
  bool EncodePortableAttributes(draco::EncoderBuffer*) override { return true; }
  bool MarkParentAttribute(int32_t) override { return true; }  // see becomeParent()

  const draco::PointAttribute* GetPortableAttribute(int32_t id) override {
    return id == 0 && parent_ ? parent_->GetPortableAttribute() : nullptr;
  }

  bool EncodeAttributes(draco::EncoderBuffer* out) override {
    for (int id = 0; id < session_.planeCount(); ++id) {
      if (!codePlane(id, out)) return false;
    }
    return true;
  }

 private:
  bool codePlane(int id, draco::EncoderBuffer* out) {
    const Plane& plane = session_.plane(id);
    draco::EncoderBuffer best;
    for (const Method method : methodsFor(plane, session_.layout(id).valueCount(), session_.hasParent())) {
      auto coder = std::make_unique<PlaneEncoder>(plane, method);
      draco::EncoderBuffer buffer;
      if (!tryCode(id, *coder, &buffer)) return false;
      if (best.size() == 0 || buffer.size() < best.size()) std::swap(*best.buffer(), *buffer.buffer());
      if (plane.kind != PlaneKind::kPosition) continue;
      coder->becomeParent(session_);
      parent_ = std::move(coder);
    }
    return out->Encode(best.data(), best.size());
  }

  bool tryCode(int id, PlaneEncoder& coder, draco::EncoderBuffer* buffer) {
    const auto& points = session_.layout(id).points;
    return coder.Init(encoder(), id) && coder.TransformAttributeToPortableFormat(points) &&
           coder.EncodePortableAttribute(points, buffer);
  }

  const DracoSession& session_;
  std::unique_ptr<PlaneEncoder> parent_;
};

/// Draco's encoder with a connectivity that is known to the other side.
class KnownMeshEncoder : public draco::MeshEncoder {
 public:
  explicit KnownMeshEncoder(const DracoSession& session) : session_(session) {}

  uint8_t GetEncodingMethod() const override { return kDracoMethod; }
  const draco::CornerTable* GetCornerTable() const override { return &session_.triangles().table; }
  const draco::MeshAttributeCornerTable* GetAttributeCornerTable(int id) const override {
    return session_.layout(id).seams.get();
  }
  const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(int id) const override {
    return &session_.layout(id).data;
  }

 protected:
  draco::Status EncodeConnectivity() override { return draco::OkStatus(); }
  bool GenerateAttributesEncoder(int32_t id) override {
    if (id == 0) AddAttributesEncoder(std::make_unique<PlanesEncoder>(session_));
    return true;
  }
  void ComputeNumberOfEncodedPoints() override {}
  void ComputeNumberOfEncodedFaces() override {}

 private:
  const DracoSession& session_;
};

void copyValues(std::span<const Plane> planes, Index wedge_count, draco::Mesh& mesh) {
  for (size_t id = 0; id < planes.size(); ++id) {
    draco::PointAttribute* attribute = mesh.attribute(static_cast<int>(id));
    attribute->Reset(wedge_count);
    attribute->SetIdentityMapping();
    attribute->buffer()->Write(0, planes[id].values.data(), planes[id].values.size() * sizeof(int32_t));
  }
}

/// True when all corners that share a value agree on it.
bool agrees(const DracoSession& session, int id) {
  const Plane& plane = session.plane(id);
  const auto& wedges = session.triangles().wedges;
  const auto& points = session.layout(id).points;
  const int32_t* values = plane.values.data();
  for (Index corner = 0; corner < wedges.size(); ++corner) {
    const int value = session.valueAt(id, corner);
    if (value < 0) return false;
    const int32_t* own = values + size_t{wedges[corner]} * plane.components;
    const int32_t* coded = values + size_t{points[value].value()} * plane.components;
    if (!std::equal(own, own + plane.components, coded)) return false;
  }
  return true;
}

Failure failure(FailureKind kind, const char* what) { return {kind, "", what}; }

Outcome<std::vector<uint8_t>> runEncoder(const DracoSession& session, const draco::Mesh& mesh) {
  KnownMeshEncoder encoder(session);
  encoder.SetMesh(mesh);
  draco::EncoderOptions options = draco::EncoderOptions::CreateDefaultOptions();
  options.SetSpeed(0, 0);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.Encode(options, &buffer);
  if (!status.ok()) return failure(FailureKind::kUnsupported, status.error_msg());
  const size_t header = sizeof(kDracoHeader);
  if (buffer.size() < header || std::memcmp(buffer.data(), kDracoHeader, header) != 0) {
    return failure(FailureKind::kUnsupported, "this version of Draco writes another header; 1.5 is needed");
  }
  return std::vector<uint8_t>(buffer.data() + header, buffer.data() + buffer.size());
}

Outcome<std::vector<uint8_t>> encodeOrThrow(const AttributeTopology& topology, std::span<const Plane> planes) {
  const auto triangles = buildTriangleTable(topology);
  if (!triangles) return failure(FailureKind::kUnsupported, "the connectivity is too large or contradicts itself");
  DracoSession session(topology, *triangles, planes);
  draco::Mesh mesh;
  if (!session.prepare(mesh)) return failure(FailureKind::kInvalid, "an attribute's seams do not fit the connectivity");
  for (int id = 0; id < session.planeCount(); ++id) {
    if (!agrees(session, id)) {
      return failure(FailureKind::kInvalid, "an attribute has two values where its seams allow one");
    }
  }
  copyValues(planes, topology.wedge_count, mesh);
  return runEncoder(session, mesh);
}

}  // namespace

Outcome<std::vector<uint8_t>> encodePlanes(const AttributeTopology& topology, std::span<const Plane> planes) {
  if (planes.empty() || topology.wedge_count == 0) return std::vector<uint8_t>{};
  return caught([&] { return encodeOrThrow(topology, planes); },
                [](const Thrown& thrown) { return failure(FailureKind::kUnsupported, thrown.what); });
}

}  // namespace tutte
