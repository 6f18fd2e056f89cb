#pragma once
// Which group each face belongs to (a glTF primitive: a material), and which faces are holes in which.

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// Codes the group of each face of `mesh`, below `group_count`. Faces next to each other tend to share their group:
/// inside a patch a face costs next to nothing.
std::vector<uint8_t> encodeGroups(const Connectivity& mesh, std::span<const Index> groups, Index group_count);

/// Any bytes may be passed, group_count >= 1. Errors: kTruncated, kTrailingBytes.
Result<std::vector<Index>> decodeGroups(const Connectivity& mesh, std::span<const uint8_t> bytes, Index group_count);

/// Codes ring owners: per face kNone, or for an interior ring the face that is its exterior ring.
std::vector<uint8_t> encodeRings(std::span<const Index> ring_owners);

/// Any bytes may be passed. Every owner in the result is a face that is no interior ring itself. Errors: kMalformed,
/// kTruncated, kTrailingBytes.
Result<std::vector<Index>> decodeRings(std::span<const uint8_t> bytes, Index face_count);

/// True when every owner is a face that is no interior ring itself, and, if there are groups, of the ring's group.
bool ringsAreValid(std::span<const Index> ring_owners, std::span<const Index> groups);

}  // namespace tutte
