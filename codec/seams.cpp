#include "codec/seams.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "codec/end_flags.h"
#include "codec/model.h"
#include "codec/range_coder.h"
#include "codec/umbrella_links.h"

namespace tutte {
namespace {

/// Marks the ends that edges with two faces have.
std::vector<uint8_t> interiorEnds(const Connectivity& mesh) {
  std::vector<uint8_t> ends(mesh.twins.size());
  for (size_t corner = 0; corner < ends.size(); ++corner) ends[corner] = mesh.twins[corner] != kNone;
  return ends;
}

/// Runs are the largest sets of corners around an umbrella that no parted end separates, numbered by first corner.
std::vector<Index> findRuns(const UmbrellaLinks& links, std::span<const uint8_t> parted, std::vector<Index>& firsts) {
  std::vector<Index> run_of(parted.size(), kNone);
  for (Index corner = 0; corner < parted.size(); ++corner) {
    if (run_of[corner] != kNone) continue;
    const Index run = static_cast<Index>(firsts.size());
    firsts.push_back(corner);
    for (Index c = corner; c != kNone && run_of[c] == kNone; c = parted[c] ? kNone : links.across[c]) run_of[c] = run;
    for (Index c = links.back[corner]; c != kNone && !parted[c] && run_of[c] == kNone; c = links.back[c]) {
      run_of[c] = run;
    }
  }
  return run_of;
}

/// Codes the wedge of each run, as its number within the vertex. A vertex's first run has its first wedge; a later one
/// has a new wedge or one that an earlier run of the vertex has.
template <class Port>
class RunWedges {
 public:
  RunWedges(Port& port, const Connectivity& mesh)
      : port_(port), mesh_(mesh), used_(mesh.vertex_count), seen_(mesh.umbrella_count) {}

  Index code(Index first_corner, Index wedge) {
    Index& used = used_[mesh_.vertexOf(first_corner)];
    uint8_t& seen = seen_[mesh_.umbrellas[first_corner]];
    const bool reused = used != 0 && reuse_[seen].code(port_, wedge < used);
    seen = 1;
    return reused ? port_.uniform(used, wedge) : used++;
  }

  /// Afterwards: per vertex, how many wedges its corners use.
  const std::vector<Index>& used() const { return used_; }

 private:
  Port& port_;
  const Connectivity& mesh_;
  std::vector<Index> used_;
  std::vector<uint8_t> seen_;
  std::array<Bit, 2> reuse_;  ///< is it another run of an umbrella that had one before?
};

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

std::vector<uint8_t> partedEnds(const UmbrellaLinks& links, std::span<const Index> wedges) {
  std::vector<uint8_t> parted(wedges.size());
  for (size_t c = 0; c < wedges.size(); ++c) {
    parted[c] = links.across[c] != kNone && wedges[c] != wedges[links.across[c]];
  }
  return parted;
}

/// Turns numbers within vertices into wedges. An isolated vertex has one wedge.
void numberRuns(const Connectivity& mesh, std::span<const Index> run_of, std::span<const Index> local,
                std::span<const Index> used, Seams& seams) {
  std::vector<Index> base(mesh.vertex_count);
  for (Index vertex = 0; vertex < mesh.vertex_count; ++vertex) {
    base[vertex] = seams.wedge_count;
    seams.wedge_count += std::max(used[vertex], 1u);
  }
  seams.wedges.resize(run_of.size());
  for (Index c = 0; c < run_of.size(); ++c) seams.wedges[c] = base[mesh.vertexOf(c)] + local[run_of[c]];
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

bool wedgesAreVertices(const Connectivity& mesh, std::span<const Index> wedges) {
  for (Index corner = 0; corner < wedges.size(); ++corner) {
    if (wedges[corner] != mesh.vertexOf(corner)) return false;
  }
  return true;
}

Seams withoutSeams(const Connectivity& mesh, Index attribute_count) {
  Seams seams;
  seams.wedge_count = mesh.vertex_count;
  seams.wedges = mesh.umbrellas;
  if (!mesh.vertices.empty()) {
    for (Index& wedge : seams.wedges) wedge = mesh.vertices[wedge];
  }
  seams.attribute_seams.resize(attribute_count);
  return seams;
}

std::vector<uint8_t> encodeSeams(const Connectivity& mesh, std::span<const Index> wedges,
                                 std::span<const ValueView> attributes) {
  const UmbrellaLinks links(mesh);
  std::vector<uint8_t> parted = partedEnds(links, wedges);
  RangeWriter port;
  EndFlags<RangeWriter>(port, mesh, links, interiorEnds(mesh)).code(parted);

  std::vector<Index> firsts;
  findRuns(links, parted, firsts);
  RunWedges<RangeWriter> runs(port, mesh);
  std::vector<Index> base(mesh.vertex_count, kNone);
  for (const Index first : firsts) {
    Index& start = base[mesh.vertexOf(first)];
    if (start == kNone) start = wedges[first];
    runs.code(first, wedges[first] - start);
  }
  for (size_t slot = 1; slot < attributes.size(); ++slot) {
    std::vector<uint8_t> ends = differingEnds(links, wedges, parted, attributes[slot]);
    if (codeParting(port, partingOf(ends, parted)) == Parting::kMixed) {
      EndFlags<RangeWriter>(port, mesh, links, parted).code(ends);
    }
  }
  return std::move(port).finish();
}

Result<Seams> decodeSeams(const Connectivity& mesh, std::span<const uint8_t> bytes, Index attribute_count) {
  const UmbrellaLinks links(mesh);
  std::vector<uint8_t> parted(mesh.umbrellas.size());
  RangeReader port(bytes);
  EndFlags<RangeReader>(port, mesh, links, interiorEnds(mesh)).code(parted);

  std::vector<Index> firsts;
  const std::vector<Index> run_of = findRuns(links, parted, firsts);
  RunWedges<RangeReader> runs(port, mesh);
  std::vector<Index> local(firsts.size());
  for (size_t run = 0; run < firsts.size(); ++run) local[run] = runs.code(firsts[run], 0);

  Seams seams;
  numberRuns(mesh, run_of, local, runs.used(), seams);
  // A damaged stream may give the same wedge to two runs that it has parted, or part a run from itself.
  if (partedEnds(links, seams.wedges) != parted) return Error::kMalformed;
  seams.attribute_seams.resize(attribute_count);
  decodeAttributeSeams(port, mesh, links, parted, seams.attribute_seams);
  if (port.overrun()) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  return seams;
}

}  // namespace tutte
