#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "codec/decode.h"
#include "codec/section.h"
#include "gltf_ext/attributes.h"
#include "tools/command.h"
#include "tools/payloads.h"

namespace tutte {
namespace {

using Json = nlohmann::json;

const char* typeName(ComponentType type) {
  switch (type) {
    case ComponentType::kInt8: return "int8";
    case ComponentType::kUint8: return "uint8";
    case ComponentType::kInt16: return "int16";
    case ComponentType::kUint16: return "uint16";
    case ComponentType::kUint32: return "uint32";
    case ComponentType::kFloat: return "float";
  }
  return "unknown";
}

/// Edges with one face count as one, like those with two.
size_t edgesOf(const Connectivity& connectivity) {
  size_t paired = 0;
  for (Index twin : connectivity.twins) paired += twin != kNone;
  return connectivity.twins.size() - paired / 2;
}

Json sectionJson(const char* name, size_t bytes) { return {{"name", name}, {"bytes", bytes}}; }

/// The streams inside the connectivity section.
Json streamsOf(std::span<const uint8_t> section) {
  SectionHeader header;
  const Result<SectionStreams> streams = readSection(section, header);
  if (!streams) return Json::array();
  Json list = Json::array();
  const size_t parts = streams->valences.size() + streams->degrees.size();
  list.push_back(sectionJson("header", section.size() - parts));
  list.push_back(sectionJson("valences", streams->valences.size()));
  list.push_back(sectionJson("degrees", streams->degrees.size()));
  return list;
}

/// What the encoder chose, as the head of the connectivity section says it.
Json choicesOf(std::span<const uint8_t> section) {
  static constexpr const char* kProfiles[] = {"paper", "fast", "default", "small"};
  SectionHeader header;
  if (!readSection(section, header)) return Json::object();
  return {{"profile", kProfiles[static_cast<int>(header.profile)]},
          {"dual", header.dual},
          {"newestFirst", header.tie == TieRule::kNewestFirst},
          {"match", header.match},
          {"copies", header.copies},
          {"repairs", header.repairs}};
}

Outcome<Json> describe(const PayloadBytes& payload) {
  const PayloadCounts& counts = payload.view.counts;
  const Result<Connectivity> connectivity = decode(payload.view[Section::kConnectivity]);
  if (!connectivity) return failureOf(connectivity.error(), "section CONNECTIVITY");
  Json out = {{"buffer", payload.range.buffer},
              {"byteOffset", payload.range.byte_offset},
              {"byteLength", payload.range.byte_length},
              {"vertices", counts.vertices},
              {"wedges", counts.wedges},
              {"faces", counts.faces},
              {"corners", counts.corners},
              {"triangles", counts.triangles},
              {"groups", counts.groups},
              {"edges", edgesOf(*connectivity)}};
  out["connectivity"] = choicesOf(payload.view[Section::kConnectivity]);
  out["sections"] = {sectionJson("header", payload.view.header_bytes)};
  for (int i = 0; i < kSectionCount; ++i) {
    const auto section = static_cast<Section>(i);
    if (!payload.view.has(section)) continue;
    Json entry = sectionJson(std::string(nameOf(section)).c_str(), payload.view[section].size());
    if (section == Section::kConnectivity) entry["streams"] = streamsOf(payload.view[section]);
    out["sections"].push_back(std::move(entry));
  }
  out["attributes"] = Json::array();
  if (!payload.view.has(Section::kAttributes)) return out;
  const Outcome<std::vector<Attribute>> attributes = describeAttributes(payload.view[Section::kAttributes]);
  if (!attributes) return attributes.error();
  for (const Attribute& attribute : *attributes) {
    out["attributes"].push_back({{"name", attribute.name},
                                 {"components", attribute.components},
                                 {"type", typeName(attribute.type)},
                                 {"normalized", attribute.normalized}});
  }
  return out;
}

void printRow(const Json& payload, const std::string& name, const Json& entry) {
  const double bits = 8.0 * entry["bytes"].get<double>();
  const auto per = [&](const char* what) { return payload[what] == 0 ? 0.0 : bits / payload[what].get<double>(); };
  std::printf("  %-22s %12s %10.3f %10.3f %10.3f\n", name.c_str(), withCommas(entry["bytes"]).c_str(), per("vertices"),
              per("faces"), per("edges"));
}

void print(const Json& payload, size_t number) {
  std::printf("payload %zu: %s bytes at %s of buffer %s\n", number, withCommas(payload["byteLength"]).c_str(),
              withCommas(payload["byteOffset"]).c_str(), payload["buffer"].dump().c_str());
  for (const char* count : {"vertices", "wedges", "faces", "corners", "edges", "triangles", "groups"}) {
    std::printf("  %-22s %12s\n", count, withCommas(payload[count]).c_str());
  }
  std::string choices = payload["connectivity"]["profile"];
  for (const char* choice : {"dual", "newestFirst", "match", "copies", "repairs"}) {
    if (payload["connectivity"][choice] == true) choices += std::string(" ") + choice;
  }
  std::printf("  %-22s %s\n", "connectivity coded as", choices.c_str());
  std::printf("  %-22s %12s %10s %10s %10s\n", "section", "bytes", "b/vertex", "b/face", "b/edge");
  for (const Json& section : payload["sections"]) {
    printRow(payload, section["name"], section);
    if (!section.contains("streams")) continue;
    for (const Json& stream : section["streams"]) {
      printRow(payload, "  " + stream["name"].get<std::string>(), stream);
    }
  }
  for (const Json& attribute : payload["attributes"]) {
    std::printf("  %-22s %8s x %s%s\n", attribute["name"].get<std::string>().c_str(),
                attribute["type"].get<std::string>().c_str(), attribute["components"].dump().c_str(),
                attribute["normalized"] == true ? ", normalised" : "");
  }
}

Outcome<Done> inspect(const std::string& input, bool as_json) {
  const Outcome<Asset> asset = loadAsset(input);
  if (!asset) return inFile(asset.error(), input);
  const Outcome<std::vector<PayloadBytes>> payloads = payloadsOf(*asset);
  if (!payloads) return inFile(payloads.error(), input);
  Json all = {{"file", input}, {"payloads", Json::array()}};
  for (const PayloadBytes& payload : *payloads) {
    Outcome<Json> described = describe(payload);
    if (!described) return inFile(described.error(), input);
    if (!as_json) print(*described, all["payloads"].size());
    all["payloads"].push_back(*std::move(described));
  }
  if (as_json) std::printf("%s\n", all.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  return Done{};
}

}  // namespace

void addInspect(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("inspect", "Show what the payloads of a compressed glTF file consist of");
  const auto input = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  command.add_option("input", *input, ".glb or .gltf")->required();
  command.add_flag("--json", *as_json, "print one JSON object");
  addExamples(command, "  tutte inspect model.glb\n  tutte inspect --json model.glb");
  command.callback([input, as_json, &action] { action = [input, as_json] { return inspect(*input, *as_json); }; });
}

}  // namespace tutte
