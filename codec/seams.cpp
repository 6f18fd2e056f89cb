#include "codec/seams.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "codec/end_flags.h"
#include "codec/range_coder.h"
#include "codec/run_parts.h"
#include "codec/umbrella_ways.h"

namespace tutte {
namespace {

/// How the ends of one attribute are told.
enum class Parting : uint8_t { kNever, kAlways, kMixed };

template <class Port>
Parting codeParting(Port& port, Parting parting) {
  if (!port.code(32768, parting != Parting::kNever)) return Parting::kNever;
  return port.code(32768, parting == Parting::kMixed) ? Parting::kMixed : Parting::kAlways;
}

/// From parted ends to flags at edges.
std::vector<uint8_t> edgesOf(const Connectivity& mesh, std::span<const uint8_t> ends) {
  std::vector<uint8_t> edges(ends.size());
  for (size_t corner = 0, count = ends.size(); corner < count; ++corner) {
    if (ends[corner] == kParted) edges[corner] = edges[mesh.twins[corner]] = 1;
  }
  return edges;
}

Parting partingOf(std::span<const uint8_t> truth, std::span<const uint8_t> ends) {
  if (std::ranges::find(truth, 1) == truth.end()) return Parting::kNever;
  const auto same = [](uint8_t differs, uint8_t end) { return differs == (end == kParted); };
  return std::ranges::equal(truth, ends, same) ? Parting::kAlways : Parting::kMixed;
}

/// What is asked about an attribute.
std::vector<uint8_t> askParted(std::span<const uint8_t> ends) {
  std::vector<uint8_t> asked(ends.size());
  for (size_t c = 0; c < ends.size(); ++c) asked[c] = ends[c] == kParted ? kAsked : kNoEnd;
  return asked;
}

std::vector<uint8_t> differingEnds(const UmbrellaWays& ways, std::span<const Index> wedges,
                                   std::span<const uint8_t> ends, const ValueView& values) {
  std::vector<uint8_t> differ(ends.size());
  for (Index c = 0; c < ends.size(); ++c) {
    if (ends[c] != kParted) continue;
    const uint8_t* here = values.data.data() + size_t{wedges[c]} * values.stride;
    const uint8_t* across = values.data.data() + size_t{wedges[ways.across(c)]} * values.stride;
    differ[c] = std::memcmp(here, across, values.stride) != 0;
  }
  return differ;
}

/// 1 at ends whose sides have different parts.
std::vector<uint8_t> partedEnds(const UmbrellaWays& ways, std::span<const Index> parts) {
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
  std::vector<uint8_t> ends{};  ///< EndStates; empty: it differs nowhere

  Level() = default;
  Level(std::vector<Index> numbers, Index number_count, std::vector<uint8_t> states)
      : own(std::move(numbers)), of_corner(own), count(number_count), ends(std::move(states)) {}
};

Level firstLevel(const Connectivity& mesh) {
  Level level;
  if (!mesh.vertices.empty()) level.own = verticesOf(mesh);
  level.of_corner = mesh.vertices.empty() ? mesh.umbrellas : level.own;
  level.count = mesh.vertex_count;
  return level;
}

/// What is asked about the next level: where this one does not differ.
std::vector<uint8_t> askJoined(const Connectivity& mesh, const Level& whole) {
  std::vector<uint8_t> ends(mesh.twins.size(), kAsked);
  for (size_t c = 0; c < whole.ends.size(); ++c) ends[c] = whole.ends[c] == kParted ? kParted : kAsked;
  return ends;
}

/// Codes the parts of `whole` behind the flags that part it, and returns their numbers per run.
template <class Port>
class LevelCoder {
 public:
  LevelCoder(Port& port, const UmbrellaWays& ways, const Level& whole)
      : port_(port), ways_(ways), whole_(whole), ends_(askJoined(ways.mesh(), whole)) {}

  /// `parts`: per corner; a decoder passes nothing.
  Level code(std::span<const Index> parts = {}) {
    const std::vector<uint8_t> truth = partedEnds(ways_, parts);
    EndFlags<Port> flags(port_, ways_, ends_, truth);
    flags.code();
    // Umbrellas that are wholes of their own, and not parted, are their own parts: nothing is coded.
    const bool own = whole_.of_corner.data() == ways_.mesh().umbrellas.data();
    Runs runs(ways_, ends_, own ? flags.corners() : allCorners());
    RunParts<Port> coder(port_, ways_.mesh(), runs, whole_.of_corner, whole_.count);
    std::vector<Index> base(Port::kWriting ? whole_.count : 0, kNone);
    for (const Index first : runs.firsts) {
      Index local = 0;
      if constexpr (Port::kWriting) {
        Index& start = base[whole_.of_corner[first]];
        if (start == kNone) start = parts[first];
        local = parts[first] - start;
      }
      coder.code(local);
    }
    return numbered(std::move(runs), coder);
  }

 private:
  std::vector<Index> allCorners() const {
    std::vector<Index> corners(ends_.size());
    std::iota(corners.begin(), corners.end(), Index{0});
    return corners;
  }

  // Turns numbers within wholes into parts. A whole without runs has one part.
  Level numbered(Runs&& runs, const RunParts<Port>& coder) {
    std::vector<Index> base(whole_.count);
    Index count = 0;
    for (Index w = 0; w < whole_.count; ++w) {
      base[w] = count;
      count += std::max(coder.used()[w], 1u);
    }
    const Index* whole = whole_.of_corner.data();
    for (Index& number : runs.of_corner) number = base[*whole++] + (number == kNone ? 0 : coder.parts()[number]);
    return {std::move(runs.of_corner), count, std::move(ends_)};
  }

  Port& port_;
  const UmbrellaWays& ways_;
  const Level& whole_;
  std::vector<uint8_t> ends_;
};

/// The levels below the connectivity's vertices: those of a welded mesh, then wedges.
struct Levels {
  Level vertices, wedges;
};

/// In a welded mesh wedges may be vertices; in others they are not, or there would be no section.
template <class Port>
bool codeWedgesDiffer(Port& port, bool welded, bool differ) {
  return !welded || port.code(32768, differ);
}

Levels decodeLevels(RangeReader& port, const UmbrellaWays& ways, bool welded) {
  Levels levels{firstLevel(ways.mesh()), {}};
  if (welded) levels.vertices = LevelCoder(port, ways, levels.vertices).code();
  if (codeWedgesDiffer(port, welded, false)) {
    levels.wedges = LevelCoder(port, ways, levels.vertices).code();
  } else {
    levels.wedges = {levels.vertices.own, levels.vertices.count, levels.vertices.ends};
  }
  return levels;
}

void decodeAttributeSeams(RangeReader& port, const UmbrellaWays& ways, std::span<const uint8_t> parted,
                          std::vector<std::vector<uint8_t>>& attribute_seams) {
  for (size_t slot = 1; slot < attribute_seams.size() && !port.overrun(); ++slot) {
    const Parting parting = codeParting(port, Parting::kNever);
    if (parting == Parting::kAlways) attribute_seams[slot] = edgesOf(ways.mesh(), parted);
    if (parting != Parting::kMixed) continue;
    std::vector<uint8_t> ends = askParted(parted);
    EndFlags<RangeReader>(port, ways, ends).code();
    attribute_seams[slot] = edgesOf(ways.mesh(), ends);
  }
}

}  // namespace

std::vector<Index> verticesOf(const Connectivity& mesh) {
  std::vector<Index> vertices = mesh.umbrellas;
  if (!mesh.vertices.empty()) {
    for (Index& umbrella : vertices) umbrella = mesh.vertices[umbrella];
  }
  return vertices;
}

Seams withoutSeams(const Connectivity& mesh, Index attribute_count) {
  Seams seams;
  if (!mesh.vertices.empty()) seams.wedges = verticesOf(mesh);
  seams.wedge_count = seams.vertex_count = mesh.vertex_count;
  seams.attribute_seams.resize(attribute_count);
  return seams;
}

std::vector<uint8_t> encodeSeams(const Connectivity& mesh, std::span<const Index> vertices,
                                 std::span<const Index> wedges, std::span<const ValueView> attributes) {
  const UmbrellaWays ways(mesh);
  const bool welded = !vertices.empty();
  RangeWriter port;
  Level level = firstLevel(mesh);
  if (welded) level = LevelCoder(port, ways, level).code(vertices);
  if (codeWedgesDiffer(port, welded, !std::ranges::equal(vertices, wedges))) {
    level = LevelCoder(port, ways, level).code(wedges);
  }
  for (size_t slot = 1; slot < attributes.size(); ++slot) {
    const std::vector<uint8_t> truth = differingEnds(ways, wedges, level.ends, attributes[slot]);
    if (codeParting(port, partingOf(truth, level.ends)) != Parting::kMixed) continue;
    std::vector<uint8_t> ends = askParted(level.ends);
    EndFlags<RangeWriter>(port, ways, ends, truth).code();
  }
  return std::move(port).finish();
}

Result<Seams> decodeSeams(const Connectivity& mesh, bool welded, std::span<const uint8_t> bytes,
                          Index attribute_count) {
  const UmbrellaWays ways(mesh);
  RangeReader port(bytes);
  Levels levels = decodeLevels(port, ways, welded);
  Seams seams;
  seams.attribute_seams.resize(attribute_count);
  decodeAttributeSeams(port, ways, levels.wedges.ends, seams.attribute_seams);
  if (port.overrun()) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  seams.wedges = std::move(levels.wedges.own);
  seams.wedge_count = levels.wedges.count;
  if (welded) seams.vertices = std::move(levels.vertices.own);
  seams.vertex_count = levels.vertices.count;
  return seams;
}

}  // namespace tutte
