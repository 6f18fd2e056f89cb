#pragma once
// Whether faces are as expected, for meshes in which nearly all are.

#include <algorithm>
#include <array>
#include <cstdint>

#include "codec/mesh.h"
#include "codec/questions.h"
#include "codec/sure_run.h"

namespace tutte {

/// One flag per face: it has the expected degree and is no dummy. Where it was so `kSure` times in a row before, in a
/// small context, the flag alone is coded, and nothing else is looked at.
template <int kSure>
class PlainFaces {
 public:
  /// Is it as good as certain that this face is plain? `expected`: the degree that it then has.
  [[gnu::always_inline]] bool isSure(const FaceQuestion& question, Index expected, bool may_be_dummy) {
    run_ = &runs_[contextOf(question, expected, may_be_dummy)];
    return run_->isSure(kSure);
  }

  /// Codes the flag, where isSure() said so.
  template <class Port>
  [[gnu::always_inline]] bool code(Port& port, bool plain) {
    return run_->code(port, plain);
  }

  /// To be told of every other face, after isSure().
  void note(bool plain) { run_->note(plain); }

 private:
  using Run = SureRun<4>;

  // How many edges are known, and how many of the neighbours beside them are plain.
  static size_t contextOf(const FaceQuestion& question, Index expected, bool may_be_dummy) {
    if (question.gap == nullptr) return 0;
    const size_t plain = size_t{question.gap->degree_behind == expected} +
                         size_t{question.tail->degree_behind == expected} +
                         size_t{question.head->prev->degree_behind == expected};
    return size_t{question.known_edges > 1} << 3 | plain << 1 | size_t{may_be_dummy};
  }

  std::array<Run, 16> runs_;
  Run* run_ = nullptr;
};

}  // namespace tutte
