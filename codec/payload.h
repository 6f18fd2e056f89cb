#pragma once
// The container of a payload: counts, a table of sections, the sections. It knows nothing of what is in them.
//
//   magic "TUTT", version (1 byte, 0)
//   varint  flags: bit s (0..5) section s is present, bit 6 the triangle count is stored, bit 7 the mesh is welded
//   varint  vertices
//   varint  welded - 1                            only with flag bit 7; otherwise 0 are welded
//   varint  wedges - vertices                     only with section SEAMS
//   varint  faces
//   varint  corners
//   varint  triangles                             only with flag bit 6; otherwise corners - 2 * faces
//   varint  groups - 1                            only with section GROUPS; otherwise 1 group
//   varint  attributes - 1                        only with section ATTRIBUTES; otherwise none
//   per present section, in order of its number: varint length, CRC-32 (4 bytes, little-endian)
//   the sections' bytes back to back, and nothing after
//
// A section's CRC-32 runs over the header up to here without the table of sections' checksums (magic to counts, then
// the lengths), and then over the section's own bytes: so the header is guarded as well, without a checksum of its own.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

enum class Section : uint8_t {
  kConnectivity = 0,  ///< bytes of encode(); always present
  kSeams = 1,   ///< wedges, and which attributes differ between them; absent when each vertex is its own wedge and none
                ///< welded
  kGroups = 2,  ///< the group of each face; absent when there is one group
  kRings = 3,   ///< interior rings of polygons; absent when there are none
  kTriangulation = 4,  ///< triangles of the polygons; absent when every polygon is a fan from its first corner
  kAttributes = 5,     ///< attribute values; its first byte says which coder made it
};
inline constexpr int kSectionCount = 6;

/// More attributes than a mesh of glTF has in practice; a payload that claims more is refused.
inline constexpr Index kMaxAttributes = 1024;

/// The section's name in reports and in the specification, such as "CONNECTIVITY".
std::string_view nameOf(Section section);

/// What a payload says about its mesh before anything is decoded. Claims, until unpack() has verified them.
struct PayloadCounts {
  Index vertices = 0;
  Index wedges = 0;  ///< >= vertices
  Index faces = 0;   ///< interior rings are faces
  Index corners = 0;
  Index triangles = 0;
  Index groups = 1;      ///< <= max(1, faces)
  Index attributes = 0;  ///< <= kMaxAttributes
  /// By how many the connectivity has fewer vertices (points, in a welded mesh) than the mesh: < max(1, vertices). The
  /// section SEAMS tells them apart.
  Index welded = 0;

  Index points() const { return vertices - welded; }
  bool operator==(const PayloadCounts&) const = default;
};

/// A payload whose header is valid and whose checksums are right.
struct PayloadView {
  PayloadCounts counts;
  std::array<std::span<const uint8_t>, kSectionCount> sections;  ///< bytes of each section
  std::array<bool, kSectionCount> present{};
  uint32_t header_bytes = 0;  ///< everything in front of the first section

  std::span<const uint8_t> operator[](Section section) const { return sections[static_cast<size_t>(section)]; }
  bool has(Section section) const { return present[static_cast<size_t>(section)]; }
};

/// Splits a payload into its sections, in O(bytes) and without allocating. Any bytes may be passed. Errors:
/// kTruncated, kMalformed (no magic, a reserved flag, a varint that is too long, impossible counts),
/// kUnsupportedVersion, kMissingSection, kTrailingBytes, kChecksum (any damage that leaves the header readable).
Result<PayloadView> parsePayload(std::span<const uint8_t> bytes);

/// Only the counts, for checks against glTF JSON; no checksum is verified and no section looked at.
Result<PayloadCounts> peekCounts(std::span<const uint8_t> bytes);

/// Sections that are to be stored, each present if it is in use.
struct PayloadParts {
  PayloadCounts counts;
  std::array<std::vector<uint8_t>, kSectionCount> sections;
  std::array<bool, kSectionCount> present{};

  void set(Section section, std::vector<uint8_t> bytes) {
    sections[static_cast<size_t>(section)] = std::move(bytes);
    present[static_cast<size_t>(section)] = true;
  }
};

/// The payload of `parts`. Counts that belong to an absent section must have their default.
std::vector<uint8_t> writePayload(const PayloadParts& parts);

}  // namespace tutte
