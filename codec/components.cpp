#include "codec/components.h"

#include <algorithm>
#include <unordered_map>

namespace tutte {
namespace {

// The faces of a component, its first face first.
std::vector<Index> collectComponent(const Topology& topology, Index root, std::vector<uint8_t>& seen) {
  const FaceCorners& faces = topology.faces;
  std::vector<Index> component{root};
  seen[root] = 1;
  for (size_t i = 0; i < component.size(); ++i) {
    const Index f = component[i];
    for (Index c = faces.first[f]; c < faces.first[f + 1]; ++c) {
      const Index other = faces.faceOf(topology.twin[c]);
      if (seen[other]) continue;
      seen[other] = 1;
      component.push_back(other);
    }
  }
  return component;
}

uint64_t scramble(uint64_t value) {
  value *= 0x9E3779B97F4A7C15u;
  value ^= value >> 32;
  return value * 0xD6E8FEB86659FD93u;
}

// The valence of a corner's umbrella, and whether that is a dummy.
uint64_t ringOf(const Topology& topology, Index corner) {
  const Index umbrella = topology.faces.vertex[corner];
  return uint64_t{topology.valence[umbrella]} << 1 |
         (!topology.dummy_umbrella.empty() && topology.dummy_umbrella[umbrella]);
}

// The degree of a corner's face, and whether that is a dummy.
uint64_t degreeOf(const Topology& topology, Index corner) {
  const Index f = topology.faces.faceOf(corner);
  return uint64_t{topology.faces.first[f + 1] - topology.faces.first[f]} << 1 | topology.isDummy(f);
}

// What the surroundings of an edge look like, the same seen from a mirror if `mirrored`.
uint64_t signatureOf(const Topology& topology, Index corner, bool mirrored) {
  uint64_t from = ringOf(topology, corner), to = ringOf(topology, topology.faces.next(corner));
  if (mirrored) std::swap(from, to);
  const uint64_t faces = scramble(degreeOf(topology, corner)) + degreeOf(topology, topology.twin[corner]);
  return scramble(scramble(faces) * 3 + scramble(from) * 5 + to);
}

// Grows a correspondence of edges from one pair; the edges of the copy are followed backwards where `mirrored`.
class Matcher {
 public:
  explicit Matcher(const Topology& topology) : topology_(topology), image_(topology.twin.size(), kNone) {}

  bool match(Index original, Index copy, bool mirrored) {
    const FaceCorners& faces = topology_.faces;
    bool same = assign(original, copy);
    for (size_t i = 0; same && i < edges_.size(); ++i) {
      const Index edge = edges_[i], image = image_[edge];
      const Index image_origin = mirrored ? faces.next(image) : image;
      same = topology_.isDummy(faces.faceOf(edge)) == topology_.isDummy(faces.faceOf(image)) &&
             ringOf(topology_, edge) == ringOf(topology_, image_origin) &&
             assign(faces.next(edge), mirrored ? faces.prev(image) : faces.next(image)) &&
             assign(topology_.twin[edge], topology_.twin[image]);
    }
    return same;
  }

  Index imageOf(Index edge) const { return image_[edge]; }

  /// Must follow each match().
  void forget() {
    for (const Index edge : edges_) image_[edge] = kNone;
    edges_.clear();
  }

 private:
  bool assign(Index edge, Index image) {
    if (image_[edge] != kNone) return image_[edge] == image;
    image_[edge] = image;
    edges_.push_back(edge);
    return true;
  }

  const Topology& topology_;
  std::vector<Index> image_;  // per corner of an original: the corner of the copy, whose edge matches
  std::vector<Index> edges_;
};

// Turns all faces of a component round.
void mirrorComponent(Topology& topology, const std::vector<Index>& component) {
  FaceCorners& faces = topology.faces;
  if (topology.flipped.empty()) topology.flipped.assign(topology.real_faces, 0);
  if (topology.source_corner.empty()) {
    topology.source_corner.resize(faces.first[topology.real_faces]);
    for (Index c = 0; c < topology.source_corner.size(); ++c) topology.source_corner[c] = c;
  }
  const auto turned = [&](Index c) { return faces.first[faces.faceOf(c)] + faces.first[faces.faceOf(c) + 1] - 1 - c; };
  for (const Index f : component) {
    const Index first = faces.first[f], end = faces.first[f + 1];
    std::reverse(faces.vertex.begin() + first + 1, faces.vertex.begin() + end);
    std::reverse(topology.twin.begin() + first, topology.twin.begin() + end);
    for (Index c = first; c < end; ++c) topology.twin[c] = turned(topology.twin[c]);
    if (topology.isDummy(f)) continue;
    std::reverse(topology.source_corner.begin() + first + 1, topology.source_corner.begin() + end);
    topology.flipped[f] ^= 1;
  }
}

class Planner {
 public:
  Planner(Topology& topology, bool mirror)
      : topology_(topology), mirror_(mirror), matcher_(topology), work_left_(32 * topology.twin.size()) {}

  ComponentPlan plan(const std::vector<Index>& component, Index number) {
    const FaceCorners& faces = topology_.faces;
    ComponentPlan plan{faces.first[component[0]], kNone};
    const auto [original, is_new] =
        originals_.try_emplace(fingerprint(component), Original{number, component.size(), plan.seed});
    if (is_new || repeat(component, original->second, false, plan)) return plan;
    if (mirror_ && repeat(component, original->second, true, plan)) return plan;
    original->second = {number, component.size(), plan.seed};
    return plan;
  }

 private:
  struct Original {
    Index number;
    size_t faces;
    Index seed;
  };

  // The same for all components that look alike, and for their mirror images.
  uint64_t fingerprint(const std::vector<Index>& component) const {
    const FaceCorners& faces = topology_.faces;
    uint64_t sum = component.size();
    for (const Index f : component) {
      const Index first = faces.first[f], end = faces.first[f + 1];
      const uint64_t degree = scramble(degreeOf(topology_, first));
      uint64_t from = scramble(ringOf(topology_, end - 1));
      for (Index c = first; c < end; ++c) {
        const uint64_t to = scramble(ringOf(topology_, c));
        sum += scramble(degree + from + to);
        from = to;
      }
    }
    return sum;
  }

  // Tries all edges that look like the original's seed.
  bool repeat(const std::vector<Index>& component, const Original& original, bool mirrored, ComponentPlan& plan) {
    const FaceCorners& faces = topology_.faces;
    if (original.faces != component.size()) return false;
    const uint64_t wanted = signatureOf(topology_, original.seed, false);
    for (const Index f : component) {
      for (Index c = faces.first[f]; c < faces.first[f + 1]; ++c) {
        if (signatureOf(topology_, c, mirrored) != wanted) continue;
        if (work_left_ < component.size()) return false;
        work_left_ -= component.size();
        const bool same = matcher_.match(original.seed, c, mirrored);
        matcher_.forget();
        if (!same) continue;
        plan = {c, original.number};
        if (mirrored) {
          plan.seed = faces.first[f] + faces.first[f + 1] - 1 - c;
          mirrorComponent(topology_, component);
        }
        return true;
      }
    }
    return false;
  }

  Topology& topology_;
  bool mirror_;
  Matcher matcher_;
  uint64_t work_left_;
  std::unordered_map<uint64_t, Original> originals_;
};

}  // namespace

std::vector<ComponentPlan> planComponents(Topology& topology, Repeats repeats) {
  std::vector<ComponentPlan> plans;
  std::vector<uint8_t> seen(topology.faces.faceCount(), 0);
  Planner planner(topology, repeats == Repeats::kMirrored);
  bool find_copies = repeats != Repeats::kNone;
  for (Index f = 0; f < topology.real_faces; ++f) {
    if (seen[f]) continue;
    const std::vector<Index> component = collectComponent(topology, f, seen);
    if (component.size() == topology.faces.faceCount()) find_copies = false;
    plans.push_back(find_copies ? planner.plan(component, static_cast<Index>(plans.size()))
                                : ComponentPlan{topology.faces.first[f], kNone});
  }
  return plans;
}

std::vector<Index> componentsOfFaces(const Topology& topology, const std::vector<ComponentPlan>& plans) {
  std::vector<Index> component_of(topology.faces.faceCount(), 0);
  if (plans.size() < 2) return component_of;
  std::vector<uint8_t> seen(topology.faces.faceCount(), 0);
  for (Index i = 0; i < plans.size(); ++i) {
    for (const Index f : collectComponent(topology, topology.faces.faceOf(plans[i].seed), seen)) component_of[f] = i;
  }
  return component_of;
}

void moveSeed(const Topology& topology, std::vector<ComponentPlan>& plans, Index component, Index seed) {
  const auto isCopy = [&](const ComponentPlan& plan) { return plan.original == component; };
  if (std::any_of(plans.begin(), plans.end(), isCopy)) {
    Matcher matcher(topology);
    for (ComponentPlan& plan : plans) {
      if (!isCopy(plan)) continue;
      matcher.match(plans[component].seed, plan.seed, false);
      plan.seed = matcher.imageOf(seed);
      matcher.forget();
    }
  }
  plans[component].seed = seed;
}

}  // namespace tutte
