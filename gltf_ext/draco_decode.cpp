#include <draco/compression/attributes/attributes_decoder_interface.h>
#include <draco/compression/attributes/prediction_schemes/mesh_prediction_scheme_constrained_multi_parallelogram_decoder.h>
#include <draco/compression/attributes/prediction_schemes/mesh_prediction_scheme_geometric_normal_decoder.h>
#include <draco/compression/attributes/prediction_schemes/prediction_scheme_delta_decoder.h>
#include <draco/compression/attributes/sequential_integer_attribute_decoder.h>
#include <draco/compression/mesh/mesh_decoder.h>

#include <algorithm>

#include "gltf_ext/draco_guards.h"
#include "gltf_ext/draco_planes.h"
#include "gltf_ext/draco_session.h"
#include "gltf_ext/guard.h"

namespace tutte {
namespace {

using IntScheme = draco::PredictionSchemeTypedDecoderInterface<int32_t>;
using Method = draco::PredictionSchemeMethod;

/// A prediction scheme of a plane over either kind of corner table; null for methods that do not belong there.
template <class Table>
std::unique_ptr<IntScheme> schemeOver(const Table& table, const Plane& plane, Method method, bool has_parent,
                                      const draco::MeshAttributeIndicesEncodingData& data, const draco::Mesh* mesh,
                                      const draco::PointAttribute* attribute) {
  using Data = draco::MeshPredictionSchemeData<Table>;
  Data md;
  md.Set(mesh, &table, &data.encoded_attribute_value_index_to_corner_map,
         &data.vertex_to_encoded_attribute_value_index_map);
  if (plane.kind == PlaneKind::kNormal && method == draco::MESH_PREDICTION_GEOMETRIC_NORMAL && has_parent) {
    using Scheme = draco::MeshPredictionSchemeGeometricNormalDecoder<int32_t, GuardedOctahedron, Data>;
    return std::make_unique<Scheme>(attribute, GuardedOctahedron(plane.max), md);
  }
  if (plane.octahedral()) return nullptr;
  const GuardedWrap wrap(plane.max);
  if (method == draco::MESH_PREDICTION_CONSTRAINED_MULTI_PARALLELOGRAM) {
    using Scheme = draco::MeshPredictionSchemeConstrainedMultiParallelogramDecoder<int32_t, GuardedWrap, Data>;
    return std::make_unique<Scheme>(attribute, wrap, md);
  }
  if (plane.kind == PlaneKind::kTexcoord && method == draco::MESH_PREDICTION_TEX_COORDS_PORTABLE && has_parent) {
    return std::make_unique<GuardedTexcoords<Data>>(attribute, wrap, md);
  }
  return nullptr;
}

std::unique_ptr<IntScheme> deltaScheme(const Plane& plane, const draco::PointAttribute* attribute) {
  if (plane.octahedral()) {
    using Scheme = draco::PredictionSchemeDeltaDecoder<int32_t, GuardedOctahedron>;
    return std::make_unique<Scheme>(attribute, GuardedOctahedron(plane.max));
  }
  using Scheme = draco::PredictionSchemeDeltaDecoder<int32_t, GuardedWrap>;
  return std::make_unique<Scheme>(attribute, GuardedWrap(plane.max));
}

draco::PredictionSchemeTransformType transformOf(const Plane& plane) {
  return plane.octahedral() ? draco::PREDICTION_TRANSFORM_NORMAL_OCTAHEDRON_CANONICALIZED
                            : draco::PREDICTION_TRANSFORM_WRAP;
}

/// One plane's numbers.
class PlaneDecoder : public draco::SequentialIntegerAttributeDecoder {
 public:
  PlaneDecoder(const DracoSession& session, const draco::Mesh* mesh) : session_(session), mesh_(mesh) {}

  /// The number of each value, components together; null before they are decoded.
  const int32_t* numbers() { return GetPortableAttributeData(); }

  /// After decoding: lets predictors of other planes find positions.
  void becomeParent() { session_.mapWedges(*portable_attribute()); }

  /// True when the stream named a prediction that does not belong here.
  bool refused() const { return refused_; }

 protected:
  std::unique_ptr<IntScheme> CreateIntPredictionScheme(Method method,
                                                       draco::PredictionSchemeTransformType transform) override {
    auto scheme = transform == transformOf(session_.plane(attribute_id())) ? create(method) : nullptr;
    refused_ = scheme == nullptr;
    return scheme;
  }

 private:
  std::unique_ptr<IntScheme> create(Method method) {
    const Plane& plane = session_.plane(attribute_id());
    if (method == draco::PREDICTION_DIFFERENCE) return deltaScheme(plane, attribute());
    const ValueLayout& layout = session_.layout(attribute_id());
    const bool parent = session_.hasParent();
    if (!layout.seams)
      return schemeOver(session_.triangles().table, plane, method, parent, layout.data, mesh_, attribute());
    return schemeOver(*layout.seams, plane, method, parent, layout.data, mesh_, attribute());
  }

  const DracoSession& session_;
  const draco::Mesh* mesh_;
  bool refused_ = false;
};

/// All planes, one after the other; their values go to `out`.
class PlanesDecoder : public draco::AttributesDecoderInterface {
 public:
  PlanesDecoder(const DracoSession& session, std::span<Plane> out) : session_(session), out_(out) {}

  bool Init(draco::PointCloudDecoder* decoder, draco::PointCloud* mesh) override {
    decoder_ = decoder;
    mesh_ = static_cast<draco::Mesh*>(mesh);
    return true;
  }
  bool DecodeAttributesDecoderData(draco::DecoderBuffer*) override { return true; }
  int32_t GetAttributeId(int i) const override { return i; }
  int32_t GetNumAttributes() const override { return session_.planeCount(); }
  draco::PointCloudDecoder* GetDecoder() const override { return decoder_; }

  const draco::PointAttribute* GetPortableAttribute(int32_t id) override {
    return id == 0 && parent_ ? parent_->GetPortableAttribute() : nullptr;
  }

  bool DecodeAttributes(draco::DecoderBuffer* buffer) override {
    for (int id = 0; id < session_.planeCount(); ++id) {
      if (!decodePlane(id, buffer)) return false;
    }
    return buffer->remaining_size() == 0;
  }

 private:
  bool decodePlane(int id, draco::DecoderBuffer* buffer) {
    const ValueLayout& layout = session_.layout(id);
    auto coder = std::make_unique<PlaneDecoder>(session_, mesh_);
    const int64_t before = buffer->remaining_size();
    if (!coder->Init(decoder_, id) || !coder->DecodePortableAttribute(layout.points, buffer)) return false;
    out_[id].coded_bytes = static_cast<uint32_t>(before - buffer->remaining_size());
    if (coder->refused() || coder->numbers() == nullptr || !takeValues(id, coder->numbers())) return false;
    if (session_.plane(id).kind != PlaneKind::kPosition) return true;
    coder->becomeParent();
    parent_ = std::move(coder);
    return true;
  }

  bool takeValues(int id, const int32_t* numbers) {
    Plane& plane = out_[id];
    const size_t components = plane.components, count = session_.layout(id).valueCount() * components;
    if (std::any_of(numbers, numbers + count, [&](int32_t n) { return n < 0 || n > plane.max; })) return false;
    const auto& wedges = session_.triangles().wedges;
    plane.values.assign(size_t{mesh_->num_points()} * components, 0);
    for (Index corner = 0; corner < wedges.size(); ++corner) {
      const int value = session_.valueAt(id, corner);
      if (value < 0) return false;
      std::copy_n(numbers + value * components, components, &plane.values[wedges[corner] * components]);
    }
    return true;
  }

  const DracoSession& session_;
  std::span<Plane> out_;
  draco::PointCloudDecoder* decoder_ = nullptr;
  draco::Mesh* mesh_ = nullptr;
  std::unique_ptr<PlaneDecoder> parent_;
};

/// Draco's decoder with a connectivity that is known already.
class KnownMeshDecoder : public draco::MeshDecoder {
 public:
  KnownMeshDecoder(const DracoSession& session, std::span<Plane> out) : session_(session), out_(out) {}

 protected:
  bool DecodeConnectivity() override { return true; }
  bool CreateAttributesDecoder(int32_t id) override {
    return id == 0 && SetAttributesDecoder(0, std::make_unique<PlanesDecoder>(session_, out_));
  }

 private:
  const DracoSession& session_;
  std::span<Plane> out_;
};

bool decodeOrThrow(const AttributeTopology& topology, std::span<const uint8_t> bytes, std::span<Plane> planes) {
  const auto triangles = buildTriangleTable(topology);
  if (!triangles) return false;
  DracoSession session(topology, *triangles, planes);
  draco::Mesh mesh;
  if (!session.prepare(mesh)) return false;
  std::vector<uint8_t> stream(std::begin(kDracoHeader), std::end(kDracoHeader));
  stream.insert(stream.end(), bytes.begin(), bytes.end());
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  KnownMeshDecoder decoder(session, planes);
  const draco::DecoderOptions options;
  return decoder.Decode(options, &buffer, &mesh).ok();
}

}  // namespace

bool hasDraco() { return true; }

bool decodePlanes(const AttributeTopology& topology, std::span<const uint8_t> bytes, std::span<Plane> planes) {
  if (planes.empty() || topology.wedge_count == 0) return bytes.empty();
  return caught([&] { return decodeOrThrow(topology, bytes, planes); },
                [](const Thrown&) { return false; });  // out of memory, or a size that is refused
}

}  // namespace tutte
