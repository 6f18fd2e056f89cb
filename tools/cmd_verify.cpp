#include <cstdio>
#include <memory>

#include "tools/command.h"
#include "tools/compare.h"

namespace tutte {
namespace {

struct Verify {
  std::string first, second;
  CompareOptions options;
  std::vector<std::string> attributes;

  Outcome<Done> run() {
    options.attributes = {attributes.begin(), attributes.end()};
    const Outcome<LoadedScene> a = loadScene(first);
    if (!a) return a.error();
    const Outcome<LoadedScene> b = loadScene(second);
    if (!b) return b.error();
    Comparison comparison = compare(a->scene, b->scene, options);
    bool by_place = false;
    if (!comparison.same && !(a->keeps_vertices && b->keeps_vertices)) {
      // Such a file does not say which corners share a vertex; what lies at one place may then be one or several.
      options.vertices_matter = false;
      comparison = compare(a->scene, b->scene, options);
      by_place = true;
    }
    if (!comparison.same) {
      return Failure{FailureKind::kVerification, first + ", " + second,
                     comparison.difference + "; compare with the bits that were used to encode (--qp, ...)"};
    }
    std::printf("same: %s polygons, %s vertices%s\n", withCommas(comparison.faces).c_str(),
                withCommas(comparison.vertices).c_str(), by_place ? " (compared by place)" : "");
    return Done{};
  }
};

}  // namespace

void addVerify(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand(
      "verify", "Tell whether two files hold the same polygons and attributes, up to order and quantisation");
  const auto verify = std::make_shared<Verify>();
  command.add_option("first", verify->first, "the original, of any format")->required();
  command.add_option("second", verify->second, "what became of it, of any format")->required();
  addQuantization(command, verify->options.bits);
  command
      .add_option("--tolerance", verify->options.tolerance,
                  "how far a coordinate of a position may be off, instead of what --qp allows")
      ->check(CLI::NonNegativeNumber);
  addAttributes(command, verify->attributes);
  addExamples(command,
              "  tutte verify model.obj model.glb\n"
              "  tutte verify --qp 11 model.obj model.glb     when encoded with --qp 11\n"
              "  tutte verify --attributes POSITION a.ply b.ply");
  command.callback([verify, &action] { action = [verify] { return verify->run(); }; });
}

}  // namespace tutte
