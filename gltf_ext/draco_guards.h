#pragma once
// Draco's decoding steps with the range checks that hostile bytes need: whatever the stream says, decoded numbers stay
// within [0, max], so that Draco's arithmetic on them cannot overflow. Private to the Draco files.

#include <draco/compression/attributes/prediction_schemes/mesh_prediction_scheme_tex_coords_portable_decoder.h>
#include <draco/compression/attributes/prediction_schemes/prediction_scheme_normal_octahedron_canonicalized_decoding_transform.h>
#include <draco/compression/attributes/prediction_schemes/prediction_scheme_wrap_decoding_transform.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace tutte {

/// Draco's wrap transform; its bounds must lie within [0, max].
class GuardedWrap : public draco::PredictionSchemeWrapDecodingTransform<int32_t> {
 public:
  explicit GuardedWrap(int32_t max = 0) : max_(max) {}

  bool DecodeTransformData(draco::DecoderBuffer* buffer) {
    return PredictionSchemeWrapDecodingTransform::DecodeTransformData(buffer) && min_value() >= 0 &&
           max_value() <= max_;
  }

  void ComputeOriginalValue(const int32_t* predicted, const int32_t* correction, int32_t* out) const {
    PredictionSchemeWrapDecodingTransform::ComputeOriginalValue(predicted, correction, out);
    for (int i = 0; i < num_components(); ++i) out[i] = std::clamp(out[i], min_value(), max_value());
  }

 private:
  int32_t max_;
};

/// Draco's octahedral transform; the stream's grid must be the expected one.
class GuardedOctahedron : public draco::PredictionSchemeNormalOctahedronCanonicalizedDecodingTransform<int32_t> {
 public:
  explicit GuardedOctahedron(int32_t max = 0) : max_(max) {}

  bool DecodeTransformData(draco::DecoderBuffer* buffer) {
    return PredictionSchemeNormalOctahedronCanonicalizedDecodingTransform::DecodeTransformData(buffer) &&
           max_quantized_value() == max_ + 1;
  }

  void ComputeOriginalValue(const int32_t* predicted, const int32_t* correction, int32_t* out) const {
    const std::array<int32_t, 2> legal_prediction{std::clamp(predicted[0], 0, max_), std::clamp(predicted[1], 0, max_)};
    const std::array<int32_t, 2> legal{std::clamp(correction[0], 0, max_), std::clamp(correction[1], 0, max_)};
    PredictionSchemeNormalOctahedronCanonicalizedDecodingTransform::ComputeOriginalValue(legal_prediction.data(),
                                                                                         legal.data(), out);
  }

 private:
  int32_t max_;
};

/// Draco's texture coordinate prediction; there is at most one orientation per value.
template <class MeshData>
class GuardedTexcoords : public draco::MeshPredictionSchemeTexCoordsPortableDecoder<int32_t, GuardedWrap, MeshData> {
  using Base = draco::MeshPredictionSchemeTexCoordsPortableDecoder<int32_t, GuardedWrap, MeshData>;

 public:
  using Base::Base;

  bool DecodePredictionData(draco::DecoderBuffer* buffer) override {
    int32_t orientations = 0;
    if (!buffer->Peek(&orientations) || orientations < 0) return false;
    if (static_cast<size_t>(orientations) > this->mesh_data().data_to_corner_map()->size()) return false;
    return Base::DecodePredictionData(buffer);
  }
};

}  // namespace tutte
