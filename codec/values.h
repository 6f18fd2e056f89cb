#pragma once
// Attribute values over a mesh: whole numbers in, bytes out, and back.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codec/bytes.h"
#include "codec/result.h"
#include "codec/value_graph.h"

namespace tutte {

/// How much time is spent on size: the number of statistics that are mixed. Part of the format.
enum class ValueProfile : uint8_t {
  kFast = 0,     ///< one context, no tangent planes
  kDefault = 1,  ///< two, averaged
  kSmall = 2,    ///< eight, mixed
};

/// What the values stand for, which decides about their prediction. Part of the format.
enum class ValueKind : uint8_t {
  kPlain = 0,      ///< anything
  kPoints = 1,     ///< three components are points of a surface: corrected towards its tangent plane. max < 2^20
  kTexcoord = 2,   ///< two components are places in a texture that lies on the surface. max < 2^18
  kDirection = 3,  ///< two components are points of an unfolded octahedron. max is even, twice its centre
  kLabel = 4,      ///< all components together are one of at most 4096 names
  kAngular = 5,    ///< points of a surface of triangles whose angles are as the valences let expect (value_angles.h)
};

/// What the values are, besides the numbers.
struct ValueFormat {
  int components = 3;  ///< 1 to 4
  int32_t max = 0;     ///< values are 0 to max, below 2^27
  ValueProfile profile = ValueProfile::kDefault;
  ValueKind kind = ValueKind::kPlain;
  bool ranked = false;    ///< (kPlain, kPoints) each component is one of a list: their ranks are coded
  bool echoes = false;    ///< (not kLabel) values may be those of earlier sites
  bool copies = false;    ///< (not kLabel) components that repeat earlier ones are predicted from these
  int8_t weighting = -1;  ///< (kDirection, for encoders) what findWeighting() told; below 0: it is asked
  bool operator==(const ValueFormat&) const = default;
};

/// A mesh's sites, and where they are.
struct ValueSites {
  const ValueGraph& graph;
  std::span<const int32_t> places;  ///< three numbers below 2^20 per site: where it is. kTexcoord needs them,
                                    ///< kDirection is better with them, others do not look at them; may be empty
};

/// True when values of this format can be coded at these sites.
bool supports(const ValueSites& sites, const ValueFormat& format);

/// Appends the values, `components` per site in the order of site numbers. False, and nothing is appended, when the
/// format is not supported, or has lists that would be too long to be worth it.
bool encodeValues(const ValueSites& sites, const ValueFormat& format, std::span<const int32_t> values, ByteWriter& out);

/// What encodeValues() would make.
struct ValueEstimate {
  size_t size;                 ///< so many bytes, or as many as a part of the sites lets expect
  std::vector<uint8_t> bytes;  ///< these; empty when it was only a part
};

/// Told from the first `most` sites in encodeValues()'s order; nothing when that would fail.
std::optional<ValueEstimate> estimateValues(const ValueSites& sites, const ValueFormat& format,
                                            std::span<const int32_t> values, Index most);

/// How the surface's normals are best made for directions: ValueFormat::weighting. O(corners), three times.
int8_t findWeighting(const ValueSites& sites, const ValueFormat& format, std::span<const int32_t> directions);

/// The values of any bytes, each within [0, max], or an error (kTruncated, kMalformed). All of `bytes` must be used.
Result<std::vector<int32_t>> decodeValues(const ValueSites& sites, const ValueFormat& format,
                                          std::span<const uint8_t> bytes);

}  // namespace tutte
