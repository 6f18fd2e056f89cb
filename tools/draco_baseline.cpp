#include "tools/draco_baseline.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_edgebreaker_encoder.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "tools/cpu_clock.h"
#include "tools/draco_input.h"
#include "tools/heap_meter.h"

namespace tutte {
namespace {

using Clock = CpuClock;

constexpr uint64_t kHeaderBytes = 11;

/// Draco's encoder with a watch on its connectivity step and on every attribute.
class WatchedEncoder : public draco::MeshEdgebreakerEncoder {
 public:
  uint64_t connectivityBytes() const { return bytes_; }
  double connectivitySeconds() const { return seconds_; }

  /// Attribute number and bytes, in the order of the buffer.
  const std::vector<std::pair<int, uint64_t>>& attributeBytes() const { return attribute_bytes_; }

 protected:
  draco::Status EncodeConnectivity() override {
    const Clock::time_point start = Clock::now();
    const size_t before = buffer()->size();
    draco::Status status = MeshEdgebreakerEncoder::EncodeConnectivity();
    bytes_ = buffer()->size() - before;
    seconds_ = Clock::secondsSince(start);
    return status;
  }

  /// As Draco does it where positions, which others depend on, come first. Each attribute has an encoder of its own.
  bool EncodeAllAttributes() override {
    for (int i = 0; i < num_attributes_encoders(); ++i) {
      const size_t before = buffer()->size();
      if (!attributes_encoder(i)->EncodeAttributes(buffer())) return false;
      attribute_bytes_.emplace_back(attributes_encoder(i)->GetAttributeId(0), buffer()->size() - before);
    }
    return true;
  }

 private:
  uint64_t bytes_ = 0;
  double seconds_ = 0;
  std::vector<std::pair<int, uint64_t>> attribute_bytes_;
};

/// The same for the decoder.
class WatchedDecoder : public draco::MeshEdgebreakerDecoder {
 public:
  double connectivitySeconds() const { return seconds_; }

 protected:
  bool DecodeConnectivity() override {
    const Clock::time_point start = Clock::now();
    const bool done = MeshEdgebreakerDecoder::DecodeConnectivity();
    seconds_ = Clock::secondsSince(start);
    return done;
  }

 private:
  double seconds_ = 0;
};

/// Vertices stay what they are, for the connectivity follows the numbers of the values.
void zeroPositions(draco::Mesh& mesh) {
  draco::DataBuffer& values = *mesh.attribute(0)->buffer();
  std::fill_n(values.data(), values.data_size(), uint8_t{0});
}

Failure refusal(const std::string& message) { return {FailureKind::kUnsupported, "Draco", message}; }

/// Keeps the lesser time, or the only one.
void best(double& kept, double seconds, bool first) { kept = first ? seconds : std::min(kept, seconds); }

}  // namespace

/// What does not change from run to run.
struct DracoBaseline::Input {
  DracoTriangles triangles;
  std::unique_ptr<draco::Mesh> mesh;
  draco::EncoderOptions options = draco::EncoderOptions::CreateDefaultOptions();
  draco::EncoderBuffer buffer;  ///< of the last run
};

DracoBaseline::DracoBaseline(const PolygonMesh& mesh, const PackOptions& options, DracoInput input, int level)
    : mesh_(mesh), options_(options), input_kind_(input), level_(level) {}

DracoBaseline::~DracoBaseline() = default;
DracoBaseline::DracoBaseline(DracoBaseline&&) noexcept = default;

Outcome<Done> DracoBaseline::run() {
  if (!failed_) return failed_;
  try {
    for (const auto step : {&DracoBaseline::prepare, &DracoBaseline::encode, &DracoBaseline::decode}) {
      if (failed_ = (this->*step)(); !failed_) return failed_;
    }
    ++runs_;
  } catch (const std::exception& error) {
    failed_ = refusal(error.what());
  }
  return failed_;
}

Outcome<Done> DracoBaseline::prepare() {
  if (input_) return Done{};
  input_ = std::make_unique<Input>();
  const bool polygons = input_kind_ == DracoInput::kPolygons;
  input_->triangles = polygons ? fanTriangles(mesh_.polygons) : givenTriangles(mesh_);
  if (input_->triangles.corners.empty()) return refusal("the mesh has no triangles");
  input_->options = dracoOptions(mesh_, options_, level_);
  if (polygons) {
    const int marks = static_cast<int>(mesh_.attributes.size());
    input_->options.SetAttributeInt(marks, "prediction_scheme", draco::PREDICTION_NONE);  // as draco_encoder does
  }
  const bool alone = input_kind_ == DracoInput::kConnectivity;
  input_->mesh = dracoMesh(mesh_, input_->triangles, alone ? 1 : mesh_.attributes.size(), polygons);
  if (!input_->mesh) return refusal("values could not be welded");
  if (alone) {
    zeroPositions(*input_->mesh);
    input_->options.SetAttributeInt(0, "prediction_scheme", draco::PREDICTION_NONE);
    input_->options.SetAttributeInt(0, "quantization_bits", 1);
  }
  return Done{};
}

Outcome<Done> DracoBaseline::encode() {
  WatchedEncoder encoder;
  encoder.SetMesh(*input_->mesh);
  draco::EncoderBuffer& buffer = input_->buffer;
  buffer.Clear();
  const Clock::time_point start = Clock::now();
  const draco::Status status = encoder.Encode(input_->options, &buffer);
  best(figures_.encode_seconds, Clock::secondsSince(start), runs_ == 0);
  best(figures_.connectivity_encode_seconds, encoder.connectivitySeconds(), runs_ == 0);
  if (!status.ok()) return refusal(status.error_msg_string());
  if (runs_ > 0) return Done{};
  figures_.total_bytes = buffer.size();
  figures_.connectivity_bytes = encoder.connectivityBytes();
  figures_.attribute_bytes = figures_.total_bytes - figures_.connectivity_bytes - kHeaderBytes;
  for (const auto& [id, bytes] : encoder.attributeBytes()) {
    const bool marks = static_cast<size_t>(id) >= mesh_.attributes.size();
    figures_.by_attribute.emplace_back(marks ? kAddedEdges : mesh_.attributes[id].name, bytes);
  }
  figures_.seam_bytes = seamBytes();
  return Done{};
}

/// What the connectivity step writes less where there is nothing but positions, over the same corner table.
uint64_t DracoBaseline::seamBytes() const {
  if (figures_.by_attribute.size() < 2) return 0;
  const std::unique_ptr<draco::Mesh> positions = dracoMesh(mesh_, input_->triangles, 1, false);
  if (!positions) return 0;
  WatchedEncoder encoder;
  encoder.SetMesh(*positions);
  draco::EncoderBuffer buffer;
  if (!encoder.Encode(dracoOptions(mesh_, options_, level_), &buffer).ok()) return 0;
  return figures_.connectivity_bytes - std::min(figures_.connectivity_bytes, encoder.connectivityBytes());
}

Outcome<Done> DracoBaseline::decode() {
  draco::DecoderBuffer buffer;
  buffer.Init(input_->buffer.data(), input_->buffer.size());
  WatchedDecoder decoder;
  const HeapMeter meter;
  draco::Mesh mesh;
  const draco::DecoderOptions options;
  const Clock::time_point start = Clock::now();
  const draco::Status status = decoder.Decode(options, &buffer, &mesh);
  best(figures_.decode_seconds, Clock::secondsSince(start), runs_ == 0);
  best(figures_.connectivity_decode_seconds, decoder.connectivitySeconds(), runs_ == 0);
  figures_.decode_peak_bytes = meter.peakBytes();
  if (!status.ok()) return refusal(status.error_msg_string());
  return Done{};
}

}  // namespace tutte
