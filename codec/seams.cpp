#include "codec/seams.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "codec/edge_ends.h"
#include "codec/end_flags.h"
#include "codec/level_coder.h"
#include "codec/range_coder.h"
#include "codec/touch_flags.h"
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

Parting partingOf(std::span<const uint8_t> truth, std::span<const uint8_t> ends) {
  if (std::ranges::find(truth, 1) == truth.end()) return Parting::kNever;
  const auto same = [](uint8_t differs, uint8_t end) { return differs == (end == kParted); };
  return std::ranges::equal(truth, ends, same) ? Parting::kAlways : Parting::kMixed;
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

Level firstLevel(const Connectivity& mesh) {
  Level level;
  if (!mesh.vertices.empty()) level.own = verticesOf(mesh);
  level.of_corner = mesh.vertices.empty() ? mesh.umbrellas : level.own;
  level.count = mesh.vertex_count;
  return level;
}

/// Which of the parted ends of a level an attribute has. `truth`: as for EndFlags.
template <class Port>
std::vector<uint8_t> codeAttributeEnds(Port& port, const UmbrellaWays& ways, const Level& level,
                                       std::span<const uint8_t> truth = {}) {
  std::vector<uint8_t> states(level.ends.size());
  std::ranges::transform(level.ends, states.begin(), [](uint8_t end) { return end == kParted ? kAsked : kNoEnd; });
  EdgeEnds ends(ways, std::move(states));
  EndRings rings(ends);
  TouchFlags<Port>(port, ends, rings, truth).code(level.touched);
  EndFlags<Port>(port, ends, rings, truth).code();
  return std::move(ends).takeStates();
}

/// From parted ends to flags at edges.
std::vector<uint8_t> edgesOf(const UmbrellaWays& ways, const Level& level, std::span<const uint8_t> ends) {
  std::vector<uint8_t> edges(ends.size());
  for (const Index umbrella : level.touched) {
    ways.goRound(umbrella, [&](Index corner) {
      if (ends[corner] == kParted) edges[corner] = edges[ways.twin(corner)] = 1;
    });
  }
  return edges;
}

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
    levels.wedges = levels.vertices;
  }
  return levels;
}

void decodeAttributeSeams(RangeReader& port, const UmbrellaWays& ways, const Level& wedges,
                          std::vector<std::vector<uint8_t>>& attribute_seams) {
  for (size_t slot = 1; slot < attribute_seams.size() && !port.overrun(); ++slot) {
    const Parting parting = codeParting(port, Parting::kNever);
    if (parting == Parting::kAlways) attribute_seams[slot] = edgesOf(ways, wedges, wedges.ends);
    if (parting == Parting::kMixed) {
      attribute_seams[slot] = edgesOf(ways, wedges, codeAttributeEnds(port, ways, wedges));
    }
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
  const MeshWays mesh_ways(mesh);
  const UmbrellaWays ways(mesh, mesh_ways);
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
    codeAttributeEnds(port, ways, level, truth);
  }
  return std::move(port).finish();
}

Result<Seams> decodeSeams(const Connectivity& mesh, bool welded, std::span<const uint8_t> bytes,
                          Index attribute_count) {
  Seams seams;
  seams.ways = std::make_unique<const MeshWays>(mesh);
  const UmbrellaWays ways(mesh, *seams.ways);
  RangeReader port(bytes);
  Levels levels = decodeLevels(port, ways, welded);
  seams.attribute_seams.resize(attribute_count);
  decodeAttributeSeams(port, ways, levels.wedges, seams.attribute_seams);
  if (port.overrun()) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  seams.wedges = std::move(levels.wedges.own);
  seams.wedge_count = levels.wedges.count;
  seams.parted_umbrellas = std::move(levels.wedges.touched);
  if (welded) seams.vertices = std::move(levels.vertices.own);
  seams.vertex_count = levels.vertices.count;
  return seams;
}

}  // namespace tutte
