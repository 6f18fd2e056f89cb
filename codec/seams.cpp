#include "codec/seams.h"

#include <algorithm>
#include <cstring>
#include <ranges>

#include "codec/end_flags.h"
#include "codec/range_coder.h"
#include "codec/run_parts.h"
#include "codec/umbrella_links.h"

namespace tutte {
namespace {

/// Marks the ends that edges with two faces have.
std::vector<uint8_t> interiorEnds(const Connectivity& mesh) {
  std::vector<uint8_t> ends(mesh.twins.size());
  for (size_t corner = 0; corner < ends.size(); ++corner) ends[corner] = mesh.twins[corner] != kNone;
  return ends;
}

/// How the ends of one attribute are told.
enum class Parting : uint8_t { kNever, kAlways, kMixed };

template <class Port>
Parting codeParting(Port& port, Parting parting) {
  if (!port.code(32768, parting != Parting::kNever)) return Parting::kNever;
  return port.code(32768, parting == Parting::kMixed) ? Parting::kMixed : Parting::kAlways;
}

/// From flags at ends to flags at edges.
std::vector<uint8_t> edgesOf(const Connectivity& mesh, std::span<const uint8_t> ends) {
  std::vector<uint8_t> edges(ends.size());
  for (size_t corner = 0; corner < ends.size(); ++corner) {
    const Index twin = mesh.twins[corner];
    if (twin != kNone) edges[corner] = ends[corner] | ends[twin];
  }
  return edges;
}

Parting partingOf(std::span<const uint8_t> ends, std::span<const uint8_t> parted) {
  if (std::ranges::find(ends, 1) == ends.end()) return Parting::kNever;
  return std::ranges::equal(ends, parted) ? Parting::kAlways : Parting::kMixed;
}

std::vector<uint8_t> differingEnds(const UmbrellaLinks& links, std::span<const Index> wedges,
                                   std::span<const uint8_t> parted, const ValueView& values) {
  std::vector<uint8_t> ends(parted.size());
  for (size_t c = 0; c < ends.size(); ++c) {
    if (!parted[c]) continue;
    const uint8_t* here = values.data.data() + size_t{wedges[c]} * values.stride;
    const uint8_t* across = values.data.data() + size_t{wedges[links.across[c]]} * values.stride;
    ends[c] = std::memcmp(here, across, values.stride) != 0;
  }
  return ends;
}

std::vector<uint8_t> partedEnds(const UmbrellaLinks& links, std::span<const Index> parts) {
  std::vector<uint8_t> parted(parts.size());
  for (size_t c = 0; c < parts.size(); ++c) {
    parted[c] = links.across[c] != kNone && parts[c] != parts[links.across[c]];
  }
  return parted;
}

/// A level of the structure: per coded corner a number below `count`. The connectivity's vertices are one; each further
/// level parts the one before it.
struct Level {
  std::vector<Index> of_corner;
  Index count = 0;
  std::vector<uint8_t> parted = {};  ///< ends where it differs; empty: none
};

/// The ends at which a further level may differ and `level` does not.
std::vector<uint8_t> joinedEnds(const Connectivity& mesh, const Level& level) {
  std::vector<uint8_t> ends = interiorEnds(mesh);
  for (size_t end = 0; end < level.parted.size(); ++end) ends[end] &= static_cast<uint8_t>(1 - level.parted[end]);
  return ends;
}

Level firstLevel(const Connectivity& mesh) { return {verticesOf(mesh), mesh.vertex_count}; }

/// Codes the parts of `whole`, and returns at which ends they differ.
std::vector<uint8_t> encodeLevel(RangeWriter& port, const Connectivity& mesh, const UmbrellaLinks& links,
                                 const Level& whole, std::span<const Index> parts) {
  std::vector<uint8_t> parted = partedEnds(links, parts);
  EndFlags<RangeWriter>(port, mesh, links, joinedEnds(mesh, whole), whole.parted).code(parted);
  const Runs runs(links, parted);
  RunParts<RangeWriter> coder(port, mesh, runs, whole.of_corner, whole.count);
  std::vector<Index> base(whole.count, kNone);
  for (const Index first : runs.firsts) {
    Index& start = base[whole.of_corner[first]];
    if (start == kNone) start = parts[first];
    coder.code(parts[first] - start);
  }
  return parted;
}

/// Turns numbers within wholes into parts. A whole without corners has one part.
Level numberRuns(const Level& whole, std::span<const Index> run_of, std::span<const Index> local,
                 std::span<const Index> used) {
  Level parts{std::vector<Index>(run_of.size()), 0};
  std::vector<Index> base(whole.count);
  for (Index w = 0; w < whole.count; ++w) {
    base[w] = parts.count;
    parts.count += std::max(used[w], 1u);
  }
  for (size_t c = 0; c < run_of.size(); ++c) parts.of_corner[c] = base[whole.of_corner[c]] + local[run_of[c]];
  return parts;
}

Result<Level> decodeLevel(RangeReader& port, const Connectivity& mesh, const UmbrellaLinks& links, const Level& whole) {
  std::vector<uint8_t> parted(mesh.umbrellas.size());
  EndFlags<RangeReader>(port, mesh, links, joinedEnds(mesh, whole), whole.parted).code(parted);
  const Runs runs(links, parted);
  RunParts<RangeReader> coder(port, mesh, runs, whole.of_corner, whole.count);
  for (size_t run = 0; run < runs.firsts.size(); ++run) coder.code(0);
  Level parts = numberRuns(whole, runs.of_corner, coder.parts(), coder.used());
  // A damaged stream may give the same part to two runs that it has parted, or part a run from itself.
  if (partedEnds(links, parts.of_corner) != parted) return Error::kMalformed;
  parts.parted = std::move(parted);
  return parts;
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

Result<Levels> decodeLevels(RangeReader& port, const Connectivity& mesh, const UmbrellaLinks& links, bool welded) {
  Levels levels{firstLevel(mesh), {}};
  if (welded) {
    Result<Level> vertices = decodeLevel(port, mesh, links, levels.vertices);
    if (!vertices) return vertices.error();
    levels.vertices = *std::move(vertices);
  }
  if (!codeWedgesDiffer(port, welded, false)) {
    levels.wedges = levels.vertices;
    return levels;
  }
  Result<Level> wedges = decodeLevel(port, mesh, links, levels.vertices);
  if (!wedges) return wedges.error();
  levels.wedges = *std::move(wedges);
  return levels;
}

void decodeAttributeSeams(RangeReader& port, const Connectivity& mesh, const UmbrellaLinks& links,
                          std::span<const uint8_t> parted, std::vector<std::vector<uint8_t>>& attribute_seams) {
  for (size_t slot = 1; slot < attribute_seams.size() && !port.overrun(); ++slot) {
    const Parting parting = codeParting(port, Parting::kNever);
    if (parting == Parting::kAlways) attribute_seams[slot] = edgesOf(mesh, parted);
    if (parting != Parting::kMixed) continue;
    std::vector<uint8_t> ends(parted.size());
    EndFlags<RangeReader>(port, mesh, links, parted).code(ends);
    attribute_seams[slot] = edgesOf(mesh, ends);
  }
}

}  // namespace

std::vector<Index> verticesOf(const Connectivity& mesh) {
  if (mesh.vertices.empty()) return mesh.umbrellas;
  const auto vertices = mesh.umbrellas | std::views::transform([&](Index umbrella) { return mesh.vertices[umbrella]; });
  return {vertices.begin(), vertices.end()};
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
  const UmbrellaLinks links(mesh);
  const bool welded = !vertices.empty();
  RangeWriter port;
  Level level = firstLevel(mesh);
  if (welded) {
    std::vector<uint8_t> parted = encodeLevel(port, mesh, links, level, vertices);
    level = {{vertices.begin(), vertices.end()}, std::ranges::max(vertices) + 1, std::move(parted)};
  }
  std::vector<uint8_t> parted = level.parted;
  if (codeWedgesDiffer(port, welded, !std::ranges::equal(vertices, wedges))) {
    parted = encodeLevel(port, mesh, links, level, wedges);
  }
  for (size_t slot = 1; slot < attributes.size(); ++slot) {
    std::vector<uint8_t> ends = differingEnds(links, wedges, parted, attributes[slot]);
    if (codeParting(port, partingOf(ends, parted)) == Parting::kMixed) {
      EndFlags<RangeWriter>(port, mesh, links, parted).code(ends);
    }
  }
  return std::move(port).finish();
}

Result<Seams> decodeSeams(const Connectivity& mesh, bool welded, std::span<const uint8_t> bytes,
                          Index attribute_count) {
  const UmbrellaLinks links(mesh);
  RangeReader port(bytes);
  Result<Levels> levels = decodeLevels(port, mesh, links, welded);
  if (!levels) return levels.error();
  Seams seams;
  seams.attribute_seams.resize(attribute_count);
  decodeAttributeSeams(port, mesh, links, levels->wedges.parted, seams.attribute_seams);
  if (port.overrun()) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  seams.wedges = std::move(levels->wedges.of_corner);
  seams.wedge_count = levels->wedges.count;
  if (welded) seams.vertices = std::move(levels->vertices.of_corner);
  seams.vertex_count = levels->vertices.count;
  return seams;
}

}  // namespace tutte
