#include "gltf_ext/value_planes.h"

#include <algorithm>
#include <memory>
#include <utility>


namespace tutte {
namespace {

/// Where an attribute's values sit, and in which order they are coded.
struct Layout {
  WedgeSites wedges;
  ValueGraph graph;
  std::vector<Index> order;
};

/// The layouts of one mesh, made when they are first asked for; attributes with equal seams share one.
class Layouts {
 public:
  explicit Layouts(const AttributeTopology& topology) : topology_(topology) {}

  const Layout& get(size_t attribute) {
    const bool positions = attribute == 0;
    const std::span<const uint8_t> seams = attribute < topology_.seams.size() ? topology_.seams[attribute] : none_;
    for (const Entry& entry : entries_) {
      const bool same = whole() || (entry.positions == positions && std::ranges::equal(entry.seams, seams));
      if (same) return *entry.layout;
    }
    entries_.push_back({positions, seams, make(positions, seams)});
    return *entries_.back().layout;
  }

 private:
  struct Entry {
    bool positions;
    std::span<const uint8_t> seams;
    std::unique_ptr<Layout> layout;
  };

  // Every vertex has one umbrella and one wedge: all attributes have the same sites.
  bool whole() const {
    const Connectivity& mesh = topology_.connectivity;
    return mesh.vertices.empty() && topology_.wedge_count == mesh.vertex_count &&
           std::ranges::equal(topology_.wedges, mesh.umbrellas);
  }

  std::unique_ptr<Layout> make(bool positions, std::span<const uint8_t> seams) const {
    const Connectivity& mesh = topology_.connectivity;
    auto layout = std::make_unique<Layout>();
    layout->wedges = positions ? joinVertices(mesh, topology_.wedges, topology_.wedge_count)
                               : joinWedges(mesh, topology_.wedges, topology_.wedge_count, seams);
    std::vector<Index> sites(topology_.wedges.size());
    for (size_t c = 0; c < sites.size(); ++c) sites[c] = layout->wedges.site_of[topology_.wedges[c]];
    layout->graph = buildValueGraph(mesh, std::move(sites), layout->wedges.count);
    layout->order = valueOrder(layout->graph);
    return layout;
  }

  const AttributeTopology& topology_;
  const std::span<const uint8_t> none_;
  std::vector<Entry> entries_;
};

bool consistent(const AttributeTopology& topology) {
  const Connectivity& mesh = topology.connectivity;
  const size_t corners = mesh.umbrellas.size();
  uint64_t sum = 0;
  for (const Index degree : mesh.face_degrees) sum += degree;
  if (sum != corners || mesh.twins.size() != corners || topology.wedges.size() != corners) return false;
  for (size_t c = 0; c < corners; ++c) {
    const bool twin_exists = mesh.twins[c] == kNone || mesh.twins[c] < corners;
    if (!twin_exists || mesh.umbrellas[c] >= mesh.umbrella_count) return false;
    if (mesh.vertexOf(static_cast<Index>(c)) >= mesh.vertex_count || topology.wedges[c] >= topology.wedge_count) return false;
  }
  return std::ranges::all_of(topology.seams, [&](auto seams) { return seams.empty() || seams.size() == corners; });
}

// The first byte of a plane's stream: profile in bits 0 and 1, kTangent.
constexpr uint8_t kProfileMask = 3, kTangent = 4;

ValueFormat formatOf(const Plane& plane, uint8_t head) {
  return {plane.components, plane.max, static_cast<ValueProfile>(head & kProfileMask), (head & kTangent) != 0};
}

/// The values per site; empty when wedges of one site differ.
std::vector<int32_t> siteValues(const Plane& plane, const WedgeSites& wedges) {
  const size_t components = plane.components;
  std::vector<int32_t> values(wedges.count * components, -1);
  for (size_t w = 0; w < wedges.site_of.size(); ++w) {
    int32_t* const target = &values[wedges.site_of[w] * components];
    const int32_t* const source = &plane.values[w * components];
    if (*target < 0) std::copy_n(source, components, target);
    if (!std::equal(source, source + components, target)) return {};
  }
  return values;
}

void spreadValues(std::span<const int32_t> values, const WedgeSites& wedges, Plane& plane) {
  const size_t components = plane.components;
  plane.values.resize(wedges.site_of.size() * components);
  for (size_t w = 0; w < wedges.site_of.size(); ++w) {
    std::copy_n(&values[wedges.site_of[w] * components], components, &plane.values[w * components]);
  }
}

std::vector<uint8_t> encodePlane(const Layout& layout, const Plane& plane, std::span<const int32_t> values, uint8_t head) {
  ByteWriter out;
  encodeValues(layout.graph, layout.order, formatOf(plane, head), values, out);
  return std::move(out).take();
}

void writePlane(const Layout& layout, const Plane& plane, std::span<const int32_t> values, ValueProfile profile,
                ByteWriter& out) {
  auto head = static_cast<uint8_t>(profile);
  std::vector<uint8_t> bytes = encodePlane(layout, plane, values, head);
  if (plane.kind == PlaneKind::kPosition) {
    std::vector<uint8_t> bent = encodePlane(layout, plane, values, head | kTangent);
    if (bent.size() < bytes.size()) {
      bytes = std::move(bent);
      head |= kTangent;
    }
  }
  out.byte(head);
  out.varint(static_cast<uint32_t>(bytes.size()));
  out.append(bytes);
}

bool readPlane(const Layout& layout, ByteReader& in, Plane& plane) {
  const uint8_t head = in.byte();
  const uint32_t size = in.varint();
  const std::span<const uint8_t> bytes = in.take(size);
  if (in.error() != Error::kNone || head > (kProfileMask | kTangent)) return false;
  if ((head & kProfileMask) > static_cast<uint8_t>(ValueProfile::kSmall)) return false;
  const Result<std::vector<int32_t>> values = decodeValues(layout.graph, layout.order, formatOf(plane, head), bytes);
  if (!values) return false;
  spreadValues(*values, layout.wedges, plane);
  return true;
}

}  // namespace

Outcome<std::vector<uint8_t>> encodeValuePlanes(const AttributeTopology& topology, std::span<const Plane> planes,
                                                ValueProfile profile) {
  if (!consistent(topology)) return Failure{FailureKind::kInvalid, "", "the attributes' topology contradicts itself"};
  Layouts layouts(topology);
  ByteWriter out;
  for (const Plane& plane : planes) {
    const Layout& layout = layouts.get(plane.attribute);
    const std::vector<int32_t> values = siteValues(plane, layout.wedges);
    if (values.empty() && layout.wedges.count > 0) {
      return Failure{FailureKind::kInvalid, "", "an attribute has two values where its seams allow one"};
    }
    writePlane(layout, plane, values, profile, out);
  }
  return std::move(out).take();
}

bool decodeValuePlanes(const AttributeTopology& topology, std::span<const uint8_t> bytes, std::span<Plane> planes) {
  if (!consistent(topology)) return false;
  Layouts layouts(topology);
  ByteReader in(bytes);
  for (Plane& plane : planes) {
    if (!readPlane(layouts.get(plane.attribute), in, plane)) return false;
  }
  return in.error() == Error::kNone && in.remaining() == 0;
}

}  // namespace tutte
