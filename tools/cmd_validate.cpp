#include <cstdio>
#include <memory>

#include "gltf_ext/asset_files.h"
#include "gltf_ext/decompress.h"
#include "tools/command.h"

namespace tutte {
namespace {

Outcome<Done> validateFile(const std::string& input) {
  const Outcome<Asset> asset = loadAsset(input);
  if (!asset) return inFile(asset.error(), input);
  const std::vector<Failure> failures = validate(*asset);
  for (const Failure& failure : failures) printFailure(inFile(failure, input));
  if (!failures.empty()) {
    return Failure{failures.front().kind, input,
                   std::to_string(failures.size()) + " errors; make the file anew from its source"};
  }
  std::printf("%s: valid\n", input.c_str());
  return Done{};
}

}  // namespace

void addValidate(CLI::App& app, Action& action) {
  CLI::App& command =
      *app.add_subcommand("validate", "Check every rule of the extension in a glTF file, and decode all payloads");
  const auto input = std::make_shared<std::string>();
  command.add_option("input", *input, ".glb or .gltf")->required();
  addExamples(command, "  tutte validate model.glb");
  command.callback([input, &action] { action = [input] { return validateFile(*input); }; });
}

}  // namespace tutte
