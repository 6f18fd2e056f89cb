#pragma once
// One level of the structure of wedges: which corners of its wholes share a part.

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/edge_ends.h"
#include "codec/end_flags.h"
#include "codec/mesh.h"
#include "codec/run_parts.h"
#include "codec/sorting.h"
#include "codec/touch_flags.h"
#include "codec/umbrella_ways.h"

namespace tutte {

/// 1 at ends whose sides have different parts.
inline std::vector<uint8_t> partedEnds(const UmbrellaWays& ways, std::span<const Index> parts) {
  std::vector<uint8_t> parted(parts.size());
  for (Index c = 0; c < parts.size(); ++c) {
    const Index across = ways.across(c);
    parted[c] = across != kNone && parts[c] != parts[across];
  }
  return parted;
}

/// A level of the structure: per coded corner a number below `count`. The connectivity's vertices are one; each further
/// level parts the one before it.
struct Level {
  std::vector<Index> own;              ///< empty: of somebody else
  std::span<const Index> of_corner{};  ///< `own`, or the other's
  Index count = 0;
  std::vector<uint8_t> ends{};   ///< EndStates; empty: it differs nowhere
  std::vector<Index> touched{};  ///< umbrellas with parted ends, in ascending order
};

/// Codes the parts of `whole` behind the flags that part it.
template <class Port>
class LevelCoder {
 public:
  LevelCoder(Port& port, const UmbrellaWays& ways, const Level& whole)
      : port_(port), ways_(ways), whole_(whole), ends_(ways, givenEnds(whole)), rings_(ends_) {}

  /// `parts`: per corner; a decoder passes nothing.
  Level code(std::span<const Index> parts = {}) {
    codeEnds(partedEnds(ways_, parts));
    RunParts<Port> runs(port_, whole_.of_corner, whole_.count);
    codeRuns(runs, parts);
    Level level;
    level.own = numbered(runs.used(), level.count);
    level.of_corner = level.own;
    level.touched = touched();
    level.ends = std::move(ends_).takeStates();
    return level;
  }

 private:
  // Where a level differs, the next one does, too.
  std::vector<uint8_t> givenEnds(const Level& whole) const {
    std::vector<uint8_t> ends(whole.of_corner.size());
    std::ranges::transform(ways_.mesh().twins, ends.begin(),
                           [](Index twin) { return twin == kNone ? kNoEnd : kAsked; });
    for (size_t c = 0; c < whole.ends.size(); ++c) {
      if (whole.ends[c] == kParted) ends[c] = kParted;
    }
    return ends;
  }

  void codeEnds(std::span<const uint8_t> truth) {
    TouchFlags<Port>(port_, ends_, rings_, truth).code();
    EndFlags<Port>(port_, ends_, rings_, truth).code();
    for (const Index umbrella : whole_.touched) {
      if (!rings_.isTouched(umbrella)) rings_.add(umbrella);
    }
  }

  // Umbrellas that are wholes of their own, and not parted, are their own parts: nothing is coded.
  bool ownsUmbrellas() const { return whole_.of_corner.data() == ways_.mesh().umbrellas.data(); }

  void codeRuns(RunParts<Port>& runs, std::span<const Index> parts) {
    // A whole's parts, by the order in which they are coded.
    std::vector<Index> coded(Port::kWriting ? parts.size() + whole_.count : 0, kNone);
    const auto partOf = [&](Index corner) -> Index {
      if constexpr (!Port::kWriting) return 0;
      Index& part = coded[parts[corner]];
      if (part == kNone) part = runs.used()[whole_.of_corner[corner]];
      return part;
    };
    part_at_.resize(rings_.placeCount());
    const auto codeRing = [&](const EndRing& ring) {
      runs.codeRing(rings_, ring, partOf, [&](Index place, Index part) { part_at_[place] = part; });
    };
    if (ownsUmbrellas()) {
      for (const EndRing& ring : rings_.rings()) codeRing(ring);
      return;
    }
    const Index count = ways_.mesh().umbrella_count;
    part_of_.resize(count);
    for (Index umbrella = 0; umbrella < count; ++umbrella) {
      const Index first = ways_.first(umbrella);
      if (const EndRing* ring = rings_.find(umbrella)) {
        codeRing(*ring);
      } else {
        part_of_[umbrella] = runs.codeWhole(first, partOf(first));
      }
    }
  }

  /// Turns numbers within wholes into parts, `count` in all, in the order of numberParts(). A whole without runs has
  /// one part.
  std::vector<Index> numbered(std::span<const Index> used, Index& count) {
    std::vector<Index> base(whole_.count);
    for (Index w = 0; w < whole_.count; ++w) {
      base[w] = count;
      count += std::max(used[w], 1u);
    }
    std::vector<Index> numbers(whole_.of_corner.begin(), whole_.of_corner.end());
    for (Index& number : numbers) number = base[number];
    if (!part_of_.empty()) {
      for (Index c = 0; c < numbers.size(); ++c) numbers[c] += part_of_[ways_.umbrella(c)];
    }
    for (const EndRing& ring : rings_.rings()) {
      if (part_of_.empty()) sortParts(ring, used[ring.umbrella]);
      for (Index place = ring.first; place < ring.end(); ++place) numbers[rings_.corner(place)] += part_at_[place];
    }
    if (!part_of_.empty()) renumber(base, count, numbers);
    return numbers;
  }

  // Numbers a ring's parts by their first corners, where they are a whole's.
  void sortParts(const EndRing& ring, Index count) {
    if (count < 2) return;
    lowest_.assign(count, ~uint64_t{0});
    for (Index place = ring.first; place < ring.end(); ++place) {
      uint64_t& lowest = lowest_[part_at_[place]];
      lowest = std::min(lowest, pairOf(rings_.corner(place), part_at_[place]));
    }
    if (std::ranges::is_sorted(lowest_)) return;
    sortNumbers(lowest_);
    order_.resize(count);
    for (Index i = 0; i < count; ++i) order_[secondOf(lowest_[i])] = i;
    for (Index place = ring.first; place < ring.end(); ++place) part_at_[place] = order_[part_at_[place]];
  }

  // The same, where wholes are of several umbrellas. `base`: per whole its first part.
  void renumber(std::vector<Index>& base, Index count, std::vector<Index>& numbers) const {
    std::vector<Index> part_of(count, kNone);
    for (Index c = 0; c < numbers.size(); ++c) {
      Index& part = part_of[numbers[c]];
      if (part == kNone) part = base[whole_.of_corner[c]]++;
      numbers[c] = part;
    }
  }

  std::vector<Index> touched() const {
    std::vector<uint8_t> is_touched(ways_.mesh().umbrella_count);
    for (const EndRing& ring : rings_.rings()) is_touched[ring.umbrella] = 1;
    std::vector<Index> umbrellas;
    for (Index umbrella = 0; umbrella < is_touched.size(); ++umbrella) {
      if (is_touched[umbrella] != 0) umbrellas.push_back(umbrella);
    }
    return umbrellas;
  }

  Port& port_;
  const UmbrellaWays& ways_;
  const Level& whole_;
  EdgeEnds ends_;
  EndRings rings_;
  std::vector<Index> part_at_;    ///< per place: its corner's part, within its whole
  std::vector<uint64_t> lowest_;  ///< of sortParts(): per part its first corner, and the part
  std::vector<Index> order_;
  std::vector<Index> part_of_;  ///< the same per umbrella that is not touched; empty: all 0
};

}  // namespace tutte
