#pragma once
// How one attribute becomes whole numbers, and back. Free of Draco, so that the formulas stand in one place.
//
// Decoded values are exact functions of the coded numbers; they use double precision with one operation after the
// other and one final rounding to float, so every platform makes the same bits.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codec/bytes.h"
#include "codec/numeral_values.h"
#include "gltf_ext/attribute_name.h"
#include "gltf_ext/pack.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

inline constexpr int kMaxBits = 24;      ///< of kQuantised, kOctahedral..., kGrid: what a float holds
inline constexpr int kMaxWordBits = 27;  ///< of kWords and kFractions: sums of a few still fit 32 bits

/// The numbers are part of the format.
enum class CodingKind : uint8_t {
  kConstant = 0,          ///< all wedges have `constant`
  kQuantised = 1,         ///< float(origin[c] + q * range / (2^bits - 1)), operations from the right
  kOctahedral = 2,        ///< pointToVector() of two numbers (octahedron.h)
  kOctahedralSigned = 3,  ///< the same, and a fourth component of -1 or 1
  kWords = 4,             ///< an order-preserving word per component (wordOf()), less `base`
  kSplitWords = 5,        ///< words in two halves: upper 16 bits, lower 16 bits
  kFractions = 6,         ///< float(k / denominator) for the integer k = q + base - 2^31
  kNumerals = 7,          ///< floats without loss, digit by digit (codec/numeral_values.h); no planes
  kPalette = 8,           ///< floats of a list per component, by their place in it
  kGrid = 9,              ///< float(origin[c] + (base[c] + q) * step), operations from the right
};

/// Everything that the values need besides the numbers themselves.
struct AttributeCoding {
  CodingKind kind = CodingKind::kConstant;
  int bits = 0;                    ///< kQuantised: 1 to 24; kOctahedral...: 2 to 24; kGrid: 0 to 24
  std::array<float, 4> origin{};   ///< kQuantised: the least value, per component; kGrid: a point of the grid
  float range = 0;                 ///< kQuantised: the largest extent of a component
  uint8_t signs = 0;               ///< kOctahedralSigned: 0 all -1, 1 all 1, 2 mixed
  uint32_t base = 0;               ///< kWords, kFractions
  uint32_t denominator = 1;        ///< kFractions
  bool summed = false;             ///< kWords, kFractions: the first component is what the others leave of `total`
  uint32_t total = 0;              ///< if summed: of the words; of the numerators k, modulo 2^32 a signed number
  std::vector<uint8_t> constant;   ///< kConstant: one value
  NumeralFormat numerals;          ///< kNumerals
  float step = 0;                  ///< kGrid
  std::array<int32_t, 4> first{};  ///< kGrid: what the numbers count from
  std::vector<std::vector<uint32_t>> palette;  ///< kPalette: per component its words (wordOf()), ascending
};

/// What a plane's numbers are like, which decides about their prediction.
enum class PlaneKind : uint8_t {
  kPosition,   ///< the parent that texture coordinates and normals are predicted from; always plane 0
  kSmooth,     ///< neighbours have similar values
  kTexcoord,   ///< predicted from positions
  kNormal,     ///< octahedral, predicted from positions
  kDirection,  ///< octahedral, not predicted from positions
  kLabel,      ///< anything
};

/// Whole numbers in [0, max], `components` per wedge.
struct Plane {
  PlaneKind kind = PlaneKind::kSmooth;
  size_t attribute = 0;  ///< whose numbers
  uint8_t components = 1;
  int32_t max = 0;
  std::vector<int32_t> values;
  uint32_t coded_bytes = 0;  ///< once decoded: what the plane took of the stream

  bool octahedral() const { return kind == PlaneKind::kNormal || kind == PlaneKind::kDirection; }
};

/// The bits that the options give to a float attribute; 0: none, it is kept without loss.
int quantisationBits(const AttributeName& name, const PackOptions& options);

/// All floats by their place in a list, if that is not much longer than it is worth: at most 4096 per component.
std::optional<AttributeCoding> paletteCoding(const Attribute& attribute);

/// How far a component of a decoded value may be from the original; 0 for codings without loss.
double errorBound(const AttributeCoding& coding);

/// What `inspect` calls it.
std::string nameOf(const AttributeCoding& coding);

/// The coding that the options ask for:
/// - one value everywhere: kConstant;
/// - integers: words;
/// - words and fractions of WEIGHTS and custom attributes whose components have one sum everywhere: summed;
/// - floats of JOINTS and WEIGHTS, of attributes with 0 bits, and those that are not finite: without loss, as fractions
///   of 1, 255 or 65535 if all of them are, or of a power of ten, otherwise as numerals. (If Draco is to code them, as
///   fractions of the former or words.) Other floats are such fractions too, when that costs no more bits;
/// - NORMAL of unit vectors (to 2^-bits): octahedral; otherwise quantised;
/// - TANGENT of unit vectors with signs: octahedral with signs; otherwise without loss, as rounding would make it
/// invalid;
/// - POSITION, also of morph targets, where the options have a grid: on this grid (morph targets on the one through 0);
/// - other floats: quantised.
///
/// No component is off by more than errorBound(): half a step, when quantised (and what rounding to float adds: 2^-24
/// of its size), 3 / octahedronCentre(bits) when octahedral. All else is exact.
AttributeCoding chooseCoding(const Attribute& attribute, const PackOptions& options);

/// The planes of an attribute, without values. None for kConstant and kNumerals.
std::vector<Plane> planesOf(const Attribute& attribute, const AttributeCoding& coding, size_t index);

/// Fills the planes from the attribute's data; does nothing where there are none.
void splitValues(const Attribute& attribute, const AttributeCoding& coding, std::span<Plane> planes);

/// The attribute's data from its planes (that of kNumerals is left alone); false when a number is outside its plane's
/// range or the attribute's type.
bool joinValues(std::span<const Plane> planes, const AttributeCoding& coding, Index wedge_count, Attribute& attribute);

/// True when the fields of a coding are within their limits, and no number of its planes becomes an infinite float.
bool isValid(const AttributeCoding& coding, const Attribute& attribute);

void writeCoding(const AttributeCoding& coding, const Attribute& attribute, ByteWriter& out);

/// Nothing when the bytes are no coding of such an attribute.
std::optional<AttributeCoding> readCoding(ByteReader& in, const Attribute& attribute);

}  // namespace tutte
