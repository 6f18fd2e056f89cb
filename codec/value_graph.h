#pragma once
// Where values sit on a mesh. Corners that share a value form a *site*: a vertex for positions; for an attribute with
// seams, the corners of a vertex between two seams.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "codec/face_ways.h"
#include "codec/mesh.h"
#include "codec/mesh_ways.h"

namespace tutte {

/// What is known of a mesh that a decoder or an encoder has made, so that most of it need not be looked at.
struct KnownMesh {
  const MeshWays* ways = nullptr;   ///< null: nothing is known
  std::span<const Index> parted{};  ///< in ascending order, all umbrellas that have several wedges
};

/// The sites of one attribute over a mesh, as predictors see them. 4 bytes per site unless the sites are all umbrellas,
/// 4 bytes per corner where seams part faces, and what MeshWays takes, which others may have, too.
///
/// In a face of more than 2048 corners, the first one's predecessor and the last one's successor are these themselves,
/// and both ones' edges are boundaries.
class ValueGraph {
 public:
  /// The sites are the umbrellas, and behind them those that no corner uses. The mesh and what is known of it must stay
  /// as and where they are. O(corners), as the next one; of a known mesh O(umbrellas).
  ValueGraph(const Connectivity& mesh, Index site_count, const KnownMesh& known = {});
  /// `sites`, too, must stay: per corner a number below `site_count`. An umbrella may lie in several.
  ValueGraph(const Connectivity& mesh, std::span<const Index> sites, Index site_count, const KnownMesh& known = {});
  ValueGraph(ValueGraph&&) = default;

  static constexpr Index kMostCorners = 60;  ///< of a site; further ones are not looked at

  Index siteCount() const { return static_cast<Index>(starts_.size()); }
  Index cornerCount() const { return static_cast<Index>(sites_.size()); }

  /// The mesh's.
  std::span<const ComponentCopy> copies() const { return copies_; }

  Index site(Index corner) const { return sites_[corner]; }
  /// As Connectivity::twins, but kNone where the far side has other sites.
  Index twin(Index corner) const { return twins_[corner]; }
  /// The degree of its face, at most 255.
  Index degree(Index corner) const { return shapes_.empty() ? 3 : any().degree(corner); }
  Index next(Index corner) const { return shapes_.empty() ? TriangleFaces{}.next(corner) : any().next(corner); }
  Index prev(Index corner) const { return shapes_.empty() ? TriangleFaces{}.prev(corner) : any().prev(corner); }

  /// Calls visit(faces) with what goRound() asks for: for those who go round many of them.
  template <class Visit>
  void withFaces(Visit visit) const {
    shapes_.empty() ? visit(TriangleFaces{}) : visit(any());
  }

  /// Goes round a site: calls step(corner, prev) for each corner, prev being the one before it in its face, and
  /// end(first, beyond) after each fan: corners that share edges, each with the one before it the edge to its own
  /// `next`; in a closed fan, the first with the last, too. `first` is the fan's first corner, and `beyond` the twin of
  /// the last `prev`, which is `first` in a closed fan. An open fan begins where an edge has no twin, a closed one with
  /// its lowest corner; open fans come first. At most 60 corners in all; those of faces of degree below 3 do not count.
  template <class Faces, class Step, class End>
  [[gnu::always_inline]] void goRound(const Faces& faces, Index site, Step step, End end) const {
    const Index fans = starts_[site];
    if (fans >= kSeveral) [[unlikely]]
      return goRoundSeveral(faces, fans, step, end);
    Index corner = fans, rest = kMostCorners;
    do {
      const Index prev = faces.prev(corner);
      step(corner, prev);
      corner = twins_[prev];
    } while (corner != kNone && corner != fans && --rest > 0);
    end(fans, corner);
  }

  /// A fan of the site is open.
  bool isOpen(Index site) const {
    Index fans = starts_[site];
    return fans != kNone && twins_[takeFan(fans)] == kNone;
  }

  /// Calls visit(ahead, behind) for each open fan of the site: the sites at its two boundary edges, on to which the
  /// first one runs and from which the last one comes; kNone where that edge is not looked at. Until it says true.
  template <class Visit>
  void forEachOpenFan(Index site, Visit visit) const {
    if (!isOpen(site)) return;
    withFaces([&](const auto& faces) {
      Index last = kNone;
      bool done = false;
      goRound(
          faces, site, [&](Index, Index prev) { last = prev; },
          [&](Index first, Index beyond) {
            if (done || beyond == first) return;
            const Index ahead = twins_[first] == kNone ? sites_[faces.next(first)] : kNone;
            done = visit(ahead, beyond == kNone ? sites_[last] : kNone);
          });
    });
  }

  /// The corners of a site.
  struct CornerList {
    std::array<Index, kMostCorners> corners;
    Index count = 0;

    const Index* begin() const { return corners.data(); }
    const Index* end() const { return corners.data() + count; }
  };

  /// All of them.
  CornerList corners(Index site) const;

 private:
  // The fans of a site: kNone, the first corner of a single one, or kSeveral and which of `fans_` is the first.
  static constexpr Index kSeveral = 1u << 31;
  struct Fan {
    Index first, others;
  };

  Index takeFan(Index& fans) const {
    if (fans < kSeveral) [[likely]]
      return std::exchange(fans, kNone);
    const Fan& fan = fans_[fans - kSeveral];
    fans = fan.others;
    return fan.first;
  }

  // Apart, because what sites with a single fan need is much less.
  template <class Faces, class Step, class End>
  [[gnu::always_inline]] void goRoundSeveral(const Faces& faces, Index fans, Step& step, End& end) const {
    for (Index rest = kMostCorners; fans != kNone && rest > 0;) {
      const Index first = takeFan(fans);
      Index corner = first;
      do {
        const Index prev = faces.prev(corner);
        step(corner, prev);
        corner = twins_[prev];
        --rest;
      } while (corner != kNone && corner != first && rest > 0);
      end(first, corner);
    }
  }

  // What is common to both constructors.
  ValueGraph(const Connectivity& mesh, std::span<const Index> sites, const KnownMesh& known);

  AnyFaces any() const { return {shapes_.data()}; }
  void cut(Index corner);
  Index cutLargeFaces(std::span<const Index> face_degrees);
  template <class Faces>
  void cutSeams(const Faces& faces);
  std::vector<uint8_t> cutSeamsOf(const Connectivity& mesh, std::span<const Index> umbrellas);
  void listFans(const Connectivity& mesh, Index counted);
  void listFansOf(const Connectivity& mesh, Index counted, std::span<const uint8_t> opened);
  void addFan(Index first);
  void addFans(const Connectivity& mesh, std::vector<Index>& firsts);

  std::unique_ptr<const MeshWays> own_ways_;  // null: they are known
  const MeshWays* ways_;
  std::span<const Index> sites_, twins_;  // per corner
  std::vector<Index> own_twins_;          // empty: the mesh's
  std::span<const ComponentCopy> copies_;
  std::span<const uint32_t> shapes_;  // per corner; empty: all triangles
  std::span<const Index> starts_;     // per site its fans
  std::vector<Index> own_starts_;     // empty: the ways'
  std::vector<Fan> fans_;
};

/// The site of each wedge, numbered by the smallest wedge.
struct WedgeSites {
  std::vector<Index> site_of;  ///< empty: every wedge is a site
  Index count = 0;
};

/// Joins wedges that no seam parts: those of two faces that meet in an edge which is no seam. `wedges` are per corner,
/// below `wedge_count`; `seams` is per corner, 1 where the edge to the next corner is a seam, or empty. O(corners), of
/// a known mesh those of parted umbrellas.
WedgeSites joinWedges(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count,
                      std::span<const uint8_t> seams, const KnownMesh& known = {});

/// Joins all wedges of a vertex. O(corners), of a known mesh O(umbrellas).
WedgeSites joinVertices(const Connectivity& mesh, std::span<const Index> wedges, Index wedge_count,
                        const KnownMesh& known = {});

}  // namespace tutte
