#include "tools/lossless_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "gltf_ext/triangulate.h"
#include "tools/command.h"
#include "tools/meshopt_baseline.h"

namespace tutte {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostRounds = 10;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Outcome<LosslessFigures> measureMesh(const PolygonMesh& mesh, const PackOptions& options, double seconds) {
  LosslessFigures figures;
  figures.encode_seconds = figures.decode_seconds = INFINITY;
  const Clock::time_point begin = Clock::now();
  for (int round = 0; round < kMostRounds && (round == 0 || secondsSince(begin) < seconds); ++round) {
    const Clock::time_point start = Clock::now();
    const Outcome<Packed> packed = pack(mesh, options);
    if (!packed) return packed.error();
    figures.encode_seconds = std::min(figures.encode_seconds, secondsSince(start));
    const Clock::time_point middle = Clock::now();
    const Outcome<PolygonMesh> decoded = unpack(packed->bytes);
    if (!decoded) return decoded.error();
    figures.decode_seconds = std::min(figures.decode_seconds, secondsSince(middle));
    figures.connectivity_bytes = packed->connectivity_bytes;
    figures.seam_bytes = packed->seam_bytes;
    figures.value_bytes = packed->attribute_bytes - packed->seam_bytes;
    figures.total_bytes = packed->bytes.size();
  }
  figures.vertices = mesh.polygons.vertex_count;
  figures.faces = mesh.polygons.face_degrees.size();
  PolygonMesh triangulated = mesh;  // meshoptimizer knows no polygons
  triangulate(triangulated);
  const MeshoptFigures meshopt = meshoptLossless(triangulated);
  figures.raw_bytes = meshopt.raw_bytes;
  figures.meshopt_bytes = meshopt.compressed_bytes;
  return figures;
}

std::string ratioOf(const LosslessFigures& figures) {
  if (figures.meshopt_bytes == 0) return "-";
  return formatted("%.2f", static_cast<double>(figures.total_bytes) / static_cast<double>(figures.meshopt_bytes));
}

}  // namespace

LosslessFigures& LosslessFigures::operator+=(const LosslessFigures& other) {
  vertices += other.vertices;
  faces += other.faces;
  raw_bytes += other.raw_bytes;
  connectivity_bytes += other.connectivity_bytes;
  seam_bytes += other.seam_bytes;
  value_bytes += other.value_bytes;
  total_bytes += other.total_bytes;
  meshopt_bytes += other.meshopt_bytes;
  encode_seconds += other.encode_seconds;
  decode_seconds += other.decode_seconds;
  return *this;
}

Outcome<LosslessFigures> measureLossless(const std::string& file, const Scene& scene, const BenchPlan& plan) {
  LosslessFigures figures;
  for (const SceneMesh& mesh : scene.meshes) {
    if (mesh.mesh.polygons.face_degrees.empty()) continue;
    PolygonMesh kept = mesh.mesh;
    std::erase_if(kept.attributes, [&](const Attribute& attribute) {
      return !plan.attributes.empty() && attribute.name != "POSITION" && !plan.attributes.count(attribute.name);
    });
    const Outcome<LosslessFigures> one = measureMesh(kept, withoutLoss(plan.options), plan.seconds);
    if (!one) return one.error();
    figures += *one;
  }
  figures.file = file;
  return figures;
}

void printLosslessHead() {
  std::printf("%-28s %9s %9s %11s | %9s %8s %10s %10s | %10s %6s | %9s %9s\n", "without loss", "V", "F", "raw",
              "connect.", "seams", "values", "total", "meshopt+z", "ratio", "enc. ms", "dec. ms");
}

void printLossless(const LosslessFigures& f) {
  const auto name = std::filesystem::path(f.file).filename().string();
  std::printf("%-28.28s %9s %9s %11s | %9s %8s %10s %10s | %10s %6s | %9.2f %9.2f\n", name.c_str(),
              withCommas(f.vertices).c_str(), withCommas(f.faces).c_str(), withCommas(f.raw_bytes).c_str(),
              withCommas(f.connectivity_bytes).c_str(), withCommas(f.seam_bytes).c_str(),
              withCommas(f.value_bytes).c_str(), withCommas(f.total_bytes).c_str(),
              f.meshopt_bytes > 0 ? withCommas(f.meshopt_bytes).c_str() : "-", ratioOf(f).c_str(),
              1e3 * f.encode_seconds, 1e3 * f.decode_seconds);
}

void printLosslessJson(const LosslessFigures& f) {
  using Json = nlohmann::json;
  const Json line = {{"file", f.file},
                     {"vertices", f.vertices},
                     {"faces", f.faces},
                     {"raw_bytes", f.raw_bytes},
                     {"connectivity_bytes", f.connectivity_bytes},
                     {"seam_bytes", f.seam_bytes},
                     {"value_bytes", f.value_bytes},
                     {"total_bytes", f.total_bytes},
                     {"meshopt_zstd_bytes", f.meshopt_bytes > 0 ? Json(f.meshopt_bytes) : Json()},
                     {"encode_seconds", f.encode_seconds},
                     {"decode_seconds", f.decode_seconds}};
  std::printf("%s\n", line.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace tutte
