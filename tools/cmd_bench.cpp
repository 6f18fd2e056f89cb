#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "tools/bench.h"
#include "tools/bench_tables.h"
#include "tools/command.h"
#include "tools/lossless_bench.h"

namespace tutte {
namespace {

using Json = nlohmann::json;

const std::map<std::string, Profile> kProfiles{
    {"paper", Profile::kPaper}, {"fast", Profile::kFast}, {"default", Profile::kDefault}, {"small", Profile::kSmall}};

Json jsonOf(const CoderFigures& figures) {
  return {{"connectivity_bytes", figures.connectivity_bytes},
          {"seam_bytes", figures.seam_bytes},
          {"attribute_bytes", figures.attribute_bytes},
          {"by_attribute", figures.by_attribute},
          {"total_bytes", figures.total_bytes},
          {"encode_seconds", figures.encode_seconds},
          {"connectivity_encode_seconds", figures.connectivity_encode_seconds},
          {"decode_seconds", figures.decode_seconds},
          {"connectivity_decode_seconds", figures.connectivity_decode_seconds},
          {"decode_peak_bytes", figures.decode_peak_bytes}};
}

Json jsonOf(const std::optional<CoderFigures>& figures) { return figures ? jsonOf(*figures) : Json(); }

Json jsonOf(const std::map<Profile, ProfileFigures>& profiles) {
  Json list = Json::object();
  for (const auto& [name, profile] : kProfiles) {
    const auto found = profiles.find(profile);
    if (found == profiles.end()) continue;
    const ProfileFigures& figures = found->second;
    list[name] = {{"connectivity_bytes", figures.connectivity_bytes},
                  {"valence_bytes", figures.symbols.valences},
                  {"degree_bytes", figures.symbols.degrees},
                  {"encode_seconds", figures.encode_seconds},
                  {"decode_seconds", figures.decode_seconds}};
  }
  return list;
}

void printJson(const BenchFigures& figures) {
  Json line = jsonOf(figures.ours);
  line["file"] = figures.file;
  line["vertices"] = figures.vertices;
  line["wedges"] = figures.wedges;
  line["faces"] = figures.faces;
  line["splits"] = figures.splits;
  line["valence_bytes"] = figures.symbols.valences;
  line["degree_bytes"] = figures.symbols.degrees;
  line["other_connectivity_bytes"] = figures.otherConnectivityBytes();
  line["bits_per_vertex"] = figures.bitsPerVertex();
  line["glb_bytes"] = figures.glb_bytes;
  line["paper_bytes"] = figures.paper_bytes ? Json(*figures.paper_bytes) : Json();
  line["profiles"] = jsonOf(figures.profiles);
  line["draco_cl7"] = jsonOf(figures.draco_cl7);
  line["draco_cl10"] = jsonOf(figures.draco_cl10);
  line["draco_polygons"] = jsonOf(figures.draco_polygons);
  line["draco_connectivity"] = jsonOf(figures.draco_connectivity);
  line["draco_polygons_total_bytes"] = figures.draco_polygons ? Json(figures.draco_polygons->total_bytes) : Json();
  if (!figures.draco_refusal.empty()) line["draco_refusal"] = figures.draco_refusal;
  std::printf("%s\n", line.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

struct Bench {
  std::vector<std::string> files;
  std::vector<std::string> attributes;
  BenchPlan plan{.options = {},
                 .attributes = {},
                 .profiles = {Profile::kPaper, Profile::kFast, Profile::kDefault, Profile::kSmall}};
  bool as_json = false;
  bool lossless = false;

  Outcome<Done> run() {
    plan.attributes = {attributes.begin(), attributes.end()};
    lossless ? runLossless() : runQuantised();
    if (first_failure_) return *first_failure_;
    return Done{};
  }

 private:
  void runQuantised() {
    if (!as_json) printSizeHead();
    std::vector<BenchFigures> rows;
    forEachFile([&](const std::string& file, Scene scene) -> Outcome<Done> {
      Outcome<BenchFigures> figures = measure(file, std::move(scene), plan);
      if (!figures) return figures.error();
      as_json ? printJson(*figures) : printSizes(*figures);
      rows.push_back(*std::move(figures));
      return Done{};
    });
    if (!as_json) printSummary(rows);
  }

  void runLossless() {
    if (!as_json) printLosslessHead();
    LosslessFigures sum;
    forEachFile([&](const std::string& file, const Scene& scene) -> Outcome<Done> {
      const Outcome<LosslessFigures> figures = measureLossless(file, scene, plan);
      if (!figures) return figures.error();
      as_json ? printLosslessJson(*figures) : printLossless(*figures);
      sum += *figures;
      return Done{};
    });
    sum.file = "sum";
    if (!as_json) printLossless(sum);
  }

  template <class Measure>
  void forEachFile(Measure measure_one) {
    for (const std::string& file : files) {
      Outcome<LoadedScene> loaded = loadScene(file);
      const Outcome<Done> done = loaded ? measure_one(file, std::move(loaded->scene)) : loaded.error();
      std::fflush(stdout);
      if (done) continue;
      printFailure(inFile(done.error(), file));
      if (!first_failure_) first_failure_ = {done.error().kind, "", "some files were left out; see above"};
    }
  }

  std::optional<Failure> first_failure_;
};

constexpr const char* kNotes =
    "  tutte bench models/*.obj\n"
    "  tutte bench --attributes POSITION --qp 11 beast.obj\n"
    "  tutte bench --profiles fast,small --seconds 1 scan.ply\n"
    "  tutte bench --json models/*.ply > figures.jsonl\n"
    "  tutte bench --lossless models/*.glb\n"
    "\n"
    "D7, D10: Draco at compression levels 7 and 10 on the triangles, equal positions welded, the same quantisation.\n"
    "Connectivity, there, is what the buffer grows inside the connectivity step. Draco codes seams in that step: its\n"
    "seam bytes are what the step takes less for the positions alone. Its headers belong to no attribute. Who wants\n"
    "connectivity alone from Draco has to give it positions: with zeros, of one bit and without prediction, it takes\n"
    "the step, an order of the points, and hardly a byte (draco_connectivity, level 10). Speeds are Draco's time by\n"
    "ours: above 1 we are faster. All coders run in turn, and the best of the same number of runs counts, in\n"
    "processor time. Every mesh is coded as if it were the first: no memory is kept from one to the next.\n"
    "\n"
    "JSON, one object per line: file; vertices, wedges (vertices of the glTF file), faces, splits; "
    "connectivity_bytes,\n"
    "of these valence_bytes (with splits), degree_bytes (with holes), other_connectivity_bytes; bits_per_vertex\n"
    "(connectivity); seam_bytes;\n"
    "attribute_bytes (with seams); by_attribute {name: bytes}; total_bytes (payload, no JSON); glb_bytes (all);\n"
    "paper_bytes (connectivity there, or null); encode_seconds, decode_seconds, of these connectivity_encode_seconds,\n"
    "connectivity_decode_seconds; decode_peak_bytes (memory from `new` while decoding, in sums the largest); profiles "
    "{name: {connectivity_bytes, valence_bytes, degree_bytes, encode_seconds,\n"
    "decode_seconds}} (of the connectivity alone); draco_cl7, draco_cl10, draco_polygons, draco_connectivity {the "
    "same\n"
    "fields, with connectivity_bytes including seam_bytes} or null; draco_polygons_total_bytes; draco_refusal (why it "
    "is\n"
    "null).";

}  // namespace

void addBench(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("bench", "Compare sizes and times with Draco and with the paper");
  const auto bench = std::make_shared<Bench>();
  command.add_option("files", bench->files, "models of any format")->required();
  command.add_flag("--json", bench->as_json, "print one JSON object per line and file");
  addQuantization(command, bench->plan.options);
  addConnectivity(command, bench->plan.options.connectivity);
  command
      .add_option("--profiles", bench->plan.profiles,
                  "profiles of the connectivity coder that are measured beside the file's own; by default all")
      ->transform(CLI::CheckedTransformer(kProfiles))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("paper,fast,default,small")
      ->group("Connectivity");
  command.add_flag("--lossless", bench->lossless,
                   "keep every bit, and compare with meshoptimizer's lossless codecs and zstd -19 instead of Draco");
  addAttributes(command, bench->attributes);
  command
      .add_option("--seconds", bench->plan.seconds, "how long each coder is repeated, up to ten times, for its best")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  addExamples(command, kNotes);
  command.callback([bench, &action] { action = [bench] { return bench->run(); }; });
}

}  // namespace tutte
