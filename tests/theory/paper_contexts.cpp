#include "tests/theory/paper_contexts.h"

#include "codec/components.h"
#include "codec/encode.h"
#include "codec/encoder_memory.h"
#include "codec/range_coder.h"
#include "codec/script.h"
#include "codec/section.h"
#include "codec/statistics_paper.h"
#include "codec/walk.h"

namespace tutte::theory {
namespace {

/// Hides from the paper's statistics what its contexts are made of.
template <bool kValenceContexts, bool kDegreeContexts>
class Masked : public PaperStatistics {
 public:
  Masked(const SectionHeader& header, StatisticsMemory& memory) : PaperStatistics(header, memory), header_(header) {}

  template <class Port>
  FaceAnswer face(Port& port, FaceQuestion question, const FaceAnswer& truth) {
    // Where all degrees are equal, only dummy faces are coded, with contexts in either case.
    if (!kDegreeContexts && header_.uniform_degree == 0 && !question.closed) question.gap = nullptr;
    return PaperStatistics::face(port, question, truth);
  }

  template <class Port>
  Index vertex(Port& port, VertexQuestion question, Index truth, bool seed) {
    if (!kValenceContexts) question.degree = 6;  // as all that are not 3, 4 or 5
    return PaperStatistics::vertex(port, question, truth, seed);
  }

 private:
  const SectionHeader& header_;
};

template <bool kValenceContexts, bool kDegreeContexts>
size_t symbolBytes(const Topology& topology, const std::vector<ComponentPlan>& plans, const SectionHeader& header) {
  EncoderMemory memory;
  RangeWriter port;
  MeshOracle oracle(topology, plans, memory.oracle);
  Script<Masked<kValenceContexts, kDegreeContexts>, RangeWriter, MeshOracle> script(header, port, oracle,
                                                                                    memory.statistics);
  Walk walk(script, header.tie, header.leastDegree(), Limits{kNone, kNone, kNone}, topology.twin.size(), memory.gaps);
  if (walk.run() != Error::kNone) return 0;
  return std::move(port).finish().size();
}

}  // namespace

PaperBytes paperBytes(PolygonView mesh) {
  const Result<Encoded> encoded = encode(mesh, {.profile = Profile::kPaper, .effort = 0});
  Result<Topology> topology = buildTopology(mesh);
  SectionHeader header;
  if (!encoded || !topology || !readSection(encoded->bytes, header)) return {};
  const std::vector<ComponentPlan> plans = planComponents(*topology, Repeats::kNone);
  // The head, and what repairs the mesh, are the same in all of them.
  const size_t bytes = encoded->bytes.size(), symbols = symbolBytes<true, true>(*topology, plans, header);
  return {bytes, bytes - symbols + symbolBytes<true, false>(*topology, plans, header),
          bytes - symbols + symbolBytes<false, true>(*topology, plans, header),
          bytes - symbols + symbolBytes<false, false>(*topology, plans, header)};
}

}  // namespace tutte::theory
