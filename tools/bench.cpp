#include "tools/bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "codec/decode.h"
#include "codec/payload.h"
#include "codec/spending.h"
#include "codec/triangulation.h"
#include "gltf_ext/compress.h"
#include "gltf_ext/triangulate.h"
#include "gltf_ext/welding.h"
#include "tools/cpu_clock.h"
#include "tools/draco_baseline.h"
#include "tools/heap_meter.h"
#include "tools/paper_rates.h"
#include "tools/payloads.h"

namespace tutte {
namespace {

// What a payload tells the connectivity's decoder before it begins.
Limits sizeOf(const Polygons& polygons) {
  return {polygons.vertex_count, static_cast<Index>(polygons.face_degrees.size()),
          static_cast<Index>(polygons.corners.size())};
}

constexpr int kMostRounds = 10;

/// What `step` returns, and the least time that it took so far. A time of 0: none yet.
template <class Step>
auto timed(double& best, Step step) {
  const CpuClock::time_point start = CpuClock::now();
  auto result = step();
  const double seconds = CpuClock::secondsSince(start);
  best = best == 0 ? seconds : std::min(best, seconds);
  return result;
}

/// What the valences and the degrees take of a connectivity section; never more than all of it.
SymbolBytes symbolBytesOf(std::span<const uint8_t> section) {
  const Result<Spending> spending = spendingOf(section);
  if (!spending) return {};
  const auto bytesOf = [&](Topic symbols, Topic with, size_t most) {
    const double bits = (*spending)[symbols].bits + (*spending)[with].bits;
    return std::min<uint64_t>(static_cast<uint64_t>(bits / 8), most);
  };
  const uint64_t valences = bytesOf(Topic::kValences, Topic::kSplits, section.size());
  return {valences, bytesOf(Topic::kDegrees, Topic::kHoles, section.size() - valences)};
}

/// One mesh through our whole codec, again and again.
class OurCoder {
 public:
  OurCoder(const PolygonMesh& mesh, const PackOptions& options) : mesh_(mesh), options_(options) {}

  Outcome<Done> run() {
    Outcome<Packed> packed = timed(figures_.encode_seconds, [&] { return pack(mesh_, options_); });
    if (!packed) return packed.error();
    packed_ = *std::move(packed);
    const bool welded = peekCounts(packed_.bytes)->welded > 0;
    const Polygons& polygons = welded ? *welded_polygons_ : mesh_.polygons;
    const auto encoded =
        timed(figures_.connectivity_encode_seconds, [&] { return encode(polygons, options_.connectivity); });
    if (!encoded) return failureOf(encoded.error(), "connectivity");
    const HeapMeter meter;
    const auto unpacked = timed(figures_.decode_seconds, [&] { return unpack(packed_.bytes); });
    if (!unpacked) return unpacked.error();
    figures_.decode_peak_bytes = meter.peakBytes();
    const Result<PayloadView> view = parsePayload(packed_.bytes);
    const auto section = (*view)[Section::kConnectivity];
    const auto decoded = timed(figures_.connectivity_decode_seconds, [&] { return decode(section, sizeOf(polygons)); });
    if (!decoded) return failureOf(decoded.error(), "connectivity");
    return Done{};
  }

  Outcome<Done> report(BenchFigures& figures) {
    figures.vertices = mesh_.polygons.vertex_count;
    figures.wedges = mesh_.wedge_count;
    figures.faces = mesh_.polygons.face_degrees.size();
    figures.splits = packed_.splits;
    figures.symbols = symbolBytesOf((*parsePayload(packed_.bytes))[Section::kConnectivity]);
    figures_.connectivity_bytes = packed_.connectivity_bytes;
    figures_.seam_bytes = packed_.seam_bytes;
    figures_.attribute_bytes = packed_.attribute_bytes;
    figures_.total_bytes = packed_.bytes.size();
    const Outcome<std::vector<AttributeSize>> sizes = attributeSizesOf(*parsePayload(packed_.bytes));
    if (!sizes) return sizes.error();
    for (const AttributeSize& size : *sizes) figures_.by_attribute[size.name] += size.bytes();
    figures.ours = figures_;
    return Done{};
  }

 private:
  const PolygonMesh& mesh_;
  const std::optional<Polygons> welded_polygons_ = weldedPolygons(mesh_);
  const PackOptions& options_;
  Packed packed_;
  CoderFigures figures_;
};

/// Its connectivity alone with one profile.
Outcome<Done> runProfile(const PolygonMesh& mesh, EncodeOptions options, Profile profile, ProfileFigures& figures) {
  options.profile = profile;
  const Result<Encoded> encoded = timed(figures.encode_seconds, [&] { return encode(mesh.polygons, options); });
  if (!encoded) return failureOf(encoded.error(), "connectivity");
  const auto decoded = timed(figures.decode_seconds, [&] { return decode(encoded->bytes, sizeOf(mesh.polygons)); });
  if (!decoded) return failureOf(decoded.error(), "connectivity");
  if (figures.connectivity_bytes == 0) figures.symbols = symbolBytesOf(encoded->bytes);
  figures.connectivity_bytes = encoded->bytes.size();
  return Done{};
}

/// Draco in one of its ways.
struct DracoCoder {
  DracoBaseline baseline;
  std::optional<CoderFigures> BenchFigures::*place;
};

CoderFigures figuresOf(const DracoFigures& draco) {
  CoderFigures figures;
  figures.connectivity_bytes = draco.connectivity_bytes;
  figures.seam_bytes = draco.seam_bytes;
  figures.attribute_bytes = draco.attribute_bytes;
  for (const auto& [name, bytes] : draco.by_attribute) figures.by_attribute[name] += bytes;
  figures.total_bytes = draco.total_bytes;
  figures.encode_seconds = draco.encode_seconds;
  figures.connectivity_encode_seconds = draco.connectivity_encode_seconds;
  figures.decode_seconds = draco.decode_seconds;
  figures.connectivity_decode_seconds = draco.connectivity_decode_seconds;
  figures.decode_peak_bytes = draco.decode_peak_bytes;
  return figures;
}

std::vector<DracoCoder> dracoCoders(const PolygonMesh& mesh, const PackOptions& options) {
  std::vector<DracoCoder> coders;
  coders.push_back({{mesh, options, DracoInput::kTriangles, 7}, &BenchFigures::draco_cl7});
  coders.push_back({{mesh, options, DracoInput::kTriangles, 10}, &BenchFigures::draco_cl10});
  coders.push_back({{mesh, options, DracoInput::kPolygons, 10}, &BenchFigures::draco_polygons});
  coders.push_back({{mesh, options, DracoInput::kConnectivity, 10}, &BenchFigures::draco_connectivity});
  return coders;
}

Outcome<BenchFigures> measureMesh(const PolygonMesh& mesh, const BenchPlan& plan) {
  PolygonMesh triangulated = mesh;  // for Draco, which knows no polygons
  triangulate(triangulated);
  BenchFigures figures;
  OurCoder ours(mesh, plan.options);
  std::vector<DracoCoder> dracos = dracoCoders(triangulated, plan.options);
  const double seconds = plan.seconds * static_cast<double>(1 + dracos.size());
  const CpuClock::time_point begin = CpuClock::now();
  for (int round = 0; round < kMostRounds && (round == 0 || CpuClock::secondsSince(begin) < seconds); ++round) {
    if (const Outcome<Done> done = ours.run(); !done) return done.error();
    for (const Profile profile : plan.profiles) {
      ProfileFigures& kept = figures.profiles[profile];
      if (const auto done = runProfile(mesh, plan.options.connectivity, profile, kept); !done) return done.error();
    }
    for (DracoCoder& draco : dracos) {
      if (const Outcome<Done> done = draco.baseline.run(); !done) figures.draco_refusal = done.error().what;
    }
  }
  if (const Outcome<Done> done = ours.report(figures); !done) return done.error();
  for (DracoCoder& draco : dracos) {
    if (!draco.baseline.refused()) figures.*draco.place = figuresOf(draco.baseline.figures());
  }
  return figures;
}

void addPaper(BenchFigures& figures, const Scene& scene) {
  if (scene.meshes.size() != 1) return;
  const Polygons& polygons = scene.meshes[0].mesh.polygons;
  const std::string stem = std::filesystem::path(figures.file).stem().string();
  const auto rate = paperBitsPerVertex(stem, polygons.vertex_count, onlyTriangles(polygons.face_degrees));
  if (!rate) return;
  figures.paper_bytes = static_cast<uint64_t>(std::lround(*rate * polygons.vertex_count / 8));
  figures.paper_counterpart = figures.ours.connectivity_bytes;
}

}  // namespace

Outcome<BenchFigures> measure(const std::string& file, Scene scene, const BenchPlan& plan) {
  BenchFigures figures = emptySum(file);
  for (SceneMesh& mesh : scene.meshes) {
    if (mesh.mesh.polygons.face_degrees.empty()) continue;
    keepAttributes(mesh.mesh, plan.attributes);
    const Outcome<BenchFigures> one = measureMesh(mesh.mesh, plan);
    if (!one) return one.error();
    figures += *one;
  }
  addPaper(figures, scene);
  const Outcome<Compressed> compressed = sceneToAsset(scene, {.pack = plan.options, .attributes = {}});
  if (!compressed) return compressed.error();
  const Outcome<Bytes> glb = toGlb(compressed->asset);
  if (!glb) return glb.error();
  figures.glb_bytes = glb->size();
  return figures;
}

}  // namespace tutte
