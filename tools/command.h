#pragma once
// What the sub-commands of `tutte` share.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gltf_ext/compress.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/scene.h"

namespace tutte {

/// What main() runs once the command line is understood.
using Action = std::function<Outcome<Done>()>;

// --- One function per sub-command: declares it, and sets `action` when it is the one that was asked for.

void addEncode(CLI::App& app, Action& action);
void addDecode(CLI::App& app, Action& action);
void addInspect(CLI::App& app, Action& action);
void addValidate(CLI::App& app, Action& action);
void addVerify(CLI::App& app, Action& action);
void addBench(CLI::App& app, Action& action);
void addTrace(CLI::App& app, Action& action);

// --- Options that several sub-commands have.

/// --qp --qn --qt --qc --qg.
void addQuantization(CLI::App& command, PackOptions& options);

/// --error, as in "0.1mm" or "TEXCOORD=0.01%".
void addErrorBounds(CLI::App& command, ErrorBounds& errors);

/// --profile and --effort.
void addConnectivity(CLI::App& command, EncodeOptions& options);

/// --attributes A,B,C.
void addAttributes(CLI::App& command, std::vector<std::string>& names);

/// A line or two under the help text: how the command is used.
void addExamples(CLI::App& command, const std::string& examples);

// --- Files and messages.

/// A failure whose place begins with the file's name.
Failure inFile(Failure failure, const std::filesystem::path& path);

/// The value, or the failure at its place in the file.
template <class T>
Outcome<T> inFile(Outcome<T> outcome, const std::filesystem::path& path) {
  if (outcome) return outcome;
  return inFile(outcome.error(), path);
}

/// "tutte: <place>: <what>; <remedy>", on standard error.
void printFailure(const Failure& failure);

/// "tutte: <file>: warning: <what>", on standard error.
void printWarning(const std::filesystem::path& path, const std::string& warning);
void printWarnings(const std::filesystem::path& path, const std::vector<Failure>& warnings);

/// A file of any kind as a Scene; warnings are printed.
struct LoadedScene {
  Scene scene;
  std::optional<std::map<std::string, double>> bounds;  ///< of its payloads, if it has any (see codedBounds())
  bool keeps_vertices = true;  ///< the file says which corners share a vertex (plain glTF does not, welding guesses)
};
Outcome<LoadedScene> loadScene(const std::filesystem::path& path);

/// True for a name that ends in .glb or .gltf.
bool isGltfName(const std::filesystem::path& path);

/// 12345 -> "12,345".
std::string withCommas(uint64_t number);

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace tutte
