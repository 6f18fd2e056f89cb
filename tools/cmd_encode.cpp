#include <cstdio>
#include <map>
#include <memory>

#include "gltf_ext/asset_files.h"
#include "gltf_ext/files.h"
#include "tools/command.h"
#include "tools/import.h"

namespace tutte {
namespace {

struct Encode {
  std::string input, output;
  CompressOptions options;
  std::vector<std::string> attributes;
  bool lossless = false;

  Outcome<Done> run() {
    if (!isGltfName(output)) {
      return Failure{FailureKind::kUsage, output, "cannot encode to this kind of file; name a .glb or .gltf file"};
    }
    options.attributes = {attributes.begin(), attributes.end()};
    if (lossless) options.pack = withoutLoss(options.pack);
    Outcome<Compressed> compressed = compressFile();
    if (!compressed) return inFile(compressed.error(), input);
    printWarnings(input, compressed->report.warnings);
    if (const Outcome<Done> saved = saveAsset(compressed->asset, output); !saved) return inFile(saved.error(), output);
    summarise(compressed->report);
    return Done{};
  }

 private:
  Outcome<Compressed> compressFile() {
    const Outcome<Bytes> bytes = readFile(input);
    if (!bytes) return bytes.error();
    if (formatOf(input, *bytes) == FileFormat::kGltf) {
      const Outcome<Asset> asset = loadAsset(input);
      if (!asset) return asset.error();
      return compress(*asset, options);
    }
    Outcome<Imported> imported = importScene(input);
    if (!imported) return imported.error();
    for (const std::string& warning : imported->warnings) printWarning(input, warning);
    return sceneToAsset(imported->scene, options);
  }

  void summarise(const CompressReport& report) const {
    size_t vertices = 0, faces = 0, payload = 0;
    for (const PayloadReport& mesh : report.payloads) {
      vertices += mesh.vertices;
      faces += mesh.faces;
      payload += mesh.packed.bytes.size();
    }
    std::error_code error;
    const auto before = std::filesystem::file_size(input, error);
    const auto after = std::filesystem::file_size(output, error);
    std::printf("%s: %s vertices, %s polygons in %s bytes (payload %s; the input file has %s)\n", output.c_str(),
                withCommas(vertices).c_str(), withCommas(faces).c_str(), withCommas(after).c_str(),
                withCommas(payload).c_str(), withCommas(before).c_str());
  }
};

}  // namespace

void addEncode(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("encode", "Compress a model into glTF with its polygons");
  const auto encode = std::make_shared<Encode>();
  command.add_option("input", encode->input, ".glb, .gltf, .obj, .smf, .ply, .off, or any format that Assimp reads")
      ->required();
  command.add_option("output", encode->output, ".glb or .gltf")->required();
  addQuantization(command, encode->options.pack);
  addErrorBounds(command, encode->options.pack.errors);
  CLI::Option* const lossless = command.add_flag("--lossless", encode->lossless, "keep every bit of every attribute");
  lossless->group("Quantisation");
  for (const char* name : {"--qp", "--qn", "--qt", "--qc", "--qg", "--error"}) lossless->excludes(name);
  static const std::map<std::string, GridScope> kScopes = {{"file", GridScope::kFile}, {"mesh", GridScope::kMesh}};
  command
      .add_option("--grid", encode->options.grid,
                  "whose positions are rounded alike, so that no cracks open between them: file (meshes much smaller "
                  "than the largest get a finer step), or mesh")
      ->transform(CLI::CheckedTransformer(kScopes, CLI::ignore_case).description(""))
      ->type_name("SCOPE")
      ->group("Quantisation");
  addConnectivity(command, encode->options.pack.connectivity);
  addAttributes(command, encode->attributes);
  static const std::map<std::string, PolygonOutput> kPolygons = {{"auto", PolygonOutput::kAuto},
                                                                 {"fb", PolygonOutput::kFb},
                                                                 {"ext", PolygonOutput::kExt},
                                                                 {"both", PolygonOutput::kBoth}};
  command
      .add_option("--polygons", encode->options.polygons,
                  "how other programs find the polygons: fb (FB_ngon_encoding), ext (EXT_mesh_polygon), both, or auto")
      ->transform(CLI::CheckedTransformer(kPolygons, CLI::ignore_case).description(""))
      ->type_name("KIND");
  command.add_flag("--fallback", encode->options.fallback,
                   "store the uncompressed data too, for programs without the extension");
  addExamples(command,
              "  tutte encode model.obj model.glb\n"
              "  tutte encode --qp 11 --attributes POSITION model.ply model.glb\n"
              "  tutte encode --error 0.1mm scan.ply scan.glb\n"
              "  tutte encode --error 0.01%,TEXCOORD=0.0005 model.fbx model.glb\n"
              "  tutte encode --lossless model.fbx model.gltf");
  command.callback([encode, &action] { action = [encode] { return encode->run(); }; });
}

}  // namespace tutte
