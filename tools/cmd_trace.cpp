#include <cstdio>
#include <memory>

#include "codec/section.h"
#include "codec/trace.h"
#include "gltf_ext/asset_files.h"
#include "tools/command.h"
#include "tools/payloads.h"

namespace tutte {
namespace {

/// One line per symbol; numbers in front say where it stands.
void printEvent(const TraceEvent& event) {
  std::printf("c%u f%u v%u  ", event.component, event.face, event.umbrella);
  switch (event.kind) {
    case TraceEvent::Kind::kComponent: std::printf("component\n"); return;
    case TraceEvent::Kind::kEnd: std::printf("end\n"); return;
    case TraceEvent::Kind::kFace:
      std::printf("%s %u%s%s known_edges %u behind %u gap %u\n", event.dummy ? "dummy" : "degree", event.degree,
                  event.seed ? " seed" : "", event.closed ? " closed" : "", event.known_edges, event.degree_behind,
                  event.gap);
      return;
    case TraceEvent::Kind::kVertex:
      std::printf("valence %u missing %u known %u sum %llu\n", event.valence, event.missing, event.known_vertices,
                  static_cast<unsigned long long>(event.valence_sum));
      return;
    case TraceEvent::Kind::kSplit:
      std::printf("split gap %u slots_after %u missing %u\n", event.gap, event.slots_after, event.missing);
      return;
  }
}

Outcome<Done> traceFile(const std::string& input) {
  const Outcome<Asset> asset = loadAsset(input);
  if (!asset) return inFile(asset.error(), input);
  const Outcome<std::vector<PayloadBytes>> payloads = payloadsOf(*asset);
  if (!payloads) return inFile(payloads.error(), input);
  for (size_t i = 0; i < payloads->size(); ++i) {
    const auto section = (*payloads)[i].view[Section::kConnectivity];
    SectionHeader header;
    const bool dual = readSection(section, header).ok() && header.dual;
    std::printf("payload %zu%s\n", i, dual ? ", dual: faces and vertices have changed places" : "");
    const Error error = trace(section, Limits{}, printEvent);
    if (error != Error::kNone) return inFile(failureOf(error, "payload " + std::to_string(i)), input);
  }
  return Done{};
}

}  // namespace

void addTrace(CLI::App& app, Action& action) {
  CLI::App& command =
      *app.add_subcommand("trace", "Print the connectivity of a compressed glTF file, one line per symbol");
  const auto input = std::make_shared<std::string>();
  command.add_option("input", *input, ".glb or .gltf")->required();
  addExamples(command, "  tutte trace model.glb | head\n  diff <(tutte trace a.glb) <(tutte trace b.glb)");
  command.callback([input, &action] { action = [input] { return traceFile(*input); }; });
}

}  // namespace tutte
