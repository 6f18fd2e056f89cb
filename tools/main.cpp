// tutte: polygon meshes to compressed glTF and back.

#include <exception>
#include <new>

#include "tools/command.h"

namespace {

/// Parses and runs; the exit code is 0 or that of FailureKind.
int run(int argc, char** argv) {
  using namespace tutte;
  CLI::App app("Polygon meshes in glTF, compressed as vertex valences and face degrees.", "tutte");
  app.set_version_flag("--version", TUTTE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  tutte encode model.obj model.glb     compress\n"
      "  tutte decode model.glb model.obj     and back\n"
      "  tutte bench model.obj                compare with Draco\n"
      "\n"
      "Exit codes: 0 done, 1 wrong usage, 2 invalid input, 3 unsupported input, 4 verification failed,\n"
      "5 reading or writing failed.");
  Action action;
  for (const auto add : {addEncode, addDecode, addInspect, addValidate, addVerify, addBench, addTrace})
    add(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    printFailure({FailureKind::kUsage, "command line", std::string(error.what()) + "; see tutte --help"});
    return static_cast<int>(FailureKind::kUsage);
  }
  const Outcome<Done> outcome = action();
  if (outcome) return 0;
  printFailure(outcome.error());
  return static_cast<int>(outcome.error().kind);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    tutte::printFailure({tutte::FailureKind::kIo, "", "out of memory; close other programs or use a smaller model"});
  } catch (const std::exception& error) {
    tutte::printFailure({tutte::FailureKind::kIo, "", std::string("unexpected: ") + error.what()});
  }
  return static_cast<int>(tutte::FailureKind::kIo);
}
