#include "tools/paper_rates.h"

#include <array>
#include <cctype>

namespace tutte {
namespace {

struct PaperModel {
  std::string_view name;
  Index vertices;
  bool all_triangles;
  double bytes;  ///< of table 2; 0 where only the rate is printed
  double bits_per_vertex;
};

constexpr std::array<PaperModel, 21> kModels{{
    {"al", 3618, false, 1128, 2.50},         {"beethoven", 2655, false, 763, 2.30},
    {"cessna", 3745, false, 1204, 2.57},     {"cow", 2904, true, 638, 1.76},
    {"cupie", 2984, false, 665, 1.78},       {"galleon", 2373, false, 621, 2.09},
    {"sandal", 2636, false, 749, 2.27},      {"shark", 2560, false, 265, 0.83},
    {"teapot", 1189, false, 182, 1.22},      {"tommygun", 4171, false, 1199, 2.30},
    {"triceratops", 2832, false, 455, 1.28}, {"armadillo", 172729, true, 0, 1.65},
    {"bunny", 34835, true, 0, 1.07},         {"david", 101643, true, 0, 2.42},
    {"dinosaur", 14070, true, 0, 2.25},      {"fandisk", 6475, true, 0, 0.93},
    {"feline", 49864, true, 0, 2.20},        {"horse", 48485, true, 0, 1.33},
    {"molecule", 10028, true, 0, 1.80},      {"rabbit", 67039, true, 0, 1.47},
    {"venus", 50002, true, 0, 2.05},
}};

bool beginsWith(std::string_view stem, std::string_view name) {
  if (stem.size() < name.size()) return false;
  for (size_t i = 0; i < name.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(stem[i])) != name[i]) return false;
  }
  return stem.size() == name.size() || !std::isalpha(static_cast<unsigned char>(stem[name.size()]));
}

}  // namespace

std::optional<double> paperBitsPerVertex(std::string_view file_stem, Index vertices, bool all_triangles) {
  for (const PaperModel& model : kModels) {
    const Index difference = vertices > model.vertices ? vertices - model.vertices : model.vertices - vertices;
    if (difference > 1 || model.all_triangles != all_triangles || !beginsWith(file_stem, model.name)) continue;
    return model.bytes > 0 ? 8 * model.bytes / model.vertices : model.bits_per_vertex;
  }
  return {};
}

}  // namespace tutte
