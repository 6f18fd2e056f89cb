#include "gltf_ext/ear_clipping.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "gltf_ext/point_grid.h"

namespace tutte {
namespace {

/// The ring that is left to cut, as a doubly linked list. A bridge to a hole doubles both of its ends, so that several
/// nodes may stand for one point.
struct Node {
  Point2 at;
  Index point;
  Index previous;
  Index next;
  bool reflex = false;
  bool clipped = false;
};

/// How picky the search for the next ear is. When a whole round finds nothing, the next level is tried.
enum class Care { kProper, kFlat, kNone };

class EarClipper {
 public:
  EarClipper(std::span<const Point2> points, std::span<const Index> ring_sizes, double tolerance)
      : tolerance_(tolerance) {
    nodes_.reserve(points.size() + 2 * ring_sizes.size());
    Index start = 0;
    for (Index size : ring_sizes) {
      addRing(points, start, size);
      start += size;
    }
    const auto log = static_cast<int64_t>(std::bit_width(points.size()));
    budget_ = 10'000'000 + 16 * log * static_cast<int64_t>(points.size());
    bridgeHoles();
  }

  void clip(std::vector<Index>& triangles) {
    std::vector<Point2> reflex_points;
    for (Index i = 0; i < nodes_.size(); ++i) {
      nodes_[i].reflex = isReflex(nodes_[i]);
      if (nodes_[i].reflex) reflex_nodes_.push_back(i), reflex_points.push_back(nodes_[i].at);
    }
    grid_.build(reflex_points);
    auto left = static_cast<Index>(nodes_.size());
    Index at = 0;
    Index since = 0;  // corners looked at since the last success or change of care
    Care care = Care::kProper;
    while (left > 2) {
      const Node& node = nodes_[at];
      if (isEar(node, care)) {
        triangles.insert(triangles.end(), {nodes_[node.previous].point, node.point, nodes_[node.next].point});
        at = remove(at);
        --left;
        since = care == Care::kFlat ? since + 1 : 0;
        if (care == Care::kNone || (care == Care::kFlat && since > left)) care = Care::kProper;
        flat_found_ = care == Care::kFlat;
      } else {
        at = node.next;
        if (++since >= left) since = 0, care = nextCare(care);
      }
    }
  }

 private:
  void addRing(std::span<const Point2> points, Index start, Index size) {
    for (Index i = 0; i < size; ++i) {
      nodes_.push_back({points[start + i], start + i, start + (i + size - 1) % size, start + (i + 1) % size});
    }
    ring_starts_.push_back(start);
  }

  // --- Ears.

  /// After a round that found nothing. A round among flat corners that did find some goes back to the start.
  Care nextCare(Care care) {
    if (care == Care::kProper) return Care::kFlat;
    return std::exchange(flat_found_, false) ? Care::kProper : Care::kNone;
  }

  double turn(const Node& node) const { return cross(nodes_[node.previous].at, node.at, nodes_[node.next].at); }
  bool isReflex(const Node& node) const { return turn(node) <= tolerance_; }

  bool isEar(const Node& node, Care care) {
    if (care == Care::kNone || --budget_ <= 0) return true;
    const double area = turn(node);
    if (care == Care::kProper ? area <= tolerance_ : area < -tolerance_) return false;
    if (care == Care::kFlat && area <= tolerance_) return !isSpike(node);
    return isEmpty(nodes_[node.previous], node, nodes_[node.next]);
  }

  /// A flat corner whose two edges run back over each other is cut last: what hangs on it may still be proper.
  bool isSpike(const Node& node) const {
    const Point2 &a = nodes_[node.previous].at, &b = node.at, &c = nodes_[node.next].at;
    return (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) < 0;
  }

  bool isEmpty(const Node& a, const Node& b, const Node& c) {
    const Point2 low{std::min({a.at.x, b.at.x, c.at.x}), std::min({a.at.y, b.at.y, c.at.y})};
    const Point2 high{std::max({a.at.x, b.at.x, c.at.x}), std::max({a.at.y, b.at.y, c.at.y})};
    return !grid_.any(low, high, budget_, [&](Index number) {
      --budget_;
      const Index i = reflex_nodes_[number];
      const Node& node = nodes_[i];
      if (node.clipped || !node.reflex || i == b.previous || i == b.next) return false;
      return contains(a.at, b.at, c.at, node.at) && !isHarmlessTwin(a, b, c, node);
    });
  }

  static bool contains(const Point2& a, const Point2& b, const Point2& c, const Point2& p) {
    return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
  }

  static bool same(const Point2& a, const Point2& b) { return a.x == b.x && a.y == b.y; }

  /// A node at the place of a corner of the ear blocks it only if one of its own edges leads into the ear.
  bool isHarmlessTwin(const Node& a, const Node& b, const Node& c, const Node& node) const {
    if (!same(node.at, a.at) && !same(node.at, b.at) && !same(node.at, c.at)) return false;
    return !leadsInside(a, b, c, nodes_[node.previous].at) && !leadsInside(a, b, c, nodes_[node.next].at);
  }

  static bool leadsInside(const Node& a, const Node& b, const Node& c, const Point2& p) {
    return cross(a.at, b.at, p) > 0 && cross(b.at, c.at, p) > 0 && cross(c.at, a.at, p) > 0;
  }

  /// Takes a node out of the ring and returns where to go on: behind its neighbour, so that ears are spread out.
  Index remove(Index at) {
    Node& node = nodes_[at];
    node.clipped = true;
    nodes_[node.previous].next = node.next;
    nodes_[node.next].previous = node.previous;
    for (Index i : {node.previous, node.next}) {
      // A corner never becomes reflex by clipping in a simple ring; where it would, the grid would not know it.
      nodes_[i].reflex = nodes_[i].reflex && isReflex(nodes_[i]);
    }
    return nodes_[node.next].next;
  }

  // --- Holes.

  /// Joins every interior ring to the exterior one, from the right to the left, so that the ring that a bridge starts
  /// from never lies behind a ring that is not yet joined.
  void bridgeHoles() {
    std::vector<Index> rightmost;
    for (size_t ring = 1; ring < ring_starts_.size(); ++ring) rightmost.push_back(rightmostOf(ring_starts_[ring]));
    std::stable_sort(rightmost.begin(), rightmost.end(),
                     [&](Index a, Index b) { return nodes_[a].at.x > nodes_[b].at.x; });
    for (Index hole : rightmost) bridge(bridgeEnd(hole), hole);
  }

  Index rightmostOf(Index start) const {
    Index best = start;
    for (Index i = nodes_[start].next; i != start; i = nodes_[i].next) {
      if (nodes_[i].at.x > nodes_[best].at.x) best = i;
    }
    return best;
  }

  /// A node of the exterior ring that `hole` sees: the end of the edge that is hit first when looking to the right,
  /// or else, of the reflex nodes in between, the one closest to that direction.
  Index bridgeEnd(Index hole) {
    const Point2 eye = nodes_[hole].at;
    double nearest = std::numeric_limits<double>::infinity();
    const Index first = ring_starts_[0];
    Index end = first;
    Index i = first;
    do {
      const Node& from = nodes_[i];
      const Node& to = nodes_[from.next];
      if (--budget_ < 0) return end;
      if (from.at.y <= eye.y && to.at.y >= eye.y && from.at.y != to.at.y) {
        const double x = from.at.x + (eye.y - from.at.y) / (to.at.y - from.at.y) * (to.at.x - from.at.x);
        if (x >= eye.x && x < nearest) {
          nearest = x;
          end = eye.y == from.at.y ? i : eye.y == to.at.y ? from.next : from.at.x > to.at.x ? i : from.next;
        }
      }
      i = from.next;
    } while (i != first);
    if (!std::isfinite(nearest) || nodes_[end].at.y == eye.y) return coneOf(end, eye);
    return closestInside(end, eye, {nearest, eye.y});
  }

  Index closestInside(Index end, const Point2& eye, const Point2& hit) {
    const bool above = nodes_[end].at.y > eye.y;
    double best = slope(eye, nodes_[end].at);
    const Index first = ring_starts_[0];
    Index found = end;
    Index i = first;
    do {
      const Point2& at = nodes_[i].at;
      const bool inside = above ? contains(eye, hit, nodes_[end].at, at) : contains(eye, nodes_[end].at, hit, at);
      if (inside && at.x > eye.x && locallyInside(nodes_[i], eye)) {
        const double tangent = slope(eye, at);
        if (tangent < best || (tangent == best && at.x < nodes_[found].at.x)) {
          best = tangent;
          found = i;
        }
      }
      i = nodes_[i].next;
    } while (i != first);
    return found;
  }

  static double slope(const Point2& eye, const Point2& at) { return std::abs(at.y - eye.y) / (at.x - eye.x); }

  /// Of the nodes at one place, the one whose corner opens towards `eye`.
  Index coneOf(Index node, const Point2& eye) const {
    const Index first = ring_starts_[0];
    Index i = first;
    do {
      if (same(nodes_[i].at, nodes_[node].at) && locallyInside(nodes_[i], eye)) return i;
      i = nodes_[i].next;
    } while (i != first);
    return node;
  }

  bool locallyInside(const Node& node, const Point2& eye) const {
    const Point2 &before = nodes_[node.previous].at, &after = nodes_[node.next].at;
    const bool left_of_in = cross(before, node.at, eye) >= 0;
    const bool left_of_out = cross(node.at, after, eye) >= 0;
    return turn(node) >= 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  }

  /// ... outer -> hole -> (round the hole) -> hole' -> outer' -> ...
  void bridge(Index outer, Index hole) {
    const auto outer_twin = static_cast<Index>(nodes_.size());
    const Index hole_twin = outer_twin + 1;
    nodes_.push_back(nodes_[outer]);
    nodes_.push_back(nodes_[hole]);
    nodes_[outer_twin].previous = hole_twin;
    nodes_[hole_twin].next = outer_twin;
    nodes_[nodes_[outer_twin].next].previous = outer_twin;
    nodes_[nodes_[hole_twin].previous].next = hole_twin;
    nodes_[outer].next = hole;
    nodes_[hole].previous = outer;
  }

  double tolerance_;
  int64_t budget_ = 0;
  bool flat_found_ = false;
  std::vector<Node> nodes_;
  std::vector<Index> ring_starts_;
  std::vector<Index> reflex_nodes_;
  PointGrid grid_;
};

}  // namespace

void clipEars(std::span<const Point2> points, std::span<const Index> ring_sizes, double tolerance,
              std::vector<Index>& triangles) {
  if (points.size() < 3) return;
  EarClipper(points, ring_sizes, tolerance).clip(triangles);
}

}  // namespace tutte
