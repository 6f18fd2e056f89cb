#include <algorithm>
#include <cstdio>

#include "tests/theory/experiments.h"
#include "tests/theory/measure.h"
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

/// By how much a mesh is smaller than with one context, in percent of that.
double gain(const Coded& one_context, size_t bytes) {
  return 100 * (1 - static_cast<double>(bytes) / static_cast<double>(one_context.bytes));
}

struct Class {
  size_t meshes = 0;
  std::array<double, 5> gains{};  ///< sums: paper, default, small, small's valences alone, small's degrees alone

  void add(const AllCoded& coded) {
    const Coded &one = coded[kFast], &best = coded[kSmall];
    ++meshes;
    gains[0] += gain(one, coded[kPaper].bytes);
    gains[1] += gain(one, coded[kDefault].bytes);
    gains[2] += gain(one, best.bytes);
    gains[3] += gain(one, one.bytes - one.valence_bytes + best.valence_bytes);
    gains[4] += gain(one, one.bytes - one.degree_bytes + best.degree_bytes);
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
      const auto place = std::ranges::lower_bound(kSizes, coded[kSmall].bytes) - kSizes.begin();
      classes[static_cast<size_t>(place)].add(coded);
      for (size_t i = 0; i < kProfileCount; ++i) {
        bytes[i] += coded[i].bytes;
        losses[i].add(path.filename().string(), coded[kPaper], coded[i]);
      }
    }
  }
  Table table({"bytes", "meshes", "paper", "default", "small", "small, valences alone", "small, degrees alone"});
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
             "By how many percent meshes get smaller than with `fast`, which has one context per stream, on average,\n"
             "by their size with `small`, as in the paper's table 1 (there, 13.0 for all sizes, with both streams'\n"
             "contexts). The last two columns take one stream of `small` and one of `fast`. %zu files, %zu others\n"
             "refused; effort 0.\n\n",
             files, refused) +
         table.text() + "\nConnectivity in sum: " + sums +
         ".\n\nMore than 2 % and 8 bytes above `paper`: " + losses[kDefault].text("default") + ", " +
         losses[kSmall].text("small") + ", " + losses[kFast].text("fast") + ".\n";
}

}  // namespace tutte::theory
