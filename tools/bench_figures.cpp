#include "tools/bench_figures.h"

#include <algorithm>

namespace tutte {
namespace {

void addTo(std::optional<CoderFigures>& sum, const std::optional<CoderFigures>& more) {
  if (sum && more)
    *sum += *more;
  else
    sum.reset();
}

}  // namespace

CoderFigures& CoderFigures::operator+=(const CoderFigures& other) {
  connectivity_bytes += other.connectivity_bytes;
  seam_bytes += other.seam_bytes;
  attribute_bytes += other.attribute_bytes;
  for (const auto& [name, bytes] : other.by_attribute) by_attribute[name] += bytes;
  total_bytes += other.total_bytes;
  encode_seconds += other.encode_seconds;
  connectivity_encode_seconds += other.connectivity_encode_seconds;
  decode_seconds += other.decode_seconds;
  connectivity_decode_seconds += other.connectivity_decode_seconds;
  decode_peak_bytes = std::max(decode_peak_bytes, other.decode_peak_bytes);
  return *this;
}

SymbolBytes& SymbolBytes::operator+=(const SymbolBytes& other) {
  valences += other.valences;
  degrees += other.degrees;
  return *this;
}

ProfileFigures& ProfileFigures::operator+=(const ProfileFigures& other) {
  symbols += other.symbols;
  connectivity_bytes += other.connectivity_bytes;
  encode_seconds += other.encode_seconds;
  decode_seconds += other.decode_seconds;
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
  symbols += other.symbols;
  ours += other.ours;
  for (const auto& [profile, figures] : other.profiles) profiles[profile] += figures;
  addTo(draco_cl7, other.draco_cl7);
  addTo(draco_cl10, other.draco_cl10);
  addTo(draco_polygons, other.draco_polygons);
  addTo(draco_connectivity, other.draco_connectivity);
  if (draco_refusal.empty()) draco_refusal = other.draco_refusal;
  if (other.paper_bytes) paper_bytes = paper_bytes.value_or(0) + *other.paper_bytes;
  paper_counterpart += other.paper_counterpart;
  glb_bytes += other.glb_bytes;
  return *this;
}

BenchFigures emptySum(const std::string& name) {
  BenchFigures sum;
  sum.file = name;
  sum.draco_cl7 = sum.draco_cl10 = sum.draco_polygons = sum.draco_connectivity = CoderFigures{};
  return sum;
}

}  // namespace tutte
