#include "codec/copy_order.h"

#include <algorithm>
#include <map>
#include <utility>

namespace tutte {
namespace {

// A component's part of the coded order.
struct Block {
  Index face, umbrella;
};

// Where each component begins, and the end of the last one.
std::vector<Block> blocksOf(std::span<const ComponentPlan> plans, const Connectivity& coded, const WalkOrder& order) {
  std::vector<Block> blocks;
  Index corner = 0;
  for (Index face = 0; face < order.start_corners.size(); corner += coded.face_degrees[face++]) {
    if (blocks.size() < plans.size() && order.start_corners[face] == plans[blocks.size()].seed) {
      blocks.push_back({face, coded.umbrellas[corner]});
    }
  }
  blocks.push_back({static_cast<Index>(order.start_corners.size()), static_cast<Index>(order.umbrellas.size())});
  return blocks;
}

// Components with the same symbols, if there are several.
std::vector<std::vector<Index>> groupsOf(std::span<const ComponentPlan> plans) {
  std::map<Index, std::vector<Index>> copies;
  for (Index i = 0; i < plans.size(); ++i) {
    if (plans[i].original != kNone)
      copies.try_emplace(plans[i].original, 1, plans[i].original).first->second.push_back(i);
  }
  std::vector<std::vector<Index>> groups;
  for (auto& [original, members] : copies) groups.push_back(std::move(members));
  return groups;
}

// Gives the places of the components `group` to the same components in the order `sorted`.
void permute(std::span<const Index> group, std::span<const Index> sorted, std::span<const Block> blocks,
             const WalkOrder& before, WalkOrder& order) {
  for (size_t i = 0; i < group.size(); ++i) {
    const Block &to = blocks[group[i]], &from = blocks[sorted[i]], &end = blocks[sorted[i] + 1];
    std::copy(before.start_corners.begin() + from.face, before.start_corners.begin() + end.face,
              order.start_corners.begin() + to.face);
    std::copy(before.umbrellas.begin() + from.umbrella, before.umbrellas.begin() + end.umbrella,
              order.umbrellas.begin() + to.umbrella);
  }
}

}  // namespace

void orderCopies(const Topology& topology, std::span<const ComponentPlan> plans, const Connectivity& coded,
                 WalkOrder& order) {
  const std::vector<Block> blocks = blocksOf(plans, coded, order);
  const WalkOrder walked = order;
  std::vector<Index> rank(topology.vertex_of.size(), kNone);
  for (Index i = static_cast<Index>(walked.umbrellas.size()); i-- > 0;)
    rank[topology.vertex_of[walked.umbrellas[i]]] = i;
  const auto umbrellasOf = [&](Index component) {
    const Index first = blocks[component].umbrella;
    return std::span(walked.umbrellas).subspan(first, blocks[component + 1].umbrella - first);
  };
  const auto key = [&](Index umbrella) { return rank[topology.vertex_of[umbrella]]; };
  const auto before = [&](Index a, Index b) {
    return std::ranges::lexicographical_compare(umbrellasOf(a), umbrellasOf(b), {}, key, key);
  };
  for (const std::vector<Index>& group : groupsOf(plans)) {
    std::vector<Index> sorted = group;
    std::stable_sort(sorted.begin(), sorted.end(), before);
    permute(group, sorted, blocks, walked, order);
  }
}

}  // namespace tutte
