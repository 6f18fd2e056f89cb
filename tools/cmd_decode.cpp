#include <cstdio>
#include <memory>

#include "gltf_ext/asset_files.h"
#include "gltf_ext/decompress.h"
#include "gltf_ext/files.h"
#include "tools/command.h"
#include "tools/export.h"

namespace tutte {
namespace {

struct Decode {
  std::string input, output;

  Outcome<Done> run() const {
    const Outcome<Asset> asset = loadAsset(input);
    if (!asset) return inFile(asset.error(), input);
    if (const Outcome<Done> written = isGltfName(output) ? writeGltf(*asset) : writeOther(*asset); !written) {
      return written;
    }
    std::error_code error;
    std::printf("%s: %s bytes\n", output.c_str(), withCommas(std::filesystem::file_size(output, error)).c_str());
    return Done{};
  }

 private:
  Outcome<Done> writeGltf(const Asset& asset) const {
    const Outcome<Asset> plain = decompress(asset);
    if (!plain) return inFile(plain.error(), input);
    return inFile(saveAsset(*plain, output), output);
  }

  Outcome<Done> writeOther(const Asset& asset) const {
    const Outcome<Scene> scene = assetToScene(asset);
    if (!scene) return inFile(scene.error(), input);
    const Outcome<Exported> exported = exportScene(*scene, output);
    if (!exported) return exported.error();
    for (const std::string& warning : exported->warnings) printWarning(output, warning);
    return inFile(writeFiles(exported->files), output);
  }
};

}  // namespace

void addDecode(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("decode", "Turn a compressed glTF file into a plain one, or into OBJ or PLY");
  const auto decode = std::make_shared<Decode>();
  command.add_option("input", decode->input, ".glb or .gltf")->required();
  command.add_option("output", decode->output, ".glb, .gltf, .obj or .ply")->required();
  addExamples(command,
              "  tutte decode model.glb plain.glb     for programs without the extension\n"
              "  tutte decode model.glb model.obj     with its polygons");
  command.callback([decode, &action] { action = [decode] { return decode->run(); }; });
}

}  // namespace tutte
