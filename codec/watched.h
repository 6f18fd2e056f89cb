#pragma once
// A script that is watched: what its symbols say is also told to an observer. The walk and the statistics know nothing
// of it.

#include <utility>

#include "codec/gaps.h"
#include "codec/walk.h"

namespace tutte {

/// Watches nothing, and costs nothing. Other observers have the same members.
struct Unwatched {
  static constexpr bool kSums = false;  ///< wants sums of valences
  template <class Port>
  static void open(Port&) {}
  static void component(bool) {}
  static void face(const FaceQuestion&, const FaceAnswer&) {}
  static void vertex(const VertexQuestion&, Index) {}
  static void split(const SplitAnswer&) {}
};

/// `Script`, with an observer of its answers.
template <class Script, class Observer>
class Watched : public Script {
 public:
  static constexpr bool kSums = Script::kSums || Observer::kSums;

  template <class... Arguments>
  explicit Watched(Observer& observer, Arguments&&... arguments)
      : Script(std::forward<Arguments>(arguments)...), observer_(observer) {}

  bool component() {
    const bool another = Script::component();
    observer_.component(another);
    return another;
  }

  [[gnu::always_inline]] FaceAnswer face(const FaceQuestion& question) {
    const FaceAnswer answer = Script::face(question);
    observer_.face(question, answer);
    return answer;
  }

  [[gnu::always_inline]] VertexAnswer vertex(const VertexQuestion& question) {
    const VertexAnswer answer = Script::vertex(question);
    observer_.vertex(question, answer.valence);
    return answer;
  }

  VertexAnswer seedVertex(const VertexQuestion& question) {
    const VertexAnswer answer = Script::seedVertex(question);
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
