#include <algorithm>
#include <cstdio>

#include "tests/theory/experiments.h"
#include "tests/theory/measure.h"
#include "tests/theory/paper_contexts.h"
#include "tests/theory/report.h"
#include "tools/command.h"

namespace tutte::theory {
namespace {

namespace fs = std::filesystem;

/// The classes of the paper's table 1, by compressed size, and one more.
constexpr std::array<size_t, 8> kSizes = {100, 200, 400, 1000, 5000, 10'000, 85'000, SIZE_MAX};
constexpr std::array<const char*, 8> kClasses = {"1 - 100",   "100 - 200",  "200 - 400",   "400 - 1,000",
                                                 "1 k - 5 k", "5 k - 10 k", "10 k - 85 k", "larger"};

constexpr size_t kPaper = 0, kFast = 1, kDefault = 2, kSmall = 3;

struct Class {
  size_t meshes = 0;
  std::array<double, 6> gains{};  ///< sums of percents: the paper's (both, valences, degrees), fast, default, small

  void add(const PaperBytes& paper, const AllCoded& coded) {
    ++meshes;
    const std::array<size_t, 6> bytes = {paper.both,         paper.valences,        paper.degrees,
                                         coded[kFast].bytes, coded[kDefault].bytes, coded[kSmall].bytes};
    for (size_t i = 0; i < bytes.size(); ++i) {
      gains[i] += 100 * (1 - static_cast<double>(bytes[i]) / static_cast<double>(paper.neither));
    }
  }
  Class& operator+=(const Class& other) {
    meshes += other.meshes;
    for (size_t i = 0; i < gains.size(); ++i) gains[i] += other.gains[i];
    return *this;
  }
};

/// Meshes that a profile of mixed contexts codes worse than the paper's by more than 2 % and 8 bytes.
struct Losses {
  size_t meshes = 0;
  std::string worst;
  double worst_ratio = 1;

  void add(const std::string& name, const Coded& paper, const Coded& mixed) {
    if (static_cast<double>(mixed.bytes) <= 1.02 * static_cast<double>(paper.bytes) + 8) return;
    ++meshes;
    const double ratio = static_cast<double>(mixed.bytes) / static_cast<double>(paper.bytes);
    if (ratio <= worst_ratio) return;
    worst_ratio = ratio;
    worst = name;
  }
  std::string text(const char* profile) const {
    std::string line = formatted("%zu meshes with `%s`", meshes, profile);
    return meshes == 0 ? line : line + formatted(" (most: %s, by %.1f %%)", worst.c_str(), 100 * (worst_ratio - 1));
  }
};

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    const bool text = extension == ".md" || extension == ".tsv" || extension == ".bin" || extension == ".png";
    if (entry.is_regular_file() && !text) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string gainOfContexts(const fs::path& corpus) {
  std::array<Class, kSizes.size()> classes;
  std::array<uint64_t, kProfileCount> bytes{};
  std::array<Losses, kProfileCount> losses;
  size_t files = 0, refused = 0;
  for (const fs::path& path : filesIn(corpus)) {
    const Outcome<LoadedScene> loaded = loadScene(path);
    loaded ? ++files : ++refused;
    if (!loaded) continue;
    for (const SceneMesh& mesh : loaded->scene.meshes) {
      if (mesh.mesh.polygons.face_degrees.empty()) continue;
      const AllCoded coded = codeAll(mesh.mesh.polygons, 0);
      const auto place = std::ranges::lower_bound(kSizes, coded[kPaper].bytes) - kSizes.begin();
      classes[static_cast<size_t>(place)].add(paperBytes(mesh.mesh.polygons), coded);
      for (size_t i = 0; i < kProfileCount; ++i) {
        bytes[i] += coded[i].bytes;
        losses[i].add(path.filename().string(), coded[kPaper], coded[i]);
      }
    }
  }
  Table table(
      {"bytes", "meshes", "paper's contexts", "for valences alone", "for degrees alone", "fast", "default", "small"});
  Class all;
  const auto add = [&](const char* name, const Class& entry) {
    if (entry.meshes == 0) return;
    std::vector<std::string> row{name, withCommas(entry.meshes)};
    for (const double sum : entry.gains) row.push_back(formatted("%.1f", sum / static_cast<double>(entry.meshes)));
    table.add(row);
  };
  for (size_t i = 0; i < classes.size(); ++i) {
    add(kClasses[i], classes[i]);
    all += classes[i];
  }
  add("all", all);
  std::string sums;
  for (size_t i = 0; i < kProfileCount; ++i) {
    sums += formatted("%s%s `%s`", i ? ", " : "", withCommas(bytes[i]).c_str(), kProfileNames[i]);
  }
  return formatted(
             "By how many percent meshes get smaller than with the paper's symbols in one context per stream, on\n"
             "average, by their size with the paper's contexts (profile `paper`): as in its table 1, which has 13.0,\n"
             "-2.8 and 11.2 in the last line of the first three columns. The other profiles code other symbols, and\n"
             "components that repeat others by reference. %zu files, %zu others cannot be read; effort 0.\n\n",
             files, refused) +
         table.text() + "\nConnectivity in sum: " + sums +
         ".\n\nMore than 2 % and 8 bytes above `paper`: " + losses[kDefault].text("default") + ", " +
         losses[kSmall].text("small") + ", " + losses[kFast].text("fast") + ".\n";
}

}  // namespace tutte::theory
