#include "codec/face_groups.h"

#include <array>

#include "codec/model.h"
#include "codec/range_coder.h"

namespace tutte {
namespace {

/// The two likeliest groups of a face. They differ, unless there is one group only.
struct Guess {
  Index first = 0;
  Index second = 0;
  int support = 0;    ///< faces around that speak for the first, up to 3
  bool torn = false;  ///< another face around speaks for the second
};

/// Codes groups face by face: is it the group that the coded faces around have; is it the second guess; which else.
template <class Port>
class GroupScript {
 public:
  GroupScript(Port& port, const Connectivity& mesh, Index group_count)
      : port_(port), mesh_(mesh), group_count_(group_count), face_of_(mesh.twins.size()) {
    Index corner = 0;
    for (Index face = 0; face < mesh.face_degrees.size(); ++face) {
      for (Index i = 0; i < mesh.face_degrees[face]; ++i) face_of_[corner++] = face;
    }
  }

  /// Writer: `groups` are coded. Reader: they are filled in. False when a reader ran out of bytes.
  bool code(std::vector<Index>& groups) {
    Index corner = 0;
    for (Index face = 0; face < groups.size(); ++face) {
      const Guess guess = guessFor(face, corner, groups);
      groups[face] = one(groups[face], guess);
      corner += mesh_.face_degrees[face];
      if (port_.overrun()) return false;
    }
    return true;
  }

 private:
  Guess guessFor(Index face, Index first_corner, const std::vector<Index>& groups) {
    const Index end = first_corner + mesh_.face_degrees[face];
    Guess guess;
    guess.first = last_;
    Index latest = kNone;
    for (Index corner = first_corner; corner < end; ++corner) {
      const Index neighbour = codedNeighbour(face, corner);
      if (neighbour == kNone || (latest != kNone && neighbour < latest)) continue;
      latest = neighbour;
      guess.first = groups[neighbour];
    }
    Index other = kNone;
    for (Index corner = first_corner; corner < end; ++corner) {
      const Index neighbour = codedNeighbour(face, corner);
      if (neighbour == kNone) continue;
      if (groups[neighbour] != guess.first)
        other = groups[neighbour];
      else if (guess.support < 3)
        ++guess.support;
    }
    guess.torn = other != kNone;
    guess.second = guess.torn ? other : last_ != guess.first ? last_ : last_but_one_;
    if (guess.second == guess.first) guess.second = guess.first == 0 ? 1 : 0;
    return guess;
  }

  Index codedNeighbour(Index face, Index corner) const {
    const Index twin = mesh_.twins[corner];
    return twin == kNone || face_of_[twin] >= face ? kNone : face_of_[twin];
  }

  Index one(Index group, const Guess& guess) {
    if (same_first_[guess.support * 2 + guess.torn].code(port_, group == guess.first)) return follow(guess.first);
    if (same_second_[guess.torn].code(port_, group == guess.second) && guess.second < group_count_) {
      return follow(guess.second);
    }
    return follow(port_.uniform(group_count_, group));
  }

  Index follow(Index group) {
    if (group != last_) last_but_one_ = last_;
    return last_ = group;
  }

  Port& port_;
  const Connectivity& mesh_;
  const Index group_count_;
  std::vector<Index> face_of_;
  Index last_ = 0;
  Index last_but_one_ = 1;
  std::array<Bit, 8> same_first_;
  std::array<Bit, 2> same_second_;
};

/// Interior rings in ascending order: distance from the one before, then from its owner.
template <class Port>
class RingScript {
 public:
  explicit RingScript(Port& port) : port_(port) {}

  Index count(Index value) { return count_.code(port_, value); }
  Index gap(Index value) { return gap_.code(port_, value); }

  /// The owner of face `ring`; may lie outside the faces when a reader's bytes are damaged.
  uint64_t owner(Index ring, Index value) {
    const bool after = after_.code(port_, value > ring);
    const uint64_t distance = uint64_t{distance_.code(port_, (after ? value - ring : ring - value) - 1)} + 1;
    return after ? ring + distance : ring - distance;
  }

 private:
  Port& port_;
  Bit after_;
  NumberModel count_, gap_, distance_;
};

}  // namespace

std::vector<uint8_t> encodeGroups(const Connectivity& mesh, std::span<const Index> groups, Index group_count) {
  RangeWriter port;
  std::vector<Index> values(groups.begin(), groups.end());
  GroupScript<RangeWriter>(port, mesh, group_count).code(values);
  return std::move(port).finish();
}

Result<std::vector<Index>> decodeGroups(const Connectivity& mesh, std::span<const uint8_t> bytes, Index group_count) {
  RangeReader port(bytes);
  std::vector<Index> groups(mesh.face_degrees.size());
  if (!GroupScript<RangeReader>(port, mesh, group_count).code(groups)) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  return groups;
}

std::vector<uint8_t> encodeRings(std::span<const Index> ring_owners) {
  RangeWriter port;
  RingScript<RangeWriter> script(port);
  Index count = 0;
  for (const Index owner : ring_owners) count += owner != kNone;
  script.count(count);
  Index next = 0;
  for (Index face = 0; face < ring_owners.size(); ++face) {
    if (ring_owners[face] == kNone) continue;
    script.gap(face - next);
    script.owner(face, ring_owners[face]);
    next = face + 1;
  }
  return std::move(port).finish();
}

Result<std::vector<Index>> decodeRings(std::span<const uint8_t> bytes, Index face_count) {
  RangeReader port(bytes);
  RingScript<RangeReader> script(port);
  std::vector<Index> owners(face_count, kNone);
  const Index count = script.count(0);
  if (count > face_count) return Error::kMalformed;
  uint64_t next = 0;
  for (Index i = 0; i < count; ++i) {
    const uint64_t ring = next + script.gap(0);
    if (ring >= face_count) return Error::kMalformed;
    const uint64_t owner = script.owner(static_cast<Index>(ring), 0);
    if (owner >= face_count) return Error::kMalformed;
    owners[ring] = static_cast<Index>(owner);
    next = ring + 1;
  }
  if (port.overrun()) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  if (!ringsAreValid(owners, {})) return Error::kMalformed;
  return owners;
}

bool ringsAreValid(std::span<const Index> ring_owners, std::span<const Index> groups) {
  for (size_t face = 0; face < ring_owners.size(); ++face) {
    const Index owner = ring_owners[face];
    if (owner == kNone) continue;
    if (owner >= ring_owners.size() || ring_owners[owner] != kNone) return false;
    if (!groups.empty() && groups[face] != groups[owner]) return false;
  }
  return true;
}

}  // namespace tutte
