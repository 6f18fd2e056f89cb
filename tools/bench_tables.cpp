#include "tools/bench_tables.h"

#include <cstdio>
#include <filesystem>
#include <set>

#include "tools/command.h"

namespace tutte {
namespace {

/// One measure of one coder; "-" where there is none.
template <class T>
std::string cell(const std::optional<CoderFigures>& figures, T CoderFigures::*member) {
  return figures ? withCommas(static_cast<uint64_t>((*figures).*member)) : "-";
}

std::string ratio(double one, double other) { return other > 0 ? formatted("%.2f", one / other) : "-"; }

std::string ratio(uint64_t one, uint64_t other) { return ratio(static_cast<double>(one), static_cast<double>(other)); }

std::string sizeRatio(const BenchFigures& figures, const std::optional<CoderFigures>& draco) {
  return draco ? ratio(figures.ours.total_bytes, draco->total_bytes) : "-";
}

/// How many times as fast as Draco: its time by ours.
std::string speed(double ours, const std::optional<CoderFigures>& draco, double CoderFigures::*member) {
  return draco ? ratio((*draco).*member, ours) : "-";
}

std::string nameOf(const BenchFigures& figures) { return std::filesystem::path(figures.file).filename().string(); }

/// Morph targets of one attribute are one line.
std::string lineOf(const std::string& attribute) {
  const size_t at = attribute.find('@');
  return at == std::string::npos ? attribute : attribute.substr(0, at) + ", targets";
}

std::map<std::string, uint64_t> linesOf(const CoderFigures& figures) {
  std::map<std::string, uint64_t> lines;
  for (const auto& [name, bytes] : figures.by_attribute) lines[lineOf(name)] += bytes;
  return lines;
}

void printAttributeLine(const std::string& name, uint64_t ours, const std::optional<uint64_t>& cl7,
                        const std::optional<uint64_t>& cl10) {
  const auto number = [](const std::optional<uint64_t>& bytes) { return bytes ? withCommas(*bytes) : "-"; };
  std::printf("%-28.28s %12s | %12s %6s | %12s %6s\n", name.c_str(), withCommas(ours).c_str(), number(cl7).c_str(),
              cl7 ? ratio(ours, *cl7).c_str() : "-", number(cl10).c_str(), cl10 ? ratio(ours, *cl10).c_str() : "-");
}

void printAttributes(const BenchFigures& sum) {
  if (!sum.draco_cl7 || !sum.draco_cl10) return;
  const CoderFigures &cl7 = *sum.draco_cl7, &cl10 = *sum.draco_cl10;
  std::printf("\n%-28s %12s | %12s %6s | %12s %6s\n", "bytes in sum by", "ours", "D7", "ratio", "D10", "ratio");
  printAttributeLine("connectivity, no seams", sum.ours.connectivity_bytes, cl7.connectivity_bytes - cl7.seam_bytes,
                     cl10.connectivity_bytes - cl10.seam_bytes);
  if (sum.ours.seam_bytes + cl7.seam_bytes + cl10.seam_bytes > 0) {
    printAttributeLine("seams", sum.ours.seam_bytes, cl7.seam_bytes, cl10.seam_bytes);
  }
  const auto ours = linesOf(sum.ours), fast = linesOf(cl7), small = linesOf(cl10);
  for (const auto& [name, bytes] : ours) {
    const auto in = [&](const std::map<std::string, uint64_t>& lines) {
      const auto found = lines.find(name);
      return found == lines.end() ? std::optional<uint64_t>() : found->second;
    };
    printAttributeLine(name, bytes, in(fast), in(small));
  }
}

const char* nameOf(Profile profile) {
  constexpr const char* kNames[] = {"paper", "fast", "default", "small"};
  return kNames[static_cast<size_t>(profile)];
}

void printProfileLine(const BenchFigures& f) {
  std::printf("%-28.28s", nameOf(f).c_str());
  for (const auto& [profile, figures] : f.profiles) {
    std::printf(" | %8s %6.3f %5s %5s %5s %5s", withCommas(figures.connectivity_bytes).c_str(),
                f.vertices == 0 ? 0 : 8.0 * static_cast<double>(figures.connectivity_bytes) / double(f.vertices),
                speed(figures.encode_seconds, f.draco_cl10, &CoderFigures::connectivity_encode_seconds).c_str(),
                speed(figures.decode_seconds, f.draco_cl10, &CoderFigures::connectivity_decode_seconds).c_str(),
                speed(figures.encode_seconds, f.draco_connectivity, &CoderFigures::encode_seconds).c_str(),
                speed(figures.decode_seconds, f.draco_connectivity, &CoderFigures::decode_seconds).c_str());
  }
  std::printf("\n");
}

void printProfiles(const std::vector<BenchFigures>& rows, const BenchFigures& sum) {
  if (rows.front().profiles.empty()) return;
  std::printf("\n%-28s", "connectivity by profile");
  for (const auto& [profile, figures] : rows.front().profiles) {
    std::printf(" | %8s %6s %5s %5s %5s %5s", nameOf(profile), "b/v", "enc", "dec", "enc*", "dec*");
  }
  std::printf("   (speeds; D10's connectivity step is 1; *: all that D10 does for connectivity alone)\n");
  for (const BenchFigures& row : rows) printProfileLine(row);
  if (rows.size() > 1) printProfileLine(sum);
}

void printSpeedLine(const BenchFigures& f) {
  std::printf("%-28.28s %9.2f %9.2f", nameOf(f).c_str(), 1e3 * f.ours.encode_seconds, 1e3 * f.ours.decode_seconds);
  for (const auto member : {&CoderFigures::encode_seconds, &CoderFigures::decode_seconds,
                            &CoderFigures::connectivity_encode_seconds, &CoderFigures::connectivity_decode_seconds}) {
    std::printf(" | %8s %8s", speed(f.ours.*member, f.draco_cl7, member).c_str(),
                speed(f.ours.*member, f.draco_cl10, member).c_str());
  }
  std::printf(" | %9s %9s\n", withCommas(f.ours.decode_peak_bytes / 1024).c_str(),
              f.draco_cl10 ? withCommas(f.draco_cl10->decode_peak_bytes / 1024).c_str() : "-");
}

void printSpeeds(const std::vector<BenchFigures>& rows, const BenchFigures& sum) {
  std::printf("\n%-28s %9s %9s", "speed (Draco's is 1)", "enc. ms", "dec. ms");
  for (const char* what : {"encode", "decode", "enc.conn", "dec.conn"}) std::printf(" | %8s %8s", what, "");
  std::printf("\n%-28s %9s %9s", "", "", "");
  for (int i = 0; i < 4; ++i) std::printf(" | %8s %8s", "by D7", "by D10");
  std::printf(" | %9s %9s\n", "dec. KiB", "D10 KiB");
  for (const BenchFigures& row : rows) printSpeedLine(row);
  if (rows.size() > 1) printSpeedLine(sum);
}

}  // namespace

void printSizeHead() {
  std::printf("%-28s %9s %9s %6s | %8s %8s %8s %8s %6s %8s | %9s %9s %9s | %9s %9s %5s | %9s %9s %5s | %9s %5s\n",
              "sizes", "V", "F", "splits", "valence", "degree", "other", "connect.", "b/v", "paper", "attrib.", "total",
              "GLB", "D7 conn.", "D7 total", "ratio", "D10 conn.", "D10 total", "ratio", "D polyg.", "ratio");
}

void printSizes(const BenchFigures& f) {
  std::printf("%-28.28s %9s %9s %6s | %8s %8s %8s %8s %6.3f %8s | %9s %9s %9s | %9s %9s %5s | %9s %9s %5s | %9s %5s\n",
              nameOf(f).c_str(), withCommas(f.vertices).c_str(), withCommas(f.faces).c_str(),
              withCommas(f.splits).c_str(), withCommas(f.symbols.valences).c_str(),
              withCommas(f.symbols.degrees).c_str(), withCommas(f.otherConnectivityBytes()).c_str(),
              withCommas(f.ours.connectivity_bytes).c_str(), f.bitsPerVertex(),
              f.paper_bytes ? withCommas(*f.paper_bytes).c_str() : "-", withCommas(f.ours.attribute_bytes).c_str(),
              withCommas(f.ours.total_bytes).c_str(), withCommas(f.glb_bytes).c_str(),
              cell(f.draco_cl7, &CoderFigures::connectivity_bytes).c_str(),
              cell(f.draco_cl7, &CoderFigures::total_bytes).c_str(), sizeRatio(f, f.draco_cl7).c_str(),
              cell(f.draco_cl10, &CoderFigures::connectivity_bytes).c_str(),
              cell(f.draco_cl10, &CoderFigures::total_bytes).c_str(), sizeRatio(f, f.draco_cl10).c_str(),
              cell(f.draco_polygons, &CoderFigures::total_bytes).c_str(), sizeRatio(f, f.draco_polygons).c_str());
}

void printSummary(const std::vector<BenchFigures>& rows) {
  if (rows.empty()) return;
  // Draco may refuse a mesh; then its sum would compare apples with pears, and the row is left out of it.
  BenchFigures sum = emptySum("sum");
  size_t refused = 0;
  for (const BenchFigures& row : rows) {
    if (row.draco_refusal.empty())
      sum += row;
    else
      ++refused;
  }
  printSizes(sum);
  if (sum.paper_bytes) {
    std::printf(
        "connectivity of the paper's models: %s bytes, in the paper %s (%s)\n",
        withCommas(sum.paper_counterpart).c_str(), withCommas(*sum.paper_bytes).c_str(),
        formatted("%.3f", static_cast<double>(sum.paper_counterpart) / static_cast<double>(*sum.paper_bytes)).c_str());
  }
  if (refused) std::printf("not in the sum, because Draco refuses them: %zu\n", refused);
  printAttributes(sum);
  printProfiles(rows, sum);
  printSpeeds(rows, sum);
}

}  // namespace tutte
