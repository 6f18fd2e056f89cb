// The built command: exit codes, messages, files.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/scratch.h"

namespace tutte {
namespace {

/// A house: quads, a pentagon on both sides, an isolated vertex, texture coordinates with seams.
const char* const kHouse =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nv 0 0 4\nv 2 0 4\nv 2 2 4\nv 1 3 4\nv 0 2 4\nv 7 7 7\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 1\n"
    "usemtl wall\nf 5/1 4/2 3/3 2/4 1/5\nf 6/1 7/2 8/3 9/4 10/5\nf 1/1 2/2 7/3 6/4\nf 2/1 3/2 8/3 7/4\nusemtl roof\n"
    "f 3/1 4/2 9/3 8/4\nf 4/1 5/2 10/3 9/4\nf 5/1 1/2 6/3 10/4\n";

class Command : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return "'" + (scratch_ / name).string() + "'"; }
  Finished tutte(const std::string& arguments) const { return runTutte(scratch_, arguments); }

  void expectCode(const Finished& finished, int code) const {
    EXPECT_EQ(finished.code, code) << finished.out << finished.err;
    if (code == 0) return;
    // tutte: <file>: <place>: <what>; <remedy>
    EXPECT_TRUE(finished.err.starts_with("tutte: ")) << finished.err;
    EXPECT_NE(finished.err.find("; "), std::string::npos) << "no remedy: " << finished.err;
  }

  Scratch scratch_;
  std::string house_ = "'" + scratch_.write("house.obj", kHouse) + "'";
};

TEST_F(Command, HelpEverywhere) {
  const Finished all = tutte("--help");
  EXPECT_EQ(all.code, 0);
  for (const std::string name : {"encode", "decode", "inspect", "validate", "verify", "bench", "trace"}) {
    EXPECT_NE(all.out.find(name), std::string::npos);
    const Finished help = tutte(name + " --help");
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("Examples:"), std::string::npos) << help.out;
  }
  EXPECT_EQ(tutte("--version").code, 0);
}

TEST_F(Command, WrongUsageIsOne) {
  expectCode(tutte(""), 1);
  expectCode(tutte("frobnicate"), 1);
  expectCode(tutte("encode"), 1);
  expectCode(tutte("encode --qp 99 " + house_ + " " + path("a.glb")), 1);
  expectCode(tutte("encode --qp x " + house_ + " " + path("a.glb")), 1);
  expectCode(tutte("encode --polygons some " + house_ + " " + path("a.glb")), 1);
  expectCode(tutte("encode " + house_ + " " + path("a.obj")), 1);
  expectCode(tutte("verify --tolerance -1 " + house_ + " " + house_), 1);
  EXPECT_EQ(scratch_.fileCount(), 1u);
}

TEST_F(Command, InvalidInputIsTwo) {
  const std::string broken = "'" + scratch_.write("broken.obj", "v 0 0 0\nf 1 2 3\n") + "'";
  const Finished finished = tutte("encode " + broken + " " + path("a.glb"));
  expectCode(finished, 2);
  EXPECT_NE(finished.err.find("broken.obj: line 2: "), std::string::npos) << finished.err;
  const std::string text = "'" + scratch_.write("text.glb", "this is no glTF") + "'";
  expectCode(tutte("decode " + text + " " + path("a.obj")), 2);
  expectCode(tutte("inspect " + text), 2);
  expectCode(tutte("validate " + text), 2);
  expectCode(tutte("trace " + text), 2);
  expectCode(tutte("bench " + broken), 2);
  EXPECT_EQ(scratch_.fileCount(), 3u);
}

TEST_F(Command, UnsupportedInputIsThree) {
  const std::string plain = "'" + scratch_.write("plain.gltf", R"({"asset":{"version":"2.0"}})") + "'";
  expectCode(tutte("inspect " + plain), 3);
  expectCode(tutte("trace " + plain), 3);
}

TEST_F(Command, DifferencesAreFour) {
  const std::string other = "'" + scratch_.write("other.obj", std::string(kHouse) + "f 1 2 3\n") + "'";
  expectCode(tutte("verify " + house_ + " " + other), 4);
  expectCode(tutte("verify " + house_ + " " + house_), 0);
}

TEST_F(Command, FilesThatCannotBeReadOrWrittenAreFive) {
  expectCode(tutte("encode " + path("none.obj") + " " + path("a.glb")), 5);
  expectCode(tutte("decode " + path("none.glb") + " " + path("a.obj")), 5);
  expectCode(tutte("verify " + path("none.glb") + " " + house_), 5);
  const Finished finished = tutte("encode " + house_ + " " + path("house.obj/a.glb"));
  expectCode(finished, 5);
  EXPECT_NE(finished.err.find("house.obj/a.glb"), std::string::npos);
  EXPECT_EQ(scratch_.fileCount(), 1u);
}

TEST_F(Command, ThereAndBack) {
  expectCode(tutte("encode " + house_ + " " + path("house.glb")), 0);
  expectCode(tutte("validate " + path("house.glb")), 0);
  expectCode(tutte("verify " + house_ + " " + path("house.glb")), 0);
  for (const std::string name : {"back.obj", "back.ply"}) {
    expectCode(tutte("decode " + path("house.glb") + " " + path(name)), 0);
    expectCode(tutte("verify " + house_ + " " + path(name)), 0);
    expectCode(tutte("verify --qp 0 --qt 0 " + path("house.glb") + " " + path(name)), 0);
  }
  for (const std::string name : {"plain.glb", "plain.gltf"}) {
    expectCode(tutte("decode " + path("house.glb") + " " + path(name)), 0);
    expectCode(tutte("encode " + path(name) + " " + path("again.glb")), 0);
    expectCode(tutte("validate " + path("again.glb")), 0);
  }
}

TEST_F(Command, LosslessIsExact) {
  expectCode(tutte("encode --qp 0 --qt 0 --qn 0 --polygons both --fallback " + house_ + " " + path("house.gltf")), 0);
  expectCode(tutte("verify --qp 0 --qt 0 " + house_ + " " + path("house.gltf")), 0);
}

TEST_F(Command, LosslessIsToldByBits) {
  const std::string odd = "'" +
                          scratch_.write("odd.obj",
                                         "v 0.1 -0.0 1e-30\nv 1.23 0.01 0\nv 0.57 1.11 0.333\nv 7 8 9.125\n"
                                         "f 1 2 3\nf 1 2 4\n") +
                          "'";
  expectCode(tutte("encode --lossless " + odd + " " + path("odd.glb")), 0);
  const Finished same = tutte("verify --exact " + odd + " " + path("odd.glb"));
  expectCode(same, 0);
  EXPECT_NE(same.out.find("same bits"), std::string::npos) << same.out;
  expectCode(tutte("encode --qp 20 " + odd + " " + path("coarse.glb")), 0);
  expectCode(tutte("verify " + odd + " " + path("coarse.glb")), 0);
  expectCode(tutte("verify --exact " + odd + " " + path("coarse.glb")), 4);
  expectCode(tutte("encode --lossless --qp 12 " + odd + " " + path("a.glb")), 1);
  expectCode(tutte("encode --error 1mm --lossless " + odd + " " + path("a.glb")), 1);
}

TEST_F(Command, ErrorBoundsAreKeptAndTold) {
  for (const std::string bound : {"1mm", "0.1cm", "1000um", "0.001", "0.001m", "0.025%"}) {
    const Finished encoded = tutte("encode --error " + bound + ",TEXCOORD=0.01 " + house_ + " " + path("house.glb"));
    expectCode(encoded, 0);
    const Finished inspected = tutte("inspect --json " + path("house.glb"));
    const auto attributes = nlohmann::json::parse(inspected.out).at("payloads").at(0).at("attributes");
    EXPECT_LE(attributes.at(0).at("errorBound"), 0.00176) << bound;
    EXPECT_GE(attributes.at(0).at("errorBound"), 0.0009) << bound;
    EXPECT_LE(attributes.at(1).at("errorBound"), 0.01) << bound;
    const Finished verified = tutte("verify " + house_ + " " + path("house.glb"));
    expectCode(verified, 0);
    EXPECT_NE(verified.out.find("POSITION"), std::string::npos) << verified.out;
    EXPECT_NE(verified.out.find("largest error"), std::string::npos) << verified.out;
  }
  for (const std::string wrong : {"0", "-1mm", "1 parsec", "mm", "101%", "NORMAL=1", "TEXCOORD=1mm", "nan", "1e-12"}) {
    expectCode(tutte("encode '--error=" + wrong + "' " + house_ + " " + path("a.glb")), 1);
  }
}

TEST_F(Command, CoarserThanVerifiedIsDifferent) {
  const std::string bumpy =
      "'" + scratch_.write("bumpy.obj", "v 0 0 0\nv 1.23 0.01 0\nv 0.57 1.11 0.333\nf 1 2 3\n") + "'";
  expectCode(tutte("encode --qp 4 " + bumpy + " " + path("bumpy.glb")), 0);
  expectCode(tutte("verify " + bumpy + " " + path("bumpy.glb")), 0);  // the file says how coarse it is
  expectCode(tutte("verify --qp 14 " + bumpy + " " + path("bumpy.glb")), 4);
  expectCode(tutte("decode " + path("bumpy.glb") + " " + path("bumpy.ply")), 0);
  expectCode(tutte("verify " + bumpy + " " + path("bumpy.ply")), 4);
  expectCode(tutte("verify --qp 4 " + bumpy + " " + path("bumpy.ply")), 0);
}

TEST_F(Command, AttributesCanBeLeftOut) {
  expectCode(tutte("encode --attributes POSITION " + house_ + " " + path("house.glb")), 0);
  expectCode(tutte("verify " + house_ + " " + path("house.glb")), 4);
  expectCode(tutte("verify --attributes POSITION " + house_ + " " + path("house.glb")), 0);
}

/// All bytes of the section ATTRIBUTES belong to one of them, but for the first ones.
void expectAttributesFillTheirSection(const nlohmann::json& inspected) {
  const auto& payload = inspected.at("payloads").at(0);
  size_t section_bytes = 0, attribute_bytes = 0;
  for (const auto& section : payload.at("sections")) {
    if (section.at("name") == "ATTRIBUTES") section_bytes = section.at("bytes");
  }
  for (const auto& attribute : payload.at("attributes")) {
    attribute_bytes += attribute.at("bytes").get<size_t>();
    EXPECT_FALSE(attribute.at("planeBytes").empty());
  }
  EXPECT_GE(section_bytes, attribute_bytes + 2);
  EXPECT_LE(section_bytes, attribute_bytes + 3);
}

TEST_F(Command, InspectCountsEveryByte) {
  expectCode(tutte("encode " + house_ + " " + path("house.glb")), 0);
  const Finished finished = tutte("inspect --json " + path("house.glb"));
  expectCode(finished, 0);
  const auto json = nlohmann::json::parse(finished.out);
  const auto& payload = json.at("payloads").at(0);
  EXPECT_EQ(payload.at("vertices"), 11);
  EXPECT_EQ(payload.at("faces"), 7);
  EXPECT_EQ(payload.at("edges"), 15);
  EXPECT_EQ(payload.at("groups"), 2);
  EXPECT_EQ(payload.at("attributes").size(), 2u);
  size_t bytes = 0;
  for (const auto& section : payload.at("sections")) {
    bytes += section.at("bytes").get<size_t>();
    EXPECT_EQ(section.contains("classes"), section.at("name") == "CONNECTIVITY");
    if (!section.contains("classes")) continue;
    double bits = 0;
    for (const auto& entry : section.at("classes")) bits += entry.at("bits").get<double>();
    EXPECT_NEAR(bits, 8.0 * section.at("bytes").get<double>(), 1e-6);
  }
  EXPECT_EQ(bytes, payload.at("byteLength"));
  for (const std::string coder : {"draco", "tutte"}) {
    expectCode(tutte("encode --attribute-coder " + coder + " " + house_ + " " + path("house.glb")), 0);
    expectAttributesFillTheirSection(nlohmann::json::parse(tutte("inspect --json " + path("house.glb")).out));
  }
  EXPECT_NE(tutte("inspect " + path("house.glb")).out.find("CONNECTIVITY"), std::string::npos);
}

TEST_F(Command, TracePrintsALinePerSymbol) {
  expectCode(tutte("encode " + house_ + " " + path("house.glb")), 0);
  const Finished finished = tutte("trace " + path("house.glb"));
  expectCode(finished, 0);
  const bool dual = finished.out.find("dual") != std::string::npos;
  EXPECT_NE(finished.out.find(dual ? "valence 5" : "degree 5"), std::string::npos) << finished.out;
  EXPECT_NE(finished.out.find(dual ? "degree 3" : "valence 3"), std::string::npos) << finished.out;
  EXPECT_NE(finished.out.find("end"), std::string::npos);
}

TEST_F(Command, BenchHasEveryField) {
  const Finished finished = tutte("bench --json --seconds 0 " + house_);
  expectCode(finished, 0);
  const auto json = nlohmann::json::parse(finished.out);
  for (const char* field : {"file",
                            "vertices",
                            "faces",
                            "splits",
                            "connectivity_bytes",
                            "valence_bytes",
                            "degree_bytes",
                            "bits_per_vertex",
                            "attribute_bytes",
                            "total_bytes",
                            "encode_seconds",
                            "decode_seconds",
                            "connectivity_decode_seconds",
                            "decode_peak_bytes",
                            "draco_cl7",
                            "draco_cl10",
                            "draco_polygons_total_bytes",
                            "glb_bytes",
                            "paper_bytes",
                            "by_attribute",
                            "profiles"}) {
    EXPECT_TRUE(json.contains(field)) << field;
  }
  for (const char* draco : {"draco_cl7", "draco_cl10", "draco_connectivity"}) {
    for (const char* field :
         {"connectivity_bytes", "attribute_bytes", "total_bytes", "encode_seconds", "decode_seconds",
          "connectivity_decode_seconds", "decode_peak_bytes", "seam_bytes", "by_attribute"}) {
      EXPECT_TRUE(json.at(draco).contains(field)) << field;
    }
  }
  EXPECT_EQ(json.at("faces"), 7);
  EXPECT_EQ(json.at("profiles").size(), 4u);
  EXPECT_TRUE(json.at("by_attribute").contains("POSITION"));
  EXPECT_TRUE(json.at("draco_cl10").at("by_attribute").contains("POSITION"));
  const auto two = nlohmann::json::parse(tutte("bench --json --seconds 0 --profiles fast,small " + house_).out);
  EXPECT_EQ(two.at("profiles").size(), 2u);
  const Finished table = tutte("bench --seconds 0 --attributes POSITION " + house_);
  expectCode(table, 0);
  EXPECT_NE(table.out.find("sum"), std::string::npos);
}

TEST_F(Command, DamagedFilesAreRefused) {
  expectCode(tutte("encode " + house_ + " " + path("house.glb")), 0);
  std::string bytes = contentsOf(scratch_ / "house.glb");
  bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 0x10);
  scratch_.write("damaged.glb", bytes);
  const Finished finished = tutte("decode " + path("damaged.glb") + " " + path("back.obj"));
  expectCode(finished, 2);
  EXPECT_NE(finished.err.find("damaged.glb"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "back.obj"));
}

}  // namespace
}  // namespace tutte
