#include "tools/bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "codec/decode.h"
#include "codec/payload.h"
#include "gltf_ext/triangulate.h"
#include "tools/draco_baseline.h"
#include "tools/paper_rates.h"

namespace tutte {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Runs `step` (which returns whether it worked) until the time is up, ten times at most; the best time, or nothing.
template <class Step>
std::optional<double> bestTime(double seconds, Step step) {
  double best = INFINITY;
  const Clock::time_point begin = Clock::now();
  for (int run = 0; run < 10 && (run == 0 || secondsSince(begin) < seconds); ++run) {
    const Clock::time_point start = Clock::now();
    if (!step()) return {};
    best = std::min(best, secondsSince(start));
  }
  return best;
}

CoderFigures figuresOf(const DracoFigures& draco) {
  return {draco.connectivity_bytes,
          draco.attribute_bytes,
          draco.total_bytes,
          draco.encode_seconds,
          draco.connectivity_encode_seconds,
          draco.decode_seconds,
          draco.connectivity_decode_seconds};
}

void addTo(std::optional<CoderFigures>& sum, const std::optional<CoderFigures>& more) {
  if (sum && more)
    *sum += *more;
  else
    sum.reset();
}

class MeshBench {
 public:
  MeshBench(const PolygonMesh& mesh, const PackOptions& options, double seconds)
      : mesh_(mesh), triangulated_(mesh), options_(options), seconds_(seconds) {
    triangulate(triangulated_);
  }

  Outcome<BenchFigures> run() {
    BenchFigures figures;
    if (const Outcome<Done> done = measureOurs(figures); !done) return done.error();
    figures.draco_cl7 = draco(figures, dracoTriangles, 7);
    figures.draco_cl10 = draco(figures, dracoTriangles, 10);
    figures.draco_polygons = draco(figures, dracoPolygons, 10);
    return figures;
  }

 private:
  Outcome<Done> measureOurs(BenchFigures& figures) {
    Packed packed;
    Failure failure;
    double connectivity = INFINITY;
    const auto encode_time = bestTime(seconds_, [&] {
      Outcome<Packed> outcome = pack(mesh_, options_);
      if (!outcome) return failure = outcome.error(), false;
      packed = *std::move(outcome);
      connectivity = std::min(connectivity, packed.connectivity_encode_seconds);
      return true;
    });
    if (!encode_time) return failure;
    const auto decode_time = bestTime(seconds_, [&] {
      const Outcome<PolygonMesh> outcome = unpack(packed.bytes);
      return outcome ? true : (failure = outcome.error(), false);
    });
    if (!decode_time) return failure;
    const Result<PayloadView> view = parsePayload(packed.bytes);
    const auto connectivity_time = bestTime(seconds_, [&] { return decode((*view)[Section::kConnectivity]).ok(); });
    figures.vertices = mesh_.polygons.vertex_count;
    figures.wedges = mesh_.wedge_count;
    figures.faces = mesh_.polygons.face_degrees.size();
    figures.splits = packed.splits;
    figures.valence_bytes = packed.valence_bytes;
    figures.degree_bytes = packed.degree_bytes;
    figures.seam_bytes = packed.seam_bytes;
    figures.ours = {packed.connectivity_bytes,
                    packed.attribute_bytes,
                    packed.bytes.size(),
                    *encode_time,
                    connectivity,
                    *decode_time,
                    connectivity_time.value_or(0)};
    return Done{};
  }

  template <class Coder>
  std::optional<CoderFigures> draco(BenchFigures& figures, Coder coder, int level) const {
    const double guess = std::max(1e-6, figures.ours.encode_seconds);
    const DracoRun run{level, static_cast<int>(std::clamp(seconds_ / guess, 1.0, 10.0))};
    const Outcome<DracoFigures> outcome = coder(triangulated_, options_, run);
    if (outcome) return figuresOf(*outcome);
    figures.draco_refusal = outcome.error().what;
    return {};
  }

  const PolygonMesh& mesh_;
  PolygonMesh triangulated_;  ///< for Draco, which knows no polygons
  const PackOptions& options_;
  double seconds_;
};

void addPaper(BenchFigures& figures, const Scene& scene) {
  if (scene.meshes.size() != 1) return;
  const Polygons& polygons = scene.meshes[0].mesh.polygons;
  const bool all_triangles =
      std::all_of(polygons.face_degrees.begin(), polygons.face_degrees.end(), [](Index degree) { return degree == 3; });
  const std::string stem = std::filesystem::path(figures.file).stem().string();
  const auto rate = paperBitsPerVertex(stem, polygons.vertex_count, all_triangles);
  if (!rate) return;
  figures.paper_bytes = static_cast<uint64_t>(std::lround(*rate * polygons.vertex_count / 8));
  figures.paper_counterpart = figures.ours.connectivity_bytes;
}

}  // namespace

CoderFigures& CoderFigures::operator+=(const CoderFigures& other) {
  connectivity_bytes += other.connectivity_bytes;
  attribute_bytes += other.attribute_bytes;
  total_bytes += other.total_bytes;
  encode_seconds += other.encode_seconds;
  connectivity_encode_seconds += other.connectivity_encode_seconds;
  decode_seconds += other.decode_seconds;
  connectivity_decode_seconds += other.connectivity_decode_seconds;
  return *this;
}

double BenchFigures::bitsPerVertex() const {
  return vertices == 0 ? 0 : 8.0 * static_cast<double>(ours.connectivity_bytes) / static_cast<double>(vertices);
}

BenchFigures& BenchFigures::operator+=(const BenchFigures& other) {
  vertices += other.vertices;
  wedges += other.wedges;
  faces += other.faces;
  splits += other.splits;
  valence_bytes += other.valence_bytes;
  degree_bytes += other.degree_bytes;
  seam_bytes += other.seam_bytes;
  ours += other.ours;
  addTo(draco_cl7, other.draco_cl7);
  addTo(draco_cl10, other.draco_cl10);
  addTo(draco_polygons, other.draco_polygons);
  if (draco_refusal.empty()) draco_refusal = other.draco_refusal;
  if (other.paper_bytes) paper_bytes = paper_bytes.value_or(0) + *other.paper_bytes;
  paper_counterpart += other.paper_counterpart;
  glb_bytes += other.glb_bytes;
  return *this;
}

Outcome<BenchFigures> measure(const std::string& file, Scene scene, const PackOptions& options,
                              const std::set<std::string>& attributes, double seconds) {
  BenchFigures figures;
  figures.file = file;
  figures.draco_cl7 = figures.draco_cl10 = figures.draco_polygons = CoderFigures{};
  for (SceneMesh& mesh : scene.meshes) {
    if (mesh.mesh.polygons.face_degrees.empty()) continue;
    if (!attributes.empty()) {
      std::erase_if(mesh.mesh.attributes, [&](const Attribute& attribute) {
        return attribute.name != "POSITION" && !attributes.count(attribute.name);
      });
    }
    const Outcome<BenchFigures> one = MeshBench(mesh.mesh, options, seconds).run();
    if (!one) return one.error();
    figures += *one;
  }
  addPaper(figures, scene);
  const Outcome<Compressed> compressed = sceneToAsset(scene, {.pack = options, .attributes = {}});
  if (!compressed) return compressed.error();
  const Outcome<Bytes> glb = toGlb(compressed->asset);
  if (!glb) return glb.error();
  figures.glb_bytes = glb->size();
  return figures;
}

}  // namespace tutte
