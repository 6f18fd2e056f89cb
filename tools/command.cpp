#include "tools/command.h"

#include <cstdarg>
#include <cstdio>
#include <map>

#include "gltf_ext/asset_files.h"
#include "gltf_ext/files.h"
#include "tools/import.h"
#include "tools/payloads.h"
#include "tools/text.h"

namespace tutte {

void addQuantization(CLI::App& command, PackOptions& options) {
  const auto add = [&](const char* name, int& bits, const char* what) {
    command.add_option(name, bits, std::string("bits per component of ") + what + "; 0 keeps them exactly")
        ->check(CLI::Range(0, 24))
        ->capture_default_str()
        ->group("Quantisation");
  };
  add("--qp", options.position_bits, "positions");
  add("--qn", options.normal_bits, "normals and tangents");
  add("--qt", options.texcoord_bits, "texture coordinates");
  add("--qc", options.color_bits, "colours");
  add("--qg", options.generic_bits, "other attributes");
  const std::map<std::string, AttributeCoder> coders{
      {"auto", AttributeCoder::kAuto}, {"draco", AttributeCoder::kDraco}, {"tutte", AttributeCoder::kTutte}};
  command
      .add_option("--attribute-coder", options.attribute_coder,
                  "who codes the attributes; auto keeps the smaller (effort 0 and 1: tutte, without trying)")
      ->transform(CLI::CheckedTransformer(coders))
      ->option_text("auto|draco|tutte")
      ->group("Quantisation");
}

void addConnectivity(CLI::App& command, EncodeOptions& options) {
  const std::map<std::string, Profile> profiles{
      {"paper", Profile::kPaper}, {"fast", Profile::kFast}, {"default", Profile::kDefault}, {"small", Profile::kSmall}};
  command
      .add_option_function<Profile>(
          "--profile", [&options](const Profile& profile) { options.profile = profile; },
          "statistics of connectivity and attributes; without it, chosen by the size of the mesh")
      ->transform(CLI::CheckedTransformer(profiles))
      ->option_text("fast|default|small|paper")
      ->group("Connectivity");
  command.add_option("--effort", options.effort, "how long to search for fewer bytes, 0 to 3")
      ->check(CLI::Range(0, 3))
      ->capture_default_str()
      ->group("Connectivity");
}

void addAttributes(CLI::App& command, std::vector<std::string>& names) {
  command.add_option("--attributes", names, "keep only these, such as POSITION,NORMAL (POSITION always stays)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,...");
}

void addExamples(CLI::App& command, const std::string& examples) { command.footer("Examples:\n" + examples); }

Failure inFile(Failure failure, const std::filesystem::path& path) {
  if (failure.where.starts_with(path.string())) return failure;
  failure.where = path.string() + (failure.where.empty() ? "" : ": " + failure.where);
  return failure;
}

namespace {

/// What to do about a failure that does not say so itself.
const char* remedyFor(FailureKind kind) {
  switch (kind) {
    case FailureKind::kUsage: return "see tutte --help";
    case FailureKind::kInvalid: return "get the file once more, or make it anew from its source";
    case FailureKind::kUnsupported: return "convert the file with the program that made it";
    case FailureKind::kVerification: return "compare with the bits that were used to encode";
    case FailureKind::kIo: return "check the name, the rights and the space on the disk";
  }
  return "";
}

}  // namespace

void printFailure(const Failure& failure) {
  const std::string where = failure.where.empty() ? "" : failure.where + ": ";
  const bool complete = failure.what.find("; ") != std::string::npos;
  std::fprintf(stderr, "tutte: %s%s%s%s\n", where.c_str(), failure.what.c_str(), complete ? "" : "; ",
               complete ? "" : remedyFor(failure.kind));
}

void printWarning(const std::filesystem::path& path, const std::string& warning) {
  std::fprintf(stderr, "tutte: %s: warning: %s\n", path.c_str(), warning.c_str());
}

void printWarnings(const std::filesystem::path& path, const std::vector<Failure>& warnings) {
  for (const Failure& warning : warnings) {
    printWarning(path, (warning.where.empty() ? "" : warning.where + ": ") + warning.what);
  }
}

Outcome<LoadedScene> loadScene(const std::filesystem::path& path) {
  const Outcome<Bytes> bytes = readFile(path);
  if (!bytes) return inFile(bytes.error(), path);
  if (const FileFormat format = formatOf(path, *bytes); format != FileFormat::kGltf) {
    Outcome<Imported> imported = importScene(path);
    if (!imported) return inFile(imported.error(), path);
    for (const std::string& warning : imported->warnings) printWarning(path, warning);
    return LoadedScene{std::move(imported->scene), {}, format != FileFormat::kOther};
  }
  const Outcome<Asset> asset = loadAsset(path);
  if (!asset) return inFile(asset.error(), path);
  Outcome<Scene> scene = assetToScene(*asset);
  if (!scene) return inFile(scene.error(), path);
  const auto bounds = codedBounds(*asset);
  return LoadedScene{*std::move(scene), bounds, bounds.has_value()};
}

bool isGltfName(const std::filesystem::path& path) {
  const std::string extension = lowerCase(path.extension().string());
  return extension == ".glb" || extension == ".gltf";
}

std::string withCommas(uint64_t number) {
  std::string digits = std::to_string(number);
  for (size_t place = digits.size(); place > 3;) digits.insert(place -= 3, ",");
  return digits;
}

std::string formatted(const char* format, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return {buffer, std::min<size_t>(length < 0 ? 0 : static_cast<size_t>(length), sizeof buffer - 1)};
}

}  // namespace tutte
