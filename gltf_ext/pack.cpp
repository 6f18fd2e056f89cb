#include "gltf_ext/pack.h"

#include <algorithm>
#include <cstring>

#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/face_groups.h"
#include "codec/payload.h"
#include "codec/seams.h"
#include "codec/wedges.h"
#include "gltf_ext/attribute_topology.h"
#include "gltf_ext/mesh_rules.h"
#include "gltf_ext/triangulate.h"
#include "gltf_ext/welding.h"

namespace tutte {
namespace {

/// Values per face of the input in coded order; nothing for nothing.
std::vector<Index> gather(const std::vector<Index>& values, const std::vector<Index>& order) {
  std::vector<Index> result;
  if (values.empty()) return result;
  result.reserve(order.size());
  for (const Index source : order) result.push_back(values[source]);
  return result;
}

std::vector<Index> inverse(const std::vector<Index>& order) {
  std::vector<Index> result(order.size());
  for (Index i = 0; i < order.size(); ++i) result[order[i]] = i;
  return result;
}

/// Packs one mesh, section by section, over its own polygons or over welded ones.
class Packer {
 public:
  Packer(const PolygonMesh& mesh, const Polygons& polygons, const PackOptions& options)
      : mesh_(mesh), polygons_(polygons), options_(options) {}

  /// Connectivity and seams.
  Outcome<Done> begin() {
    if (Outcome<Done> done = connectivity(); !done) return done;
    return seams();
  }

  uint32_t bytesSoFar() const { return packed_.connectivity_bytes + packed_.seam_bytes; }

  /// Everything else, after begin().
  Outcome<Packed> finish() {
    for (const auto step : {&Packer::groups, &Packer::rings, &Packer::triangles, &Packer::attributes}) {
      if (Outcome<Done> done = (this->*step)(); !done) return done.error();
    }
    parts_.counts.vertices = mesh_.polygons.vertex_count;
    parts_.counts.welded = mesh_.polygons.vertex_count - polygons_.vertex_count;
    parts_.counts.wedges = static_cast<Index>(numbering_.order.size());
    parts_.counts.faces = static_cast<Index>(encoded_.connectivity.face_degrees.size());
    parts_.counts.corners = static_cast<Index>(encoded_.connectivity.umbrellas.size());
    packed_.bytes = writePayload(parts_);
    packed_.wedge_order = std::move(numbering_.order);
    packed_.face_order = std::move(encoded_.face_order);
    return std::move(packed_);
  }

 private:
  Outcome<Done> connectivity() {
    EncodeOptions options = options_.connectivity;
    options.values_follow = !mesh_.attributes.empty();
    Result<Encoded> encoded = encode(polygons_, options);
    if (!encoded) return failureOf(encoded.error(), "connectivity");
    encoded_ = std::move(*encoded);
    packed_.splits = encoded_.splits;
    packed_.connectivity_bytes = static_cast<uint32_t>(encoded_.bytes.size());
    parts_.set(Section::kConnectivity, std::move(encoded_.bytes));
    decoded_polygons_ = polygonsOf(encoded_.connectivity, &coded_of_decoded_);
    packed_.corner_order = gather(encoded_.corner_order, coded_of_decoded_);
    return Done{};
  }

  Outcome<Done> seams() {
    if (Outcome<Done> done = numberWedges(); !done) return done;
    reorderAttributes();
    if (Outcome<Done> done = checkPositions(); !done) return done;
    decoded_seams_ = withoutSeams(encoded_.connectivity, static_cast<Index>(attributes_.size()));
    if (!welded() && numbering_.parts == verticesOf(encoded_.connectivity)) return Done{};

    std::vector<ValueView> values;
    for (const Attribute& attribute : attributes_) values.push_back({attribute.data, attribute.stride()});
    std::vector<uint8_t> bytes = encodeSeams(encoded_.connectivity, vertices_, numbering_.parts, values);
    Result<Seams> seams = decodeSeams(encoded_.connectivity, welded(), bytes, static_cast<Index>(values.size()));
    if (!seams) return failureOf(seams.error(), "seams");
    decoded_seams_ = std::move(*seams);
    packed_.seam_bytes = static_cast<uint32_t>(bytes.size());
    parts_.set(Section::kSeams, std::move(bytes));
    return Done{};
  }

  bool welded() const { return polygons_.vertex_count < mesh_.polygons.vertex_count; }

  Outcome<Done> numberWedges() {
    std::vector<Index> vertices = verticesOf(encoded_.connectivity);
    if (welded()) {
      Result<PartNumbering> numbering =
          numberParts(vertices, polygons_.vertex_count, gather(mesh_.polygons.corners, encoded_.corner_order),
                      mesh_.polygons.vertex_count);
      if (!numbering) return failureOf(numbering.error(), "vertices");
      vertices = vertices_ = std::move(numbering->parts);
    }
    const std::vector<Index>& wedges = mesh_.wedges.empty() ? mesh_.polygons.corners : mesh_.wedges;
    Result<PartNumbering> numbering =
        numberParts(vertices, mesh_.polygons.vertex_count, gather(wedges, encoded_.corner_order), mesh_.wedge_count);
    if (!numbering) return failureOf(numbering.error(), "wedges");
    numbering_ = std::move(*numbering);
    if (placeIsolated()) return Done{};
    return Failure{FailureKind::kInvalid, "wedges", "isolated vertices and unused wedges differ in number"};
  }

  /// Gives the wedges that no corner uses, in order, to the isolated vertices, in coded order.
  bool placeIsolated() {
    std::vector<uint8_t> used(mesh_.wedge_count);
    for (const Index wedge : numbering_.order) {
      if (wedge != kNone) used[wedge] = 1;
    }
    Index next = 0;
    for (Index& wedge : numbering_.order) {
      if (wedge != kNone) continue;
      while (next < used.size() && used[next]) ++next;
      if (next == used.size()) return false;
      wedge = next++;
    }
    return numbering_.order.size() == mesh_.wedge_count;
  }

  void reorderAttributes() {
    attributes_ = mesh_.attributes;
    for (size_t slot = 0; slot < attributes_.size(); ++slot) {
      const size_t stride = attributes_[slot].stride();
      const uint8_t* source = mesh_.attributes[slot].data.data();
      uint8_t* target = attributes_[slot].data.data();
      for (size_t i = 0; i < numbering_.order.size(); ++i) {
        std::memcpy(target + i * stride, source + numbering_.order[i] * stride, stride);
      }
    }
  }

  /// All wedges of a vertex must share slot 0; those of a point do.
  Outcome<Done> checkPositions() const {
    if (attributes_.empty()) return Done{};
    const size_t stride = attributes_[0].stride();
    std::vector<Index> first(encoded_.connectivity.vertex_count, kNone);
    for (Index corner = 0; corner < numbering_.parts.size(); ++corner) {
      Index& wedge = first[encoded_.connectivity.vertexOf(corner)];
      if (wedge == kNone) wedge = numbering_.parts[corner];
      const uint8_t* data = attributes_[0].data.data();
      if (std::memcmp(data + wedge * stride, data + numbering_.parts[corner] * stride, stride) != 0) {
        return Failure{FailureKind::kInvalid, "POSITION", "the wedges of a vertex have different positions"};
      }
    }
    return Done{};
  }

  Outcome<Done> groups() {
    parts_.counts.groups = std::max(mesh_.group_count, 1u);
    groups_ = gather(mesh_.groups, encoded_.face_order);
    if (parts_.counts.groups == 1) return Done{};
    groups_.resize(encoded_.connectivity.face_degrees.size());
    parts_.set(Section::kGroups, encodeGroups(encoded_.connectivity, groups_, parts_.counts.groups));
    return Done{};
  }

  Outcome<Done> rings() {
    owners_ = gather(mesh_.ring_owners, encoded_.face_order);
    const std::vector<Index> coded_of_input = inverse(encoded_.face_order);
    bool any = false;
    for (Index& owner : owners_) {
      if (owner == kNone) continue;
      owner = coded_of_input[owner];
      any = true;
    }
    if (!any) owners_.clear();
    if (any) parts_.set(Section::kRings, encodeRings(owners_));
    return Done{};
  }

  Outcome<Done> triangles() {
    const Triangulation triangulation = triangulationInCodedOrder();
    parts_.counts.triangles = static_cast<Index>(triangulation.corners.size() / 3);
    auto bytes = encodeTriangulation(encoded_.connectivity, owners_, triangulation);
    if (!bytes) return failureOf(bytes.error(), "triangulation");
    if (*bytes) parts_.set(Section::kTriangulation, **std::move(bytes));
    return Done{};
  }

  Triangulation triangulationInCodedOrder() const {
    const Triangulation& input = mesh_.triangulation;
    if (input.counts.empty()) return chosenTriangulation();
    std::vector<size_t> starts(input.counts.size());
    size_t start = 0;
    for (size_t face = 0; face < starts.size(); ++face) {
      starts[face] = start;
      start += size_t{3} * input.counts[face];
    }
    const std::vector<Index> coded_of_input = inverse(packed_.corner_order);
    Triangulation result;
    result.counts = gather(input.counts, encoded_.face_order);
    result.corners.reserve(input.corners.size());
    for (const Index face : encoded_.face_order) {
      for (size_t i = 0; i < size_t{3} * input.counts[face]; ++i) {
        result.corners.push_back(coded_of_input[input.corners[starts[face] + i]]);
      }
    }
    return result;
  }

  /// Chosen in coded order, because a fan from the first coded corner costs nothing.
  Triangulation chosenTriangulation() const {
    PolygonMesh mesh;
    mesh.polygons = decoded_polygons_;
    mesh.wedges = gather(numbering_.parts, coded_of_decoded_);
    mesh.wedge_count = mesh_.wedge_count;
    mesh.ring_owners = owners_;
    if (!attributes_.empty()) mesh.attributes = {attributes_[0]};
    triangulate(mesh);
    return std::move(mesh.triangulation);
  }

  Outcome<Done> attributes() {
    packed_.attribute_bytes = packed_.seam_bytes;
    parts_.counts.attributes = static_cast<Index>(attributes_.size());
    if (attributes_.empty()) return Done{};
    const AttributeTopology topology = attributeTopology(encoded_.connectivity, decoded_seams_);
    Outcome<std::vector<uint8_t>> bytes = encodeAttributes(topology, attributes_, options_);
    if (!bytes) return bytes.error();
    packed_.attribute_bytes += static_cast<uint32_t>(bytes->size());
    parts_.set(Section::kAttributes, *std::move(bytes));
    return Done{};
  }

  const PolygonMesh& mesh_;
  const Polygons& polygons_;  ///< over the mesh's vertices, or over fewer points
  const PackOptions& options_;
  Encoded encoded_;
  Polygons decoded_polygons_;            ///< the polygons as unpack() will give them
  std::vector<Index> coded_of_decoded_;  ///< their corners in coded order
  std::vector<Index> vertices_;          ///< per coded corner, if welded
  PartNumbering numbering_;              ///< of wedges
  Seams decoded_seams_;
  std::vector<Attribute> attributes_;  ///< in coded wedge order
  std::vector<Index> groups_, owners_;
  PayloadParts parts_;
  Packed packed_;
};

Outcome<Packed> packOver(const PolygonMesh& mesh, const Polygons& polygons, const PackOptions& options) {
  Packer packer(mesh, polygons, options);
  if (Outcome<Done> done = packer.begin(); !done) return done.error();
  return packer.finish();
}

/// Small meshes are coded both ways. In others, what positions take is guessed, from walks without a search.
Outcome<Packed> smallerOf(const PolygonMesh& mesh, const Polygons& welded_polygons, const PackOptions& options) {
  const bool guess = mesh.wedge_count > 1000 && options.connectivity.effort < 2;
  PackOptions first = options;
  first.connectivity.effort = guess ? 0 : options.connectivity.effort;
  Packer apart(mesh, mesh.polygons, first), welded(mesh, welded_polygons, first);
  for (Packer* packer : {&apart, &welded}) {
    if (Outcome<Done> done = packer->begin(); !done) return done.error();
  }
  if (guess) {
    const uint64_t saved = mesh.polygons.vertex_count - welded_polygons.vertex_count;  // a position is a byte or more
    const bool join = welded.bytesSoFar() < apart.bytesSoFar() + saved;
    if (options.connectivity.effort == 0) return (join ? welded : apart).finish();
    return packOver(mesh, join ? welded_polygons : mesh.polygons, options);
  }
  Outcome<Packed> a = apart.finish(), b = welded.finish();
  if (!a || !b) return a;
  return a->bytes.size() <= b->bytes.size() ? std::move(a) : std::move(b);
}

}  // namespace

PackOptions withoutLoss(PackOptions options) {
  options.position_bits = options.normal_bits = options.texcoord_bits = 0;
  options.color_bits = options.generic_bits = 0;
  options.errors = {};
  options.grid.reset();
  return options;
}

Outcome<Packed> pack(const PolygonMesh& mesh, const PackOptions& options) {
  if (Outcome<Done> valid = checkMesh(mesh); !valid) return valid.error();
  const std::optional<Polygons> welded = options.weld != false ? weldedPolygons(mesh) : std::nullopt;
  if (welded && !options.weld) return smallerOf(mesh, *welded, options);
  return packOver(mesh, welded ? *welded : mesh.polygons, options);
}

}  // namespace tutte
