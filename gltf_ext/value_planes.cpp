#include "gltf_ext/value_planes.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace tutte {
namespace {

/// Where an attribute's values sit, and in which order they are coded.
struct Layout {
  WedgeSites wedges;
  std::optional<ValueGraph> graph;
  std::optional<SiteSequence> order;
};

/// The layouts of one mesh, made when they are first asked for; attributes with equal seams share one.
class Layouts {
 public:
  explicit Layouts(const AttributeTopology& topology) : topology_(topology) {}

  Layout& get(size_t attribute) {
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
    const auto site_of = [&](Index corner) { return layout->wedges.site_of[topology_.wedges[corner]]; };
    layout->graph.emplace(mesh, layout->wedges.count, site_of);
    layout->order.emplace(*layout->graph);
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
    if (mesh.vertexOf(static_cast<Index>(c)) >= mesh.vertex_count || topology.wedges[c] >= topology.wedge_count)
      return false;
  }
  return std::ranges::all_of(topology.seams, [&](auto seams) { return seams.empty() || seams.size() == corners; });
}

// The first byte of a plane's stream: the profile in bits 0 and 1, the kind of its values in bits 2 to 4, then kRanked.
constexpr uint8_t kProfileMask = 3, kKindMask = 7, kRanked = 32;
constexpr int kKindShift = 2;

uint8_t headOf(const ValueFormat& format) {
  return static_cast<uint8_t>(static_cast<int>(format.profile) | static_cast<int>(format.kind) << kKindShift |
                              (format.ranked ? kRanked : 0));
}

std::optional<ValueFormat> formatOf(const Plane& plane, uint8_t head) {
  const int profile = head & kProfileMask, kind = head >> kKindShift & kKindMask;
  if (profile > static_cast<int>(ValueProfile::kSmall) || kind > static_cast<int>(ValueKind::kLabel)) return {};
  if (head >= 2 * kRanked) return {};
  return ValueFormat{plane.components, plane.max, static_cast<ValueProfile>(profile), static_cast<ValueKind>(kind),
                     (head & kRanked) != 0};
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

/// Where each site is, by the positions of its wedges; empty when there are none to predict from.
std::vector<int32_t> placesOf(std::span<const Plane> planes, size_t current, const WedgeSites& wedges) {
  if (current == 0 || planes[0].kind != PlaneKind::kPosition) return {};
  std::vector<int32_t> places(size_t{wedges.count} * 3);
  for (size_t w = 0; w < wedges.site_of.size(); ++w) {
    std::copy_n(&planes[0].values[w * 3], 3, &places[size_t{wedges.site_of[w]} * 3]);
  }
  return places;
}

/// One way to code a plane.
struct Trial {
  ValueKind kind;
  bool ranked = false;
};

/// What an encoder tries; the smallest is kept.
std::vector<Trial> trialsFor(PlaneKind kind) {
  switch (kind) {
    case PlaneKind::kPosition:
      return {{ValueKind::kPoints}, {ValueKind::kPlain}, {ValueKind::kPoints, true}, {ValueKind::kPlain, true}};
    case PlaneKind::kTexcoord: return {{ValueKind::kTexcoord}, {ValueKind::kPlain}, {ValueKind::kLabel}};
    case PlaneKind::kNormal:
    case PlaneKind::kDirection: return {{ValueKind::kDirection}, {ValueKind::kPlain}, {ValueKind::kLabel}};
    default: return {{ValueKind::kPlain}, {ValueKind::kPlain, true}, {ValueKind::kLabel}};
  }
}

void writePlane(const ValueSites& sites, const Plane& plane, std::span<const int32_t> values, ValueProfile profile,
                ByteWriter& out) {
  uint8_t head = 0;
  std::vector<uint8_t> smallest;
  for (const Trial& trial : trialsFor(plane.kind)) {
    const ValueFormat format{plane.components, plane.max, profile, trial.kind, trial.ranked};
    ByteWriter bytes;
    if (!encodeValues(sites, format, values, bytes)) continue;
    if (!smallest.empty() && smallest.size() <= bytes.bytes().size()) continue;
    smallest = std::move(bytes).take();
    head = headOf(format);
  }
  out.byte(head);
  out.varint(static_cast<uint32_t>(smallest.size()));
  out.append(smallest);
}

bool readPlane(const ValueSites& sites, const WedgeSites& wedges, ByteReader& in, Plane& plane) {
  const size_t before = in.remaining();
  const uint8_t head = in.byte();
  const uint32_t size = in.varint();
  const std::span<const uint8_t> bytes = in.take(size);
  plane.coded_bytes = static_cast<uint32_t>(before - in.remaining());
  const std::optional<ValueFormat> format = formatOf(plane, head);
  if (in.error() != Error::kNone || !format) return false;
  const Result<std::vector<int32_t>> values = decodeValues(sites, *format, bytes);
  if (!values) return false;
  spreadValues(*values, wedges, plane);
  return true;
}

}  // namespace

Outcome<std::vector<uint8_t>> encodeValuePlanes(const AttributeTopology& topology, std::span<const Plane> planes,
                                                ValueProfile profile) {
  if (!consistent(topology)) return Failure{FailureKind::kInvalid, "", "the attributes' topology contradicts itself"};
  if (topology.wedge_count == 0) return std::vector<uint8_t>();
  Layouts layouts(topology);
  ByteWriter out;
  for (size_t i = 0; i < planes.size(); ++i) {
    const Plane& plane = planes[i];
    Layout& layout = layouts.get(plane.attribute);
    const std::vector<int32_t> values = siteValues(plane, layout.wedges);
    if (values.empty() && layout.wedges.count > 0) {
      return Failure{FailureKind::kInvalid, "", "an attribute has two values where its seams allow one"};
    }
    const std::vector<int32_t> places = placesOf(planes, i, layout.wedges);
    writePlane({*layout.graph, *layout.order, places}, plane, values, profile, out);
  }
  return std::move(out).take();
}

bool decodeValuePlanes(const AttributeTopology& topology, std::span<const uint8_t> bytes, std::span<Plane> planes) {
  if (!consistent(topology)) return false;
  if (topology.wedge_count == 0) return bytes.empty();
  Layouts layouts(topology);
  ByteReader in(bytes);
  for (size_t i = 0; i < planes.size(); ++i) {
    Layout& layout = layouts.get(planes[i].attribute);
    const std::vector<int32_t> places = placesOf(planes, i, layout.wedges);
    if (!readPlane({*layout.graph, *layout.order, places}, layout.wedges, in, planes[i])) return false;
  }
  return in.error() == Error::kNone && in.remaining() == 0;
}

}  // namespace tutte
