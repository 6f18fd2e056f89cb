#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "gltf_ext/attribute_name.h"
#include "tools/command.h"
#include "tools/compare.h"

namespace tutte {
namespace {

/// The options that tell how coarse the second file may be.
struct BitsOption {
  const char* name;
  int PackOptions::*member;
};
constexpr std::array<BitsOption, 5> kBits{{{"--qp", &PackOptions::position_bits},
                                           {"--qn", &PackOptions::normal_bits},
                                           {"--qt", &PackOptions::texcoord_bits},
                                           {"--qc", &PackOptions::color_bits},
                                           {"--qg", &PackOptions::generic_bits}}};

struct Verify {
  std::string first, second;
  CompareOptions options;
  std::array<bool, kBits.size()> given{};  ///< by the user
  std::vector<std::string> attributes;

  Outcome<Done> run() {
    options.attributes = {attributes.begin(), attributes.end()};
    const Outcome<LoadedScene> a = loadScene(first);
    if (!a) return a.error();
    const Outcome<LoadedScene> b = loadScene(second);
    if (!b) return b.error();
    for (const auto* bounds : {&a->bounds, &b->bounds}) {
      if (*bounds) takeBounds(**bounds);
    }
    Comparison comparison = compare(a->scene, b->scene, options);
    bool by_place = false;
    if (!comparison.same && !(a->keeps_vertices && b->keeps_vertices)) {
      // Such a file does not say which corners share a vertex; what lies at one place may then be one or several.
      options.vertices_matter = false;
      comparison = compare(a->scene, b->scene, options);
      by_place = true;
    }
    if (!comparison.same) {
      return Failure{
          FailureKind::kVerification, first + ", " + second,
          comparison.difference + (options.exact ? "; without --exact, rounding is allowed"
                                                 : "; compare with the bits that were used to encode (--qp, ...)")};
    }
    std::printf("same: %s polygons, %s vertices%s\n", withCommas(comparison.faces).c_str(),
                withCommas(comparison.vertices).c_str(), by_place ? " (compared by place)" : "");
    printErrors(comparison);
    return Done{};
  }

 private:
  /// What a file says about its attributes, where the user says nothing; the coarser of two counts.
  void takeBounds(const std::map<std::string, double>& coded) {
    for (const auto& [name, bound] : coded) {
      if (given[optionOf(name)]) continue;
      double& taken = options.bounds[name];
      taken = std::max(taken, bound);
    }
  }

  /// The index in kBits of the option that is about an attribute.
  static size_t optionOf(const std::string& name) {
    const AttributeName parsed = parseName(name);
    if (parsed.semantic == Semantic::kPosition) return 0;
    if (parsed.is_target) return 4;
    switch (parsed.semantic) {
      case Semantic::kNormal:
      case Semantic::kTangent: return 1;
      case Semantic::kTexcoord: return 2;
      case Semantic::kColor: return 3;
      default: return 4;
    }
  }

  void printErrors(const Comparison& comparison) const {
    if (options.exact) return void(std::printf("all attributes have the same bits\n"));
    for (const AttributeError& error : comparison.errors) {
      const auto bound = options.bounds.find(error.name);
      const std::string promise = bound == options.bounds.end() ? "" : formatted(" (guaranteed: %.3g)", bound->second);
      std::printf("  %-16s largest error %.3g%s\n", error.name.c_str(), error.largest, promise.c_str());
    }
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
  command.add_flag("--exact", verify->options.exact, "attributes must be the same bit for bit, types included");
  addAttributes(command, verify->attributes);
  addExamples(command,
              "  tutte verify model.obj model.glb\n"
              "  tutte verify --qp 11 model.obj decoded.obj     when it was encoded with --qp 11\n"
              "  tutte verify --attributes POSITION a.ply b.ply\n"
              "  tutte verify --exact model.glb lossless.glb\n"
              "\n"
              "Compressed files say how they are quantised; the options are for others. The largest error found is "
              "printed per\n"
              "attribute, of positions in units of the scene.");
  command.callback([verify, &command, &action] {
    for (size_t i = 0; i < kBits.size(); ++i) verify->given[i] = command.count(kBits[i].name) > 0;
    action = [verify] { return verify->run(); };
  });
}

}  // namespace tutte
