#include "gltf_ext/polygon_order.h"

#include <array>

namespace tutte {
namespace {

/// How soon a face should be taken: the lower, the sooner.
enum Rank { kNothingNew, kWellPredicted, kPredictedOnce, kManyNew, kRanks };

class Grower {
 public:
  explicit Grower(const Connectivity& mesh) : mesh_(mesh) {
    indexFaces();
    indexUmbrellas();
  }

  PolygonOrder run() && {
    for (Index seed = 0; seed < mesh_.face_degrees.size(); ++seed) {
      if (mesh_.face_degrees[seed] < 3) continue;
      for (Index face = seed; face != kNone; face = pop()) {
        if (!taken_[face]) take(face);
      }
    }
    return std::move(order_);
  }

 private:
  void indexFaces() {
    const size_t faces = mesh_.face_degrees.size();
    order_.anchors.assign(faces, 0);
    taken_.assign(faces, false);
    unknown_ = mesh_.face_degrees;
    unknown_xor_.assign(faces, 0);
    face_of_.reserve(mesh_.umbrellas.size());
    for (Index face = 0; face < faces; ++face) {
      first_.push_back(static_cast<Index>(face_of_.size()));
      face_of_.resize(face_of_.size() + mesh_.face_degrees[face], face);
    }
    for (Index c = 0; c < face_of_.size(); ++c) unknown_xor_[face_of_[c]] ^= mesh_.umbrellas[c];
  }

  void indexUmbrellas() {
    known_.assign(mesh_.umbrella_count, false);
    met_.assign(mesh_.umbrella_count, false);
    ring_start_.assign(size_t{mesh_.umbrella_count} + 1, 0);
    for (const Index umbrella : mesh_.umbrellas) ++ring_start_[umbrella + 1];
    for (Index u = 0; u < mesh_.umbrella_count; ++u) ring_start_[u + 1] += ring_start_[u];
    ring_faces_.resize(mesh_.umbrellas.size());
    std::vector<Index> at(ring_start_.begin(), ring_start_.end() - 1);
    for (Index c = 0; c < face_of_.size(); ++c) ring_faces_[at[mesh_.umbrellas[c]]++] = face_of_[c];
  }

  void take(Index face) {
    taken_[face] = true;
    order_.faces.push_back(face);
    order_.anchors[face] = anchorOf(face);
    const Index first = first_[face], end = first + mesh_.face_degrees[face];
    for (Index corner = first; corner < end; ++corner) learn(mesh_.umbrellas[corner]);
    for (Index corner = end; corner-- > first;) {
      if (mesh_.twins[corner] != kNone) meet(face_of_[mesh_.twins[corner]]);
    }
  }

  Index anchorOf(Index face) const {
    const Index degree = mesh_.face_degrees[face];
    const Index* umbrellas = &mesh_.umbrellas[first_[face]];
    for (Index i = 0; i < degree; ++i) {
      const Index next = i + 1 < degree ? i + 1 : 0;
      if (!known_[umbrellas[i]] && known_[umbrellas[next]]) return next;
    }
    return 0;
  }

  void learn(Index umbrella) {
    if (known_[umbrella]) return;
    known_[umbrella] = true;
    for (Index i = ring_start_[umbrella]; i < ring_start_[umbrella + 1]; ++i) {
      --unknown_[ring_faces_[i]];
      unknown_xor_[ring_faces_[i]] ^= umbrella;
    }
  }

  void meet(Index face) {
    if (!taken_[face]) waiting_[rankOf(face)].push_back(face);
  }

  Rank rankOf(Index face) {
    if (unknown_[face] == 0) return kNothingNew;
    if (unknown_[face] > 1) return kManyNew;
    if (mesh_.face_degrees[face] > 3) return kWellPredicted;
    const Index vertex = unknown_xor_[face];  // the only one left
    if (met_[vertex]) return kWellPredicted;
    met_[vertex] = true;
    return kPredictedOnce;
  }

  Index pop() {
    for (auto& stack : waiting_) {
      if (stack.empty()) continue;
      const Index face = stack.back();
      stack.pop_back();
      return face;
    }
    return kNone;
  }

  const Connectivity& mesh_;
  std::vector<Index> first_, face_of_;          // per face, per corner
  std::vector<Index> unknown_, unknown_xor_;    // per face: how many corners are unknown, and all of them by xor
  std::vector<Index> ring_start_, ring_faces_;  // per umbrella: the faces round it
  std::vector<bool> taken_, known_, met_;
  std::array<std::vector<Index>, kRanks> waiting_;
  PolygonOrder order_;
};

}  // namespace

PolygonOrder orderPolygons(const Connectivity& mesh) { return Grower(mesh).run(); }

}  // namespace tutte
