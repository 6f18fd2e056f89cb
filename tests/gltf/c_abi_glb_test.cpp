// Whole files through the C interface.

#include "gltf_ext/c_abi_glb.h"

#include <gtest/gtest.h>

#include <limits>

#include "gltf_ext/asset.h"
#include "gltf_ext/compress.h"
#include "gltf_ext/decompress.h"
#include "tests/gltf/assets.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

Bytes plainGlb() {
  const Outcome<Bytes> glb = toGlb(polygonAsset(shapes::dodecahedron()));
  EXPECT_TRUE(glb);
  return *glb;
}

/// What a handle holds; the handle is freed.
struct Taken {
  Bytes bytes;
  std::string text;
};

Taken take(tutte_file* file) {
  const uint8_t* const bytes = tutte_file_bytes(file);
  Taken taken{{bytes, bytes + tutte_file_size(file)}, tutte_file_text(file)};
  tutte_free_file(file);
  return taken;
}

TEST(CAbiGlb, CompressesAndDecompressesAsTheLibraryDoes) {
  const Bytes plain = plainGlb();
  tutte_compress_options options;
  tutte_default_options(&options);
  options.position_bits = 11;
  options.attribute_coder = 2;
  options.polygons = 3;
  tutte_file* file = nullptr;
  ASSERT_EQ(tutte_compress_glb(plain.data(), plain.size(), &options, &file), TUTTE_OK);
  const Taken compressed = take(file);
  CompressOptions same;
  same.pack.position_bits = 11;
  same.pack.attribute_coder = AttributeCoder::kTutte;
  same.polygons = PolygonOutput::kBoth;
  const Outcome<Compressed> expected = compress(*parseAsset(plain), same);
  ASSERT_TRUE(expected);
  EXPECT_EQ(compressed.bytes, *toGlb(expected->asset));
  EXPECT_EQ(compressed.text, "");
  ASSERT_EQ(tutte_decompress_glb(compressed.bytes.data(), compressed.bytes.size(), &file), TUTTE_OK);
  EXPECT_EQ(take(file).bytes, *toGlb(*decompress(expected->asset)));
}

// What the library and the C interface make of a file with the same options.
void expectSame(const tutte_compress_options& options, const CompressOptions& same) {
  const Bytes plain = plainGlb();
  tutte_file* file = nullptr;
  ASSERT_EQ(tutte_compress_glb(plain.data(), plain.size(), &options, &file), TUTTE_OK);
  const Outcome<Compressed> expected = compress(*parseAsset(plain), same);
  ASSERT_TRUE(expected);
  EXPECT_EQ(take(file).bytes, *toGlb(expected->asset));
}

TEST(CAbiGlb, KeepsErrorBounds) {
  tutte_compress_options options;
  tutte_default_options(&options);
  CompressOptions same;
  options.position_error = {0.003, 0};
  same.pack.errors.position = {0.003, false};
  expectSame(options, same);
  options.position_error = {0.001, 1};
  same.pack.errors.position = {0.001, true};
  expectSame(options, same);
}

TEST(CAbiGlb, KeepsEveryBitAndGridsPerMesh) {
  tutte_compress_options options;
  tutte_default_options(&options);
  CompressOptions same;
  options.grid = 1;
  same.grid = GridScope::kMesh;
  expectSame(options, same);
  options.lossless = 1;
  same.pack = withoutLoss(same.pack);
  expectSame(options, same);
}

TEST(CAbiGlb, RefusesHostileBounds) {
  const Bytes plain = plainGlb();
  tutte_compress_options usual;
  tutte_default_options(&usual);
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const tutte_error_bound wrong[] = {{-1, 0}, {infinity, 0}, {nan, 0}, {1, 1}, {nan, 1}, {0.5, 2}, {0.5, -1}};
  for (tutte_error_bound tutte_compress_options::*field :
       {&tutte_compress_options::position_error, &tutte_compress_options::texcoord_error,
        &tutte_compress_options::color_error, &tutte_compress_options::generic_error}) {
    for (const tutte_error_bound& bound : wrong) {
      tutte_compress_options options = usual;
      options.*field = bound;
      tutte_file* file = nullptr;
      EXPECT_EQ(tutte_compress_glb(plain.data(), plain.size(), &options, &file), TUTTE_INVALID_ARGUMENT);
      EXPECT_EQ(file, nullptr);
    }
    for (const double size : {5e-324, 1e-30, 1e30, std::numeric_limits<double>::max()}) {
      tutte_compress_options options = usual;
      options.*field = {size, 0};
      tutte_file* file = nullptr;
      (void)tutte_compress_glb(plain.data(), plain.size(), &options, &file);  // whatever comes of it, it comes back
      EXPECT_NE(file, nullptr);
      tutte_free_file(file);
      options.lossless = 1;
      EXPECT_EQ(tutte_compress_glb(plain.data(), plain.size(), &options, &file), TUTTE_INVALID_ARGUMENT);
    }
  }
}

TEST(CAbiGlb, SaysWhatIsWrongAndWhere) {
  const std::string text = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "a.bin"}]})";
  const auto* const bytes = reinterpret_cast<const uint8_t*>(text.data());
  tutte_file* file = nullptr;
  EXPECT_EQ(tutte_compress_glb(bytes, text.size(), nullptr, &file), TUTTE_UNSUPPORTED);
  EXPECT_EQ(take(file).text.substr(0, 14), "/buffers/0/uri");
  EXPECT_EQ(tutte_decompress_glb(bytes, 3, &file), TUTTE_MALFORMED);
  EXPECT_TRUE(take(file).bytes.empty());
}

TEST(CAbiGlb, SurvivesHostileArguments) {
  const Bytes plain = plainGlb();
  tutte_file* file = nullptr;
  EXPECT_EQ(tutte_compress_glb(nullptr, 4, nullptr, &file), TUTTE_INVALID_ARGUMENT);
  EXPECT_EQ(tutte_compress_glb(plain.data(), plain.size(), nullptr, nullptr), TUTTE_INVALID_ARGUMENT);
  EXPECT_EQ(tutte_decompress_glb(plain.data(), SIZE_MAX, &file), TUTTE_INVALID_ARGUMENT);
  EXPECT_EQ(tutte_decompress_glb(plain.data(), plain.size(), nullptr), TUTTE_INVALID_ARGUMENT);
  tutte_compress_options usual;
  tutte_default_options(&usual);
  for (int32_t tutte_compress_options::*field :
       {&tutte_compress_options::position_bits, &tutte_compress_options::generic_bits,
        &tutte_compress_options::attribute_coder, &tutte_compress_options::profile, &tutte_compress_options::effort,
        &tutte_compress_options::polygons, &tutte_compress_options::fallback, &tutte_compress_options::grid,
        &tutte_compress_options::lossless}) {
    for (const int32_t value : {-2, 99}) {
      tutte_compress_options options = usual;
      options.*field = value;
      EXPECT_EQ(tutte_compress_glb(plain.data(), plain.size(), &options, &file), TUTTE_INVALID_ARGUMENT);
      EXPECT_EQ(file, nullptr);
    }
  }
  tutte_default_options(nullptr);
  tutte_free_file(nullptr);
  EXPECT_EQ(tutte_file_bytes(nullptr), nullptr);
  EXPECT_EQ(tutte_file_size(nullptr), 0u);
  EXPECT_STRNE(tutte_file_text(nullptr), "");
}

TEST(CAbiGlb, EveryPrefixIsRefused) {
  const Bytes plain = plainGlb();
  for (size_t size = 0; size < plain.size(); ++size) {
    tutte_file* file = nullptr;
    EXPECT_LT(tutte_compress_glb(plain.data(), size, nullptr, &file), 0) << size;
    tutte_free_file(file);
  }
}

}  // namespace
}  // namespace tutte
