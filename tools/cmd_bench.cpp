#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "tools/bench.h"
#include "tools/command.h"

namespace tutte {
namespace {

using Json = nlohmann::json;

Json jsonOf(const CoderFigures& figures) {
  return {{"connectivity_bytes", figures.connectivity_bytes},
          {"attribute_bytes", figures.attribute_bytes},
          {"total_bytes", figures.total_bytes},
          {"encode_seconds", figures.encode_seconds},
          {"connectivity_encode_seconds", figures.connectivity_encode_seconds},
          {"decode_seconds", figures.decode_seconds},
          {"connectivity_decode_seconds", figures.connectivity_decode_seconds}};
}

Json jsonOf(const std::optional<CoderFigures>& figures) { return figures ? jsonOf(*figures) : Json(); }

void printJson(const BenchFigures& figures) {
  Json line = jsonOf(figures.ours);
  line["file"] = figures.file;
  line["vertices"] = figures.vertices;
  line["wedges"] = figures.wedges;
  line["faces"] = figures.faces;
  line["splits"] = figures.splits;
  line["valence_bytes"] = figures.valence_bytes;
  line["degree_bytes"] = figures.degree_bytes;
  line["other_connectivity_bytes"] = figures.otherConnectivityBytes();
  line["seam_bytes"] = figures.seam_bytes;
  line["bits_per_vertex"] = figures.bitsPerVertex();
  line["glb_bytes"] = figures.glb_bytes;
  line["paper_bytes"] = figures.paper_bytes ? Json(*figures.paper_bytes) : Json();
  line["draco_cl7"] = jsonOf(figures.draco_cl7);
  line["draco_cl10"] = jsonOf(figures.draco_cl10);
  line["draco_polygons"] = jsonOf(figures.draco_polygons);
  line["draco_polygons_total_bytes"] = figures.draco_polygons ? Json(figures.draco_polygons->total_bytes) : Json();
  if (!figures.draco_refusal.empty()) line["draco_refusal"] = figures.draco_refusal;
  std::printf("%s\n", line.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

/// One measure of one coder; "-" where there is none.
template <class T>
std::string cell(const std::optional<CoderFigures>& figures, T CoderFigures::*member) {
  return figures ? withCommas(static_cast<uint64_t>((*figures).*member)) : "-";
}

std::string ratio(double ours, double other) { return other > 0 ? formatted("%.2f", ours / other) : "-"; }

std::string sizeRatio(const BenchFigures& figures, const std::optional<CoderFigures>& draco) {
  return draco ? ratio(static_cast<double>(figures.ours.total_bytes), static_cast<double>(draco->total_bytes)) : "-";
}

std::string timeRatio(double ours, const std::optional<CoderFigures>& draco, double CoderFigures::*member) {
  return draco ? ratio(ours, (*draco).*member) : "-";
}

void printSizeHead() {
  std::printf("%-28s %9s %9s %6s | %8s %8s %8s %8s %6s %8s | %9s %9s %9s | %9s %9s %5s | %9s %9s %5s | %9s %5s\n",
              "sizes", "V", "F", "splits", "valence", "degree", "other", "connect.", "b/v", "paper", "attrib.", "total",
              "GLB", "D7 conn.", "D7 total", "ratio", "D10 conn.", "D10 total", "ratio", "D polyg.", "ratio");
}

void printSizes(const BenchFigures& f) {
  const auto name = std::filesystem::path(f.file).filename().string();
  std::printf("%-28.28s %9s %9s %6s | %8s %8s %8s %8s %6.3f %8s | %9s %9s %9s | %9s %9s %5s | %9s %9s %5s | %9s %5s\n",
              name.c_str(), withCommas(f.vertices).c_str(), withCommas(f.faces).c_str(), withCommas(f.splits).c_str(),
              withCommas(f.valence_bytes).c_str(), withCommas(f.degree_bytes).c_str(),
              withCommas(f.otherConnectivityBytes()).c_str(), withCommas(f.ours.connectivity_bytes).c_str(),
              f.bitsPerVertex(), f.paper_bytes ? withCommas(*f.paper_bytes).c_str() : "-",
              withCommas(f.ours.attribute_bytes).c_str(), withCommas(f.ours.total_bytes).c_str(),
              withCommas(f.glb_bytes).c_str(), cell(f.draco_cl7, &CoderFigures::connectivity_bytes).c_str(),
              cell(f.draco_cl7, &CoderFigures::total_bytes).c_str(), sizeRatio(f, f.draco_cl7).c_str(),
              cell(f.draco_cl10, &CoderFigures::connectivity_bytes).c_str(),
              cell(f.draco_cl10, &CoderFigures::total_bytes).c_str(), sizeRatio(f, f.draco_cl10).c_str(),
              cell(f.draco_polygons, &CoderFigures::total_bytes).c_str(), sizeRatio(f, f.draco_polygons).c_str());
}

void printTimes(const BenchFigures& f) {
  const auto name = std::filesystem::path(f.file).filename().string();
  const auto milliseconds = [](const std::optional<CoderFigures>& figures, double CoderFigures::*member) {
    return figures ? formatted("%.2f", 1e3 * (*figures).*member) : std::string("-");
  };
  std::printf("%-28.28s", name.c_str());
  for (const auto member : {&CoderFigures::encode_seconds, &CoderFigures::decode_seconds,
                            &CoderFigures::connectivity_encode_seconds, &CoderFigures::connectivity_decode_seconds}) {
    std::printf(" | %9.2f %9s %6s %9s %6s", 1e3 * f.ours.*member, milliseconds(f.draco_cl7, member).c_str(),
                timeRatio(f.ours.*member, f.draco_cl7, member).c_str(), milliseconds(f.draco_cl10, member).c_str(),
                timeRatio(f.ours.*member, f.draco_cl10, member).c_str());
  }
  std::printf("\n");
}

struct Bench {
  std::vector<std::string> files;
  std::vector<std::string> attributes;
  PackOptions options;
  double seconds = 0.3;
  bool as_json = false;

  Outcome<Done> run() const {
    if (!as_json) printSizeHead();
    std::vector<BenchFigures> rows;
    std::optional<Failure> first_failure;
    for (const std::string& file : files) {
      Outcome<BenchFigures> figures = measureFile(file);
      if (!figures) {
        printFailure(figures.error());
        if (!first_failure) first_failure = {figures.error().kind, "", "some files were left out; see above"};
        continue;
      }
      as_json ? printJson(*figures) : printSizes(*figures);
      std::fflush(stdout);
      rows.push_back(*std::move(figures));
    }
    if (!as_json && !rows.empty()) summarise(rows);
    if (first_failure) return *first_failure;
    return Done{};
  }

 private:
  Outcome<BenchFigures> measureFile(const std::string& file) const {
    Outcome<LoadedScene> loaded = loadScene(file);
    if (!loaded) return loaded.error();
    return inFile(measure(file, std::move(loaded->scene), options, {attributes.begin(), attributes.end()}, seconds),
                  file);
  }

  static void summarise(const std::vector<BenchFigures>& rows) {
    // Draco may refuse a mesh; then its sum would compare apples with pears, and the row is left out of it.
    BenchFigures sum;
    sum.file = "sum";
    sum.draco_cl7 = sum.draco_cl10 = sum.draco_polygons = CoderFigures{};
    size_t refused = 0;
    for (const BenchFigures& row : rows) {
      if (row.draco_refusal.empty())
        sum += row;
      else
        ++refused;
    }
    printSizes(sum);
    if (sum.paper_bytes) {
      std::printf("connectivity of the paper's models: %s bytes, in the paper %s (%.3f)\n",
                  withCommas(sum.paper_counterpart).c_str(), withCommas(*sum.paper_bytes).c_str(),
                  static_cast<double>(sum.paper_counterpart) / static_cast<double>(*sum.paper_bytes));
    }
    if (refused) std::printf("not in the sum, because Draco refuses them: %zu\n", refused);
    std::printf("\n%-28s", "times (ms)");
    for (const char* what : {"encode", "decode", "enc.conn.", "dec.conn."}) {
      std::printf(" | %9s %9s %6s %9s %6s", what, "D7", "ratio", "D10", "ratio");
    }
    std::printf("\n");
    for (const BenchFigures& row : rows) printTimes(row);
    printTimes(sum);
  }
};

}  // namespace

void addBench(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("bench", "Compare sizes and times with Draco and with the paper");
  const auto bench = std::make_shared<Bench>();
  command.add_option("files", bench->files, "models of any format")->required();
  command.add_flag("--json", bench->as_json, "print one JSON object per line and file");
  addQuantization(command, bench->options);
  addConnectivity(command, bench->options.connectivity);
  addAttributes(command, bench->attributes);
  command.add_option("--seconds", bench->seconds, "how long each step is repeated for its best time")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  addExamples(command,
              "  tutte bench models/*.obj\n"
              "  tutte bench --attributes POSITION --qp 11 beast.obj\n"
              "  tutte bench --json models/*.ply > figures.jsonl");
  command.callback([bench, &action] { action = [bench] { return bench->run(); }; });
}

}  // namespace tutte
