#pragma once
// What was done to the input to make it a manifold, so that the decoder can undo it: faces turned round, faces of
// degree below 3, vertices cut into umbrellas, isolated vertices. Written once for both directions.

#include <array>
#include <span>
#include <vector>

#include "codec/joins.h"
#include "codec/mesh.h"
#include "codec/model.h"
#include "codec/result.h"

namespace tutte {

/// The encoder's knowledge, in coded order. A decoder passes an empty one.
struct RepairNotes {
  std::vector<uint8_t> flipped;      ///< per face of the walk; empty: none
  std::vector<Index> stray_degrees;  ///< faces of degree 0, 1, 2; each of their corners is a new umbrella
  std::vector<Index> vertices;       ///< per umbrella, the strays' included: its vertex, numbered by first appearance;
                                     ///< empty: the identity
  Index isolated = 0;                ///< vertices without a corner

  bool any() const { return !flipped.empty() || !stray_degrees.empty() || !vertices.empty() || isolated != 0; }
};

template <class Port>
class RepairCoder {
 public:
  /// `mesh` comes from the walk and is completed; `on_boundary` says which of its umbrellas a dummy face touches.
  RepairCoder(Port& port, const RepairNotes& notes, std::span<const uint8_t> on_boundary, const Limits& limits,
              Connectivity& mesh)
      : port_(port), notes_(notes), on_boundary_(on_boundary), limits_(limits), mesh_(mesh) {}

  Error run() {
    port_.about(Topic::kFlips);
    if (port_.code(kEven, !notes_.flipped.empty())) codeFlips();
    port_.about(Topic::kStrays);
    if (const Error error = codeStrays(); error != Error::kNone) return error;
    mesh_.vertex_count = mesh_.umbrella_count;
    port_.about(Topic::kJoins);
    if (port_.code(kEven, !notes_.vertices.empty())) {
      JoinCoder joins(port_, notes_.vertices, on_boundary_, mesh_);
      if (const Error error = joins.run(); error != Error::kNone) return error;
    }
    port_.about(Topic::kIsolated);
    const Index isolated = number_.code(port_, notes_.isolated);
    if (port_.overrun()) return Error::kTruncated;
    if (mesh_.vertex_count > limits_.max_vertices || isolated > limits_.max_vertices - mesh_.vertex_count) {
      return Error::kLimitExceeded;
    }
    mesh_.vertex_count += isolated;
    return Error::kNone;
  }

 private:
  static constexpr Probability kEven = 32768;

  void codeFlips() {
    mesh_.flipped.resize(mesh_.face_degrees.size());
    if (port_.code(kEven, areFlippedAlike())) {
      codeFlipsAlike();
    } else {
      codeSingleFlips();
    }
  }

  bool isFlipped(Index face) const { return !notes_.flipped.empty() && notes_.flipped[face]; }

  // Is every face flipped like the one before it, unless nothing before it lies behind its first edge? So are whole
  // components that were turned round.
  bool areFlippedAlike() const {
    Index corner = 0;
    for (Index f = 0; f < notes_.flipped.size(); corner += mesh_.face_degrees[f++]) {
      if (mesh_.twins[corner] < corner && notes_.flipped[f] != notes_.flipped[f - 1]) return false;
    }
    return true;
  }

  void codeFlipsAlike() {
    Bit first;
    Index corner = 0;
    for (Index f = 0; f < mesh_.flipped.size(); corner += mesh_.face_degrees[f++]) {
      const bool follows = mesh_.twins[corner] < corner;
      mesh_.flipped[f] = follows ? mesh_.flipped[f - 1] : first.code(port_, isFlipped(f));
    }
  }

  // A face is flipped like the face behind its first edge, mostly.
  void codeSingleFlips() {
    std::array<Bit, 3> models;
    std::vector<Index> face_of(mesh_.umbrellas.size());
    Index corner = 0;
    for (Index f = 0; f < mesh_.flipped.size(); ++f) {
      const Index twin = mesh_.twins[corner];
      const int context = twin < corner ? mesh_.flipped[face_of[twin]] : 2;
      mesh_.flipped[f] = models[context].code(port_, isFlipped(f));
      for (const Index end = corner + mesh_.face_degrees[f]; corner < end; ++corner) face_of[corner] = f;
    }
  }

  Error codeStrays() {
    const Index count = number_.code(port_, static_cast<Index>(notes_.stray_degrees.size()));
    if (port_.overrun()) return Error::kTruncated;
    if (count > limits_.max_faces - mesh_.face_degrees.size()) return Error::kLimitExceeded;
    for (Index i = 0; i < count; ++i) {
      const Index degree = port_.uniform(3, notes_.stray_degrees.empty() ? 0 : notes_.stray_degrees[i]);
      if (port_.overrun()) return Error::kTruncated;
      if (degree > limits_.max_corners - mesh_.umbrellas.size()) return Error::kLimitExceeded;
      mesh_.face_degrees.push_back(degree);
      if (!mesh_.flipped.empty()) mesh_.flipped.push_back(0);
      for (Index k = 0; k < degree; ++k) {
        mesh_.umbrellas.push_back(mesh_.umbrella_count++);
        mesh_.twins.push_back(kNone);
      }
    }
    return Error::kNone;
  }

  Port& port_;
  const RepairNotes& notes_;
  std::span<const uint8_t> on_boundary_;
  const Limits& limits_;
  Connectivity& mesh_;
  NumberModel number_;
};

}  // namespace tutte
