// Every glTF file of the corpus, where it exists: compressed, saved, read, compared.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "gltf_ext/asset_files.h"
#include "gltf_ext/asset_rules.h"
#include "gltf_ext/decompress.h"
#include "tests/gltf/assets.h"

namespace tutte {
namespace {

/// Files that cannot be compressed, and the place that their refusal must name.
const std::map<std::string, std::string> kRefused = {
    {"IncorrectVertexArrays/Cube.gltf", "/bufferViews/4"},  // its buffer views are longer than its buffers
};

std::filesystem::path corpusFolder() {
  const char* named = std::getenv("TUTTE_CORPUS");
  const auto project = std::filesystem::path(__FILE__).parent_path() / "../..";
  return (named ? std::filesystem::path(named) : project / "../shared/corpus") / "gltf";
}

std::vector<std::filesystem::path> corpusFiles() {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(corpusFolder(), error)) {
    if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void checkFile(const std::filesystem::path& path, const CompressOptions& options, const std::string& refusal) {
  const auto asset = loadAsset(path);
  ASSERT_TRUE(asset) << why(asset);
  const auto compressed = compress(*asset, options);
  if (!refusal.empty()) {
    ASSERT_FALSE(compressed);
    EXPECT_EQ(compressed.error().where, refusal);
    return;
  }
  ASSERT_TRUE(compressed) << why(compressed);
  const auto glb = toGlb(compressed->asset);
  ASSERT_TRUE(glb) << why(glb);
  const auto loaded = parseAsset(*glb);
  ASSERT_TRUE(loaded) << why(loaded);
  for (const Failure& failure : validate(*loaded)) ADD_FAILURE() << failure.where << ": " << failure.what;
  const auto plain = decompress(*loaded);
  ASSERT_TRUE(plain) << why(plain);
  const auto rules = checkAsset(*plain);
  EXPECT_TRUE(rules) << why(rules);
  expectSameScene(*asset, *loaded);
  expectSameScene(*asset, *plain);
}

TEST(GltfCorpus, ComesBackExactlyWithoutQuantisation) {
  const auto files = corpusFiles();
  if (files.empty()) GTEST_SKIP() << "no corpus at " << corpusFolder();
  size_t refused = 0;
  for (const auto& path : files) {
    const std::string name = std::filesystem::relative(path, corpusFolder()).generic_string();
    SCOPED_TRACE(name);
    const auto refusal = kRefused.find(name);
    refused += refusal != kRefused.end();
    checkFile(path, lossless(), refusal == kRefused.end() ? "" : refusal->second);
  }
  std::cout << files.size() << " files, " << refused << " refused\n";
}

}  // namespace
}  // namespace tutte
