#include "gltf_ext/c_abi_glb.h"

#include <limits>
#include <new>
#include <string>
#include <utility>

#include "codec/c_abi_mesh.h"
#include "gltf_ext/asset.h"
#include "gltf_ext/compress.h"
#include "gltf_ext/decompress.h"
#include "gltf_ext/guard.h"

using namespace tutte;

/// A GLB and the warnings, or a sentence that says why there is none.
struct tutte_file {
  Bytes bytes;
  std::string text;
};

namespace {

std::string textOf(const Failure& failure) {
  return failure.where.empty() ? failure.what : failure.where + ": " + failure.what;
}

bool isBetween(int32_t value, int32_t least, int32_t most) { return value >= least && value <= most; }

bool isValid(const tutte_error_bound& bound) {
  return isBetween(bound.relative, 0, 1) && bound.size >= 0 &&
         bound.size < (bound.relative ? 1 : std::numeric_limits<double>::infinity());
}

bool hasValidBounds(const tutte_compress_options& options) {
  for (const tutte_error_bound& bound :
       {options.position_error, options.texcoord_error, options.color_error, options.generic_error}) {
    if (!isValid(bound) || (options.lossless != 0 && bound.size > 0)) return false;
  }
  return true;
}

bool isValid(const tutte_compress_options& options) {
  for (const int32_t bits :
       {options.position_bits, options.normal_bits, options.texcoord_bits, options.color_bits, options.generic_bits}) {
    if (!isBetween(bits, 0, 24)) return false;
  }
  return options.normal_bits != 1 && isBetween(options.attribute_coder, 0, 2) && isBetween(options.profile, -1, 3) &&
         isBetween(options.effort, 0, 3) && isBetween(options.polygons, 0, 3) && isBetween(options.fallback, 0, 1) &&
         isBetween(options.grid, 0, 1) && isBetween(options.lossless, 0, 1) && hasValidBounds(options);
}

// In the order of the numbers in the interface.
constexpr AttributeCoder kCoders[] = {AttributeCoder::kAuto, AttributeCoder::kDraco, AttributeCoder::kTutte};
constexpr GridScope kGrids[] = {GridScope::kFile, GridScope::kMesh};
constexpr PolygonOutput kPolygons[] = {PolygonOutput::kAuto, PolygonOutput::kFb, PolygonOutput::kExt,
                                       PolygonOutput::kBoth};

ErrorBound boundFrom(const tutte_error_bound& bound) { return {bound.size, bound.relative != 0}; }

CompressOptions optionsFrom(const tutte_compress_options& options) {
  CompressOptions result;
  result.pack.position_bits = options.position_bits;
  result.pack.normal_bits = options.normal_bits;
  result.pack.texcoord_bits = options.texcoord_bits;
  result.pack.color_bits = options.color_bits;
  result.pack.generic_bits = options.generic_bits;
  result.pack.attribute_coder = kCoders[options.attribute_coder];
  if (options.profile >= 0) result.pack.connectivity.profile = static_cast<Profile>(options.profile);
  result.pack.connectivity.effort = options.effort;
  result.pack.errors = {boundFrom(options.position_error), boundFrom(options.texcoord_error),
                        boundFrom(options.color_error), boundFrom(options.generic_error)};
  if (options.lossless != 0) result.pack = withoutLoss(result.pack);
  result.grid = kGrids[options.grid];
  result.polygons = kPolygons[options.polygons];
  result.fallback = options.fallback != 0;
  return result;
}

Outcome<tutte_file> compressed(std::span<const uint8_t> input, const CompressOptions& options) {
  const Outcome<Asset> asset = parseAsset(input);
  if (!asset) return asset.error();
  const Outcome<Compressed> result = compress(*asset, options);
  if (!result) return result.error();
  auto glb = toGlb(result->asset);
  if (!glb) return glb.error();
  tutte_file made{*std::move(glb), ""};
  for (const Failure& warning : result->report.warnings) made.text += textOf(warning) + "\n";
  return made;
}

Outcome<tutte_file> decompressed(std::span<const uint8_t> input) {
  const Outcome<Asset> asset = parseAsset(input);
  if (!asset) return asset.error();
  const Outcome<Asset> plain = decompress(*asset);
  if (!plain) return plain.error();
  auto glb = toGlb(*plain);
  if (!glb) return glb.error();
  return tutte_file{*std::move(glb), ""};
}

int32_t statusOf(FailureKind kind) {
  switch (kind) {
    case FailureKind::kUsage: return TUTTE_INVALID_ARGUMENT;
    case FailureKind::kInvalid: return TUTTE_MALFORMED;
    default: return TUTTE_UNSUPPORTED;
  }
}

/// Runs `make` and puts what it gives into *file.
template <class Make>
int32_t deliver(tutte_file** file, Make make) {
  const auto work = [&]() -> int32_t {
    Outcome<tutte_file> made = make();
    const int32_t status = made ? TUTTE_OK : statusOf(made.error().kind);
    *file = new (std::nothrow) tutte_file(made ? *std::move(made) : tutte_file{{}, textOf(made.error())});
    return *file ? status : TUTTE_OUT_OF_MEMORY;
  };
  return caught(work, [](const Thrown&) -> int32_t { return TUTTE_OUT_OF_MEMORY; });
}

}  // namespace

void tutte_default_options(tutte_compress_options* options) {
  if (options == nullptr) return;
  const PackOptions usual;
  *options = {};
  options->position_bits = usual.position_bits;
  options->normal_bits = usual.normal_bits;
  options->texcoord_bits = usual.texcoord_bits;
  options->color_bits = usual.color_bits;
  options->generic_bits = usual.generic_bits;
  options->profile = -1;
  options->effort = usual.connectivity.effort;
}

int32_t tutte_compress_glb(const uint8_t* bytes, size_t size, const tutte_compress_options* options,
                           tutte_file** file) {
  if (file == nullptr) return TUTTE_INVALID_ARGUMENT;
  *file = nullptr;
  tutte_compress_options chosen;
  tutte_default_options(&chosen);
  if (options != nullptr) chosen = *options;
  if (!isSpan(bytes, size, 1) || !isValid(chosen)) return TUTTE_INVALID_ARGUMENT;
  return deliver(file, [&] { return compressed({bytes, size}, optionsFrom(chosen)); });
}

int32_t tutte_decompress_glb(const uint8_t* bytes, size_t size, tutte_file** file) {
  if (file == nullptr) return TUTTE_INVALID_ARGUMENT;
  *file = nullptr;
  if (!isSpan(bytes, size, 1)) return TUTTE_INVALID_ARGUMENT;
  return deliver(file, [&] { return decompressed({bytes, size}); });
}

const uint8_t* tutte_file_bytes(const tutte_file* file) { return file ? file->bytes.data() : nullptr; }

size_t tutte_file_size(const tutte_file* file) { return file ? file->bytes.size() : 0; }

const char* tutte_file_text(const tutte_file* file) { return file ? file->text.c_str() : "out of memory"; }

void tutte_free_file(tutte_file* file) { delete file; }
