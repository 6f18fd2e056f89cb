#pragma once
// What Draco makes of the same mesh: the figures that `tutte bench` compares with.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gltf_ext/failure.h"
#include "gltf_ext/pack.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// What Draco is given.
enum class DracoInput : uint8_t {
  /// The mesh's own triangulation where it has one, fans otherwise.
  kTriangles,
  /// Fans, and a generic attribute per corner that is 1 opposite to the edges that were added, as Draco's OBJ reader
  /// makes it when asked to preserve polygons (but for faces of any degree).
  kPolygons,
  /// The triangles, and zeros for positions: the least that Draco can be asked for where only connectivity is wanted.
  kConnectivity,
};

/// Bytes and seconds (of processor time) of one mesh. Encoding starts with the finished draco::Mesh, triangulated and
/// welded, and ends with the .drc bytes; decoding starts with these and ends with a draco::Mesh.
struct DracoFigures {
  uint64_t connectivity_bytes = 0;  ///< growth of the buffer inside the connectivity step (with seams of attributes)
  uint64_t seam_bytes = 0;          ///< of these: what the step takes less for positions alone
  uint64_t attribute_bytes = 0;     ///< everything else but the 11 bytes of the header
  std::vector<std::pair<std::string, uint64_t>> by_attribute;  ///< of these: growth of the buffer inside each attribute
  uint64_t total_bytes = 0;                                    ///< the whole .drc
  double encode_seconds = 0;
  double connectivity_encode_seconds = 0;  ///< of these, inside the connectivity step
  double decode_seconds = 0;
  double connectivity_decode_seconds = 0;
  uint64_t decode_peak_bytes = 0;  ///< of memory, the decoded mesh included
};

/// Draco's edgebreaker on one mesh, as often as is asked for. Equal positions (and equal values of every attribute) are
/// welded, as Draco's own tools do. Floats are quantised with the bits of `options`; what our codec keeps without loss
/// (0 bits, integers, JOINTS, WEIGHTS) is kept by Draco, too. Draco drops degenerate triangles and isolated vertices.
class DracoBaseline {
 public:
  /// `level`: 0 (fastest) to 10 (smallest), as draco_encoder's -cl; its speed is 10 less this. `mesh` must outlive
  /// this.
  DracoBaseline(const PolygonMesh& mesh, const PackOptions& options, DracoInput input, int level);
  ~DracoBaseline();
  DracoBaseline(DracoBaseline&&) noexcept;

  /// Encodes and decodes once more. Fails with Draco's message when it refuses the mesh, for instance because no
  /// triangle is left, and from then on does nothing but fail.
  Outcome<Done> run();

  bool refused() const { return !failed_; }

  /// Bytes of every run, and the least time of each step.
  const DracoFigures& figures() const { return figures_; }

 private:
  struct Input;

  Outcome<Done> prepare();
  Outcome<Done> encode();
  Outcome<Done> decode();
  uint64_t seamBytes() const;

  const PolygonMesh& mesh_;
  PackOptions options_;
  DracoInput input_kind_;
  int level_;
  std::unique_ptr<Input> input_;  ///< once it is prepared
  DracoFigures figures_;
  int runs_ = 0;
  Outcome<Done> failed_ = Done{};
};

}  // namespace tutte
