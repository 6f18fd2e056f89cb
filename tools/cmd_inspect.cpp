#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "codec/decode.h"
#include "codec/section.h"
#include "codec/spending.h"
#include "gltf_ext/asset_files.h"
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

Json classJson(std::string_view name, double bits, uint64_t decisions, double all_bits) {
  return {{"name", name}, {"bits", bits}, {"share", all_bits > 0 ? bits / all_bits : 0}, {"decisions", decisions}};
}

/// Where the section's bits go; the classes' bits are 8 times its bytes in sum.
Outcome<Json> classesOf(std::span<const uint8_t> section) {
  const Result<Spending> spending = spendingOf(section);
  if (!spending) return failureOf(spending.error(), "section CONNECTIVITY");
  const double all_bits = 8.0 * static_cast<double>(section.size());
  Json list = {classJson("head", spending->head_bits, 0, all_bits)};
  for (int i = 0; i < kTopicCount; ++i) {
    const auto topic = static_cast<Topic>(i);
    const TopicBits& bits = (*spending)[topic];
    if (bits.decisions > 0) list.push_back(classJson(nameOf(topic), bits.bits, bits.decisions, all_bits));
  }
  list.push_back(classJson("end", spending->end_bits, 0, all_bits));
  return list;
}

/// The attributes, with what they take; the section's first bytes belong to none.
Outcome<Json> attributesOf(const PayloadView& payload) {
  Json list = Json::array();
  if (!payload.has(Section::kAttributes)) return list;
  const Outcome<std::vector<Attribute>> attributes = describeAttributes(payload[Section::kAttributes]);
  if (!attributes) return attributes.error();
  const Outcome<std::vector<AttributeSize>> sizes = attributeSizesOf(payload);
  if (!sizes) return sizes.error();
  const Outcome<std::vector<AttributeCoding>> codings = describeCodings(payload[Section::kAttributes]);
  if (!codings) return codings.error();
  for (size_t i = 0; i < attributes->size(); ++i) {
    const Attribute& attribute = (*attributes)[i];
    list.push_back({{"name", attribute.name},
                    {"components", attribute.components},
                    {"type", typeName(attribute.type)},
                    {"normalized", attribute.normalized},
                    {"coding", nameOf((*codings)[i])},
                    {"bits", (*codings)[i].bits},
                    {"errorBound", errorBound((*codings)[i])},
                    {"bytes", (*sizes)[i].bytes()},
                    {"headBytes", (*sizes)[i].head_bytes},
                    {"planeBytes", (*sizes)[i].plane_bytes}});
  }
  return list;
}

Outcome<Json> describe(const PayloadBytes& payload) {
  const PayloadCounts& counts = payload.view.counts;
  const Result<Connectivity> connectivity = decode(payload.view[Section::kConnectivity]);
  if (!connectivity) return failureOf(connectivity.error(), "section CONNECTIVITY");
  Json out = {{"buffer", payload.range.buffer},
              {"byteOffset", payload.range.byte_offset},
              {"byteLength", payload.range.byte_length},
              {"vertices", counts.vertices},
              {"points", counts.points()},
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
    if (section == Section::kConnectivity) {
      Outcome<Json> classes = classesOf(payload.view[section]);
      if (!classes) return classes.error();
      entry["classes"] = *std::move(classes);
    }
    out["sections"].push_back(std::move(entry));
  }
  Outcome<Json> attributes = attributesOf(payload.view);
  if (!attributes) return attributes.error();
  out["attributes"] = *std::move(attributes);
  return out;
}

void printRow(const Json& payload, const std::string& name, const Json& entry) {
  const double bits = 8.0 * entry["bytes"].get<double>();
  const auto per = [&](const char* what) { return payload[what] == 0 ? 0.0 : bits / payload[what].get<double>(); };
  std::printf("  %-22s %12s %10.3f %10.3f %10.3f\n", name.c_str(), withCommas(entry["bytes"]).c_str(), per("vertices"),
              per("faces"), per("edges"));
}

void printClasses(const Json& section) {
  std::printf("  %-22s %12s %10s %10s %10s\n", "connectivity by class", "bits", "share", "decisions", "bits each");
  for (const Json& entry : section["classes"]) {
    const double bits = entry["bits"];
    const uint64_t decisions = entry["decisions"];
    std::printf("    %-20s %12.1f %8.2f %%", entry["name"].get<std::string>().c_str(), bits,
                100 * entry["share"].get<double>());
    if (decisions > 0)
      std::printf(" %10s %10.3f", withCommas(decisions).c_str(), bits / static_cast<double>(decisions));
    std::printf("\n");
  }
}

std::string describeType(const Json& attribute) {
  return attribute["type"].get<std::string>() + " x " + attribute["components"].dump() +
         (attribute["normalized"] == true ? ", normalised" : "") + ", " + attribute["coding"].get<std::string>() +
         (attribute["errorBound"] == 0.0 ? std::string(", exact")
                                         : formatted(", error up to %.3g", attribute["errorBound"].get<double>()));
}

void print(const Json& payload, size_t number) {
  std::printf("payload %zu: %s bytes at %s of buffer %s\n", number, withCommas(payload["byteLength"]).c_str(),
              withCommas(payload["byteOffset"]).c_str(), payload["buffer"].dump().c_str());
  for (const char* count : {"vertices", "points", "wedges", "faces", "corners", "edges", "triangles", "groups"}) {
    std::printf("  %-22s %12s\n", count, withCommas(payload[count]).c_str());
  }
  std::string choices = payload["connectivity"]["profile"];
  for (const char* choice : {"dual", "newestFirst", "match", "copies", "repairs"}) {
    if (payload["connectivity"][choice] == true) choices += std::string(" ") + choice;
  }
  std::printf("  %-22s %s\n", "connectivity coded as", choices.c_str());
  std::printf("  %-22s %12s %10s %10s %10s\n", "section", "bytes", "b/vertex", "b/face", "b/edge");
  for (const Json& section : payload["sections"]) printRow(payload, section["name"], section);
  for (const Json& section : payload["sections"]) {
    if (section.contains("classes")) printClasses(section);
  }
  if (payload["attributes"].empty()) return;
  std::printf("  %-22s %12s  %-44s %s\n", "attribute", "bytes", "type", "bytes per plane of values");
  for (const Json& attribute : payload["attributes"]) {
    std::printf("    %-20s %12s  %-44s", attribute["name"].get<std::string>().c_str(),
                withCommas(attribute["bytes"]).c_str(), describeType(attribute).c_str());
    for (const Json& bytes : attribute["planeBytes"]) std::printf(" %s", withCommas(bytes).c_str());
    std::printf("\n");
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
  addExamples(command,
              "  tutte inspect model.glb\n  tutte inspect --json model.glb\n\n"
              "Connectivity by class: head, one row per kind of symbol, and what ending at a whole byte costs or\n"
              "(negative) saves; in sum 8 times the section's bytes. In a dual, valences stand for degrees\n"
              "and degrees for valences. Sections are exact bytes. Vertices in one place may be coded as one point.");
  command.callback([input, as_json, &action] { action = [input, as_json] { return inspect(*input, *as_json); }; });
}

}  // namespace tutte
