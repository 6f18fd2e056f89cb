#include "codec/trace.h"

#include "codec/decode_section.h"

namespace tutte {
namespace {

// Turns the walk's questions and answers into events.
class Tracer : public Unwatched {
 public:
  static constexpr bool kSums = true;

  explicit Tracer(const TraceSink& sink) : sink_(sink) {}

  void component(bool another) {
    current_face_ = faces_;
    component_ = components_;
    sink_(start(another ? TraceEvent::Kind::kComponent : TraceEvent::Kind::kEnd));
    components_ += another;
  }

  void face(const FaceQuestion& question, const FaceAnswer& answer) {
    current_face_ = faces_;
    TraceEvent event = start(TraceEvent::Kind::kFace);
    event.degree = answer.degree;
    event.dummy = answer.dummy;
    event.closed = question.closed;
    event.seed = question.gap == nullptr;
    event.known_edges = question.known_edges;
    if (!event.seed) {
      event.gap = question.gap->number;
      event.degree_behind = question.gap->degree_behind;
    }
    sink_(event);
    faces_ += !answer.dummy;
  }

  void vertex(const VertexQuestion& question, Index valence) {
    missing_ = question.missing;
    if (valence == 0) return;  // split() follows
    TraceEvent event = start(TraceEvent::Kind::kVertex);
    event.valence = valence;
    event.missing = question.missing;
    event.known_vertices = question.knownVertices();
    event.valence_sum = question.valence_sum;
    sink_(event);
    ++umbrellas_;
  }

  void split(const SplitAnswer& answer) {
    TraceEvent event = start(TraceEvent::Kind::kSplit);
    event.gap = answer.gap;
    event.slots_after = answer.slots_after;
    event.missing = missing_;
    sink_(event);
  }

 private:
  TraceEvent start(TraceEvent::Kind kind) const {
    TraceEvent event;
    event.kind = kind;
    event.component = component_;
    event.face = current_face_;
    event.umbrella = umbrellas_;
    return event;
  }

  const TraceSink& sink_;
  Index components_ = 0, faces_ = 0, umbrellas_ = 0;  // begun so far
  Index component_ = 0, current_face_ = 0;
  Index missing_ = 0;
};

}  // namespace

Error trace(std::span<const uint8_t> bytes, const Limits& limits, const TraceSink& sink) {
  Tracer tracer(sink);
  CodecMemory memory;
  const Result<Connectivity> mesh = decodeSection(bytes, limits, tracer, memory);
  return mesh ? Error::kNone : mesh.error();
}

}  // namespace tutte
