#include "codec/primal.h"

namespace tutte {
namespace {

// A walked dual with all that is needed to go round its faces and umbrellas.
class WalkedDual {
 public:
  WalkedDual(const Connectivity& dual, const std::vector<Index>& dummies)
      : dual_(dual),
        face_(dual.umbrellas.size()),
        first_(dual.face_degrees.size() + 1, 0),
        dummy_(dual.umbrella_count, 0) {
    for (Index f = 0; f < dual.face_degrees.size(); ++f) {
      first_[f + 1] = first_[f] + dual.face_degrees[f];
      for (Index c = first_[f]; c < first_[f + 1]; ++c) face_[c] = f;
    }
    for (const Index umbrella : dummies) dummy_[umbrella] = 1;
  }

  Index face(Index corner) const { return face_[corner]; }
  bool isDummy(Index corner) const { return dummy_[dual_.umbrellas[corner]]; }
  Index next(Index corner) const {
    return corner + 1 == first_[face_[corner] + 1] ? first_[face_[corner]] : corner + 1;
  }
  Index prev(Index corner) const {
    return corner == first_[face_[corner]] ? first_[face_[corner] + 1] - 1 : corner - 1;
  }

  /// The next corner of the primal face, which is the next one around the dual umbrella.
  Index around(Index corner) const { return dual_.twins[prev(corner)]; }

 private:
  const Connectivity& dual_;
  std::vector<Index> face_, first_;
  std::vector<uint8_t> dummy_;
};

// The first corner of each umbrella.
std::vector<Index> firstCorners(const Connectivity& dual) {
  std::vector<Index> first(dual.umbrella_count, kNone);
  for (Index c = static_cast<Index>(dual.umbrellas.size()); c-- > 0;) first[dual.umbrellas[c]] = c;
  return first;
}

// The dual's copies, as ranges of the mesh's corners. `begin`: per umbrella of the walk where the corners of its face
// begin, and where all end.
std::vector<ComponentCopy> copiesOf(const Connectivity& dual, const std::vector<Index>& begin) {
  const auto firstOf = [&](Index dual_corner) {
    return dual_corner < dual.umbrellas.size() ? begin[dual.umbrellas[dual_corner]] : begin.back();
  };
  std::vector<ComponentCopy> copies;
  for (const ComponentCopy& copy : dual.copies) {
    const Index corner = firstOf(copy.corner), original = firstOf(copy.original);
    copies.push_back({corner, original, firstOf(copy.corner + copy.count) - corner});
  }
  return copies;
}

}  // namespace

Result<PrimalMesh> primalOf(const Connectivity& dual, const std::vector<Index>& dummies, const Limits& limits) {
  const WalkedDual walked(dual, dummies);
  PrimalMesh primal;
  Connectivity& mesh = primal.connectivity;
  std::vector<Index> primal_corner(dual.umbrellas.size(), kNone), begin;
  begin.reserve(dual.umbrella_count + size_t{1});
  for (const Index start : firstCorners(dual)) {
    if (start == kNone) return Error::kMalformed;
    begin.push_back(static_cast<Index>(primal.dual_corner.size()));
    if (walked.isDummy(start)) continue;
    const size_t before = primal.dual_corner.size();
    for (Index c = start; primal_corner[c] == kNone; c = walked.around(c)) {
      primal_corner[c] = static_cast<Index>(primal.dual_corner.size());
      primal.dual_corner.push_back(c);
      mesh.umbrellas.push_back(walked.face(c));
    }
    const Index degree = static_cast<Index>(primal.dual_corner.size() - before);
    if (degree < 3) return Error::kMalformed;
    mesh.face_degrees.push_back(degree);
  }
  mesh.umbrella_count = static_cast<Index>(dual.face_degrees.size());
  mesh.vertex_count = mesh.umbrella_count;
  primal.on_boundary.assign(mesh.umbrella_count, 0);
  std::vector<uint8_t> has_face(mesh.umbrella_count, 0);
  for (const Index umbrella : mesh.umbrellas) has_face[umbrella] = 1;
  for (Index c = 0; c < dual.umbrellas.size(); ++c) {
    if (!walked.isDummy(c)) continue;
    if (primal.on_boundary[walked.face(c)]++ != 0 || !has_face[walked.face(c)]) return Error::kMalformed;
  }
  mesh.twins.reserve(mesh.umbrellas.size());
  for (const Index c : primal.dual_corner) mesh.twins.push_back(primal_corner[walked.next(walked.around(c))]);
  if (mesh.face_degrees.size() > limits.max_faces || mesh.umbrellas.size() > limits.max_corners) {
    return Error::kLimitExceeded;
  }
  begin.push_back(static_cast<Index>(primal.dual_corner.size()));
  mesh.copies = copiesOf(dual, begin);
  return primal;
}

}  // namespace tutte
