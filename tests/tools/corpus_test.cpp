// Every real model: encoded, written, read, decoded, compared; or refused for a reason.

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "gltf_ext/asset_files.h"
#include "tests/tools/scratch.h"
#include "tools/command.h"
#include "tools/compare.h"
#include "tools/import.h"

namespace tutte {
namespace {

bool isModel(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  for (const char* known : {".obj", ".smf", ".ply", ".off", ".glb", ".gltf"}) {
    if (extension == known) return true;
  }
  return false;
}

std::vector<std::filesystem::path> modelsIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> models;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && isModel(entry.path())) models.push_back(entry.path());
  }
  std::sort(models.begin(), models.end());
  return models;
}

Outcome<Compressed> encodeFile(const std::filesystem::path& path, const Scene& scene) {
  if (isGltfName(path)) {
    const Outcome<Asset> asset = loadAsset(path);
    if (!asset) return asset.error();
    return compress(*asset);
  }
  return sceneToAsset(scene);
}

/// Why the file is refused, or nothing. Whatever is encoded must come back.
std::optional<Failure> roundTrip(const std::filesystem::path& path) {
  const Outcome<LoadedScene> original = loadScene(path);
  if (!original) return original.error();
  const Outcome<Compressed> compressed = encodeFile(path, original->scene);
  if (!compressed) return compressed.error();
  const Outcome<Bytes> glb = toGlb(compressed->asset);
  if (!glb) return glb.error();
  const Outcome<Asset> parsed = parseAsset(*glb);
  EXPECT_TRUE(parsed.ok()) << parsed.error().where << ": " << parsed.error().what;
  if (!parsed) return {};
  const Outcome<Scene> decoded = assetToScene(*parsed);
  EXPECT_TRUE(decoded.ok()) << decoded.error().where << ": " << decoded.error().what;
  if (!decoded) return {};
  CompareOptions options;
  Comparison comparison = compare(original->scene, *decoded, options);
  if (!comparison.same && !original->keeps_vertices) {
    options.vertices_matter = false;
    comparison = compare(original->scene, *decoded, options);
  }
  EXPECT_TRUE(comparison.same) << comparison.difference;
  return {};
}

class Corpus : public testing::TestWithParam<const char*> {};

TEST_P(Corpus, EncodesDecodesAndVerifiesOrSaysWhyNot) {
  const std::filesystem::path corpus = corpusFolder();
  if (corpus.empty()) GTEST_SKIP() << "no corpus: set TUTTE_CORPUS to its folder";
  size_t count = 0, refused = 0;
  for (const auto& model : modelsIn(corpus / GetParam())) {
    SCOPED_TRACE(model.string());
    ++count;
    if (const auto refusal = roundTrip(model)) {
      ++refused;
      EXPECT_FALSE(refusal->what.empty());
      std::cout << "refused: " << refusal->where << ": " << refusal->what << "\n";
    }
  }
  std::cout << GetParam() << ": " << count << " models, " << refused << " refused\n";
  EXPECT_GT(count, 0u);
}

INSTANTIATE_TEST_SUITE_P(Folders, Corpus,
                         testing::Values("paper-polygon", "paper-triangle", "polygon", "triangle", "hard", "gltf"),
                         [](const auto& folder) {
                           std::string name = folder.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace tutte
