#include <algorithm>

#include "codec/decode.h"
#include "codec/face_groups.h"
#include "codec/payload.h"
#include "codec/seams.h"
#include "gltf_ext/attribute_topology.h"
#include "gltf_ext/pack.h"

namespace tutte {
namespace {

/// Unpacks one payload, section by section.
class Unpacker {
 public:
  Unpacker(const PayloadView& payload, const Limits& limits) : payload_(payload), limits_(limits) {}

  Outcome<Done> topology() {
    for (const auto step : {&Unpacker::limits, &Unpacker::connectivity, &Unpacker::seams, &Unpacker::groups,
                            &Unpacker::rings, &Unpacker::triangles}) {
      if (Outcome<Done> done = (this->*step)(); !done) return done;
    }
    return Done{};
  }

  Outcome<Done> attributes() {
    if (!payload_.has(Section::kAttributes)) return Done{};
    const AttributeTopology topology = attributeTopology(connectivity_, seams_);
    Outcome<std::vector<Attribute>> values = decodeAttributes(topology, payload_[Section::kAttributes]);
    if (!values) return values.error();
    if (values->size() != payload_.counts.attributes) return failure(Error::kCountMismatch, Section::kAttributes);
    for (const Attribute& attribute : *values) {
      if (attribute.data.size() != uint64_t{mesh_.wedge_count} * attribute.stride()) {
        return failure(Error::kAttributes, Section::kAttributes);
      }
    }
    mesh_.attributes = *std::move(values);
    return Done{};
  }

  PolygonMesh take() && { return std::move(mesh_); }

 private:
  static Failure failure(Error error, Section section) { return failureOf(error, std::string(nameOf(section))); }

  Outcome<Done> limits() {
    const PayloadCounts& counts = payload_.counts;
    const bool fits = counts.vertices <= limits_.max_vertices && counts.faces <= limits_.max_faces &&
                      counts.corners <= limits_.max_corners && counts.triangles <= limits_.max_corners;
    if (!fits) return failureOf(Error::kLimitExceeded, "header");
    return Done{};
  }

  /// While it decodes, the walk may know a vertex as several umbrellas, and closes boundaries with dummy faces.
  static Limits walkLimits(const PayloadCounts& counts) {
    const auto sum = [](uint64_t a, uint64_t b) { return static_cast<Index>(std::min<uint64_t>(a + b, kNone - 1)); };
    return {sum(counts.vertices, counts.corners), sum(counts.faces, counts.corners),
            sum(counts.corners, counts.corners)};
  }

  Outcome<Done> connectivity() {
    const PayloadCounts& counts = payload_.counts;
    Result<Connectivity> connectivity = decode(payload_[Section::kConnectivity], walkLimits(counts));
    if (!connectivity) return failure(connectivity.error(), Section::kConnectivity);
    connectivity_ = *std::move(connectivity);
    mesh_.polygons = polygonsOf(connectivity_, &coded_of_decoded_);
    if (mesh_.polygons.vertex_count != counts.vertices || mesh_.polygons.face_degrees.size() != counts.faces ||
        mesh_.polygons.corners.size() != counts.corners) {
      return failure(Error::kCountMismatch, Section::kConnectivity);
    }
    return Done{};
  }

  Outcome<Done> seams() {
    mesh_.wedge_count = payload_.counts.wedges;
    if (!payload_.has(Section::kSeams)) {
      seams_ = withoutSeams(connectivity_, payload_.counts.attributes);
      return Done{};
    }
    Result<Seams> seams = decodeSeams(connectivity_, payload_[Section::kSeams], payload_.counts.attributes);
    if (!seams) return failure(seams.error(), Section::kSeams);
    seams_ = *std::move(seams);
    if (seams_.wedge_count != payload_.counts.wedges) return failure(Error::kCountMismatch, Section::kSeams);
    mesh_.wedges.reserve(coded_of_decoded_.size());
    for (const Index corner : coded_of_decoded_) mesh_.wedges.push_back(seams_.wedges[corner]);
    return Done{};
  }

  Outcome<Done> groups() {
    mesh_.group_count = payload_.counts.groups;
    if (!payload_.has(Section::kGroups)) return Done{};
    Result<std::vector<Index>> groups = decodeGroups(connectivity_, payload_[Section::kGroups], mesh_.group_count);
    if (!groups) return failure(groups.error(), Section::kGroups);
    mesh_.groups = *std::move(groups);
    return Done{};
  }

  Outcome<Done> rings() {
    if (!payload_.has(Section::kRings)) return Done{};
    Result<std::vector<Index>> owners = decodeRings(payload_[Section::kRings], payload_.counts.faces);
    if (!owners) return failure(owners.error(), Section::kRings);
    if (!ringsAreValid(*owners, mesh_.groups)) return failure(Error::kMalformed, Section::kRings);
    mesh_.ring_owners = *std::move(owners);
    return Done{};
  }

  Outcome<Done> triangles() {
    if (!payload_.has(Section::kTriangulation)) {
      mesh_.triangulation = fanTriangulation(mesh_.polygons, mesh_.ring_owners);
    } else {
      Result<Triangulation> triangles = decodeTriangulation(
          connectivity_, mesh_.ring_owners, payload_[Section::kTriangulation], payload_.counts.triangles);
      if (!triangles) return failure(triangles.error(), Section::kTriangulation);
      mesh_.triangulation = *std::move(triangles);
    }
    if (mesh_.triangulation.corners.size() == uint64_t{3} * payload_.counts.triangles) return Done{};
    return failure(Error::kCountMismatch, Section::kTriangulation);
  }

  const PayloadView& payload_;
  const Limits& limits_;
  Connectivity connectivity_;
  Seams seams_;
  std::vector<Index> coded_of_decoded_;
  PolygonMesh mesh_;
};

Outcome<PolygonMesh> unpackSections(std::span<const uint8_t> bytes, const Limits& limits, bool with_attributes) {
  const Result<PayloadView> payload = parsePayload(bytes);
  if (!payload) return failureOf(payload.error(), "header");
  Unpacker unpacker(*payload, limits);
  if (Outcome<Done> done = unpacker.topology(); !done) return done.error();
  if (with_attributes) {
    if (Outcome<Done> done = unpacker.attributes(); !done) return done.error();
  }
  return std::move(unpacker).take();
}

}  // namespace

Outcome<PolygonMesh> unpack(std::span<const uint8_t> payload, const Limits& limits) {
  return unpackSections(payload, limits, true);
}

Outcome<PolygonMesh> unpackTopology(std::span<const uint8_t> payload, const Limits& limits) {
  return unpackSections(payload, limits, false);
}

}  // namespace tutte
