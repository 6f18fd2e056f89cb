#pragma once
// A script that is watched: what its symbols say is also told to an observer. The walk and the statistics know nothing
// of it.

#include <utility>

#include "codec/gaps.h"
#include "codec/walk.h"

namespace tutte {

/// Watches nothing, and costs nothing. Other observers have the same members.
struct Unwatched {
  template <class Port>
  static void open(Port& /*valences*/, Port& /*degrees*/) {}
  static void component(bool) {}
  static void face(const FaceQuestion&, const FaceAnswer&, const Gaps&) {}
  static void vertex(const VertexQuestion&, Index) {}
  static void split(const SplitAnswer&) {}
};

/// `Script`, with an observer of its answers.
template <class Script, class Observer>
class Watched : public Script {
 public:
  template <class... Arguments>
  explicit Watched(Observer& observer, Arguments&&... arguments)
      : Script(std::forward<Arguments>(arguments)...), observer_(observer) {}

  bool component() {
    const bool another = Script::component();
    observer_.component(another);
    return another;
  }

  FaceAnswer face(const FaceQuestion& question, const Gaps& gaps) {
    const FaceAnswer answer = Script::face(question, gaps);
    observer_.face(question, answer, gaps);
    return answer;
  }

  VertexAnswer vertex(const VertexQuestion& question, const Gaps& gaps) {
    const VertexAnswer answer = Script::vertex(question, gaps);
    observer_.vertex(question, answer.valence);
    return answer;
  }

  SplitAnswer split(const VertexQuestion& question, const Gaps& gaps) {
    const SplitAnswer answer = Script::split(question, gaps);
    observer_.split(answer);
    return answer;
  }

 private:
  Observer& observer_;
};

}  // namespace tutte
