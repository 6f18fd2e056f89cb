#include "gltf_ext/value_planes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

namespace tutte {
namespace {

// The first byte of a plane's stream: the profile in bits 0 and 1, the kind of its values in bits 2 to 4, then three
// flags.
constexpr uint8_t kProfileMask = 3, kKindMask = 7, kRanked = 32, kEchoes = 64, kCopies = 128;
constexpr int kKindShift = 2;

uint8_t headOf(const ValueFormat& format) {
  return static_cast<uint8_t>(static_cast<int>(format.profile) | static_cast<int>(format.kind) << kKindShift |
                              (format.ranked ? kRanked : 0) | (format.echoes ? kEchoes : 0) |
                              (format.copies ? kCopies : 0));
}

std::optional<ValueFormat> formatOf(const Plane& plane, uint8_t head) {
  const int profile = head & kProfileMask, kind = head >> kKindShift & kKindMask;
  if (profile > static_cast<int>(ValueProfile::kSmall) || kind > static_cast<int>(ValueKind::kAngular)) return {};
  return ValueFormat{plane.components,
                     plane.max,
                     static_cast<ValueProfile>(profile),
                     static_cast<ValueKind>(kind),
                     (head & kRanked) != 0,
                     (head & kEchoes) != 0,
                     (head & kCopies) != 0};
}

/// The values per site; empty when wedges of one site differ.
std::vector<int32_t> siteValues(const Plane& plane, const WedgeSites& wedges) {
  if (wedges.site_of.empty()) return plane.values;
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

void spreadValues(std::vector<int32_t>&& values, const WedgeSites& wedges, Plane& plane) {
  if (wedges.site_of.empty()) {
    plane.values = std::move(values);
    return;
  }
  const size_t components = plane.components;
  plane.values.resize(wedges.site_of.size() * components);
  int32_t* target = plane.values.data();
  for (const Index site : wedges.site_of) {
    const int32_t* const source = &values[site * components];
    for (size_t i = 0; i < components; ++i) *target++ = source[i];
  }
}

/// Where each site is, by the positions of its wedges; empty when there are none to predict from. They may lie in
/// `places`.
std::span<const int32_t> placesOf(std::span<const Plane> planes, size_t current, const WedgeSites& wedges,
                                  std::vector<int32_t>& places) {
  if (current == 0 || planes[0].kind != PlaneKind::kPosition) return {};
  if (wedges.site_of.empty()) return planes[0].values;
  places.resize(size_t{wedges.count} * 3);
  for (size_t w = 0; w < wedges.site_of.size(); ++w) {
    std::copy_n(&planes[0].values[w * 3], 3, &places[size_t{wedges.site_of[w]} * 3]);
  }
  return places;
}

/// One way to code a plane.
struct Way {
  ValueKind kind;
  bool ranked = false;
};

/// What an encoder tries; the smallest is kept. On large meshes it is told from so many sites: positions show early
/// what suits them, other attributes may change from part to part.
constexpr Index kMostTriedPositions = 2048, kMostTried = 8192;

std::vector<Way> waysFor(PlaneKind kind) {
  switch (kind) {
    case PlaneKind::kPosition:
      return {{ValueKind::kPoints},
              {ValueKind::kAngular},
              {ValueKind::kPoints, true},
              {ValueKind::kPlain, true},
              {ValueKind::kPlain}};
    case PlaneKind::kTexcoord: return {{ValueKind::kTexcoord}, {ValueKind::kLabel}, {ValueKind::kPlain}};
    case PlaneKind::kNormal:
    case PlaneKind::kDirection: return {{ValueKind::kDirection}, {ValueKind::kLabel}, {ValueKind::kPlain}};
    default: return {{ValueKind::kPlain, true}, {ValueKind::kLabel}, {ValueKind::kPlain}};
  }
}

bool hasTriangles(const ValueGraph& graph) {
  for (Index corner = 0; corner < graph.cornerCount(); ++corner) {
    if (graph.degree(corner) == 3) return true;
  }
  return false;
}

/// How many 128ths more bytes another kind may take that is quicker.
size_t slownessOf(const ValueFormat& format) {
  if (format.profile == ValueProfile::kSmall) return 0;
  switch (format.kind) {
    case ValueKind::kPoints: return 1;  // an eighth more time than plain
    case ValueKind::kAngular: return 2;
    default: return 0;
  }
}

/// How one plane may be coded; nothing is coded twice.
class Trials {
 public:
  Trials(const ValueSites& sites, std::span<const int32_t> values) : sites_(sites), values_(values) {}

  /// The one of the formats that takes the fewest bytes for the first `most` sites; the last one can always be had.
  ValueFormat bestOf(std::span<const ValueFormat> formats, Index most) {
    std::optional<ValueFormat> best;
    size_t least = 0;
    for (const ValueFormat& format : formats) {
      const std::optional<ValueEstimate>& made = estimate(format, most);
      if (!made) continue;
      const size_t price = made->size + made->size * slownessOf(format) / 128;
      if (best && price >= least) continue;
      best = format;
      least = price;
    }
    return best.value_or(formats.back());
  }

  /// All sites.
  std::vector<uint8_t> encode(const ValueFormat& format) {
    const std::optional<ValueEstimate>& made = estimate(format, kNone);
    return made ? made->bytes : std::vector<uint8_t>();
  }

 private:
  struct Trial {
    ValueFormat format;
    Index most;
    std::optional<ValueEstimate> made;
  };

  const std::optional<ValueEstimate>& estimate(const ValueFormat& format, Index most) {
    most = std::min(most, sites_.graph.siteCount());
    for (const Trial& trial : trials_) {
      if (trial.format == format && trial.most == most) return trial.made;
    }
    trials_.push_back({format, most, estimateValues(sites_, format, values_, most)});
    return trials_.back().made;
  }

  const ValueSites& sites_;
  const std::span<const int32_t> values_;
  std::vector<Trial> trials_;
};

/// True when at least one value in 64 has been there before, as far as a small table tells.
bool repeats(std::span<const int32_t> values, size_t components) {
  std::vector<size_t> last(size_t{1} << std::bit_width(values.size()), values.size());
  size_t found = 0;
  for (size_t i = 0; i < values.size(); i += components) {
    const auto value = values.subspan(i, components);
    uint32_t hash = 0;
    for (const int32_t x : value) hash = (hash ^ static_cast<uint32_t>(x)) * 0x9E3779B1u + 0x7F4A7C15u;
    size_t& slot = last[(hash ^ hash >> 15) & (last.size() - 1)];
    found += slot < i && std::ranges::equal(values.subspan(slot, components), value);
    slot = i;
  }
  return found * 64 >= values.size() / components;
}

/// A format, and with copies too; ranks do not move as values do, so that the usual format may be better then.
std::vector<ValueFormat> withCopies(ValueFormat format, ValueFormat usual) {
  std::vector<ValueFormat> formats;
  for (ValueFormat copying : {format, usual}) {
    copying.copies = true;
    formats.push_back(copying);
  }
  formats.push_back(format);
  return formats;
}

void writePlane(const ValueSites& sites, const Plane& plane, std::span<const int32_t> values, ValueProfile profile,
                ByteWriter& out) {
  std::vector<ValueFormat> formats;
  for (const Way& way : waysFor(plane.kind)) {
    if (way.kind == ValueKind::kAngular && !hasTriangles(sites.graph)) continue;
    formats.push_back({plane.components, plane.max, profile, way.kind, way.ranked});
    ValueFormat& format = formats.back();
    if (way.kind == ValueKind::kDirection) format.weighting = findWeighting(sites, format, values);
  }
  Trials trials(sites, values);
  const Index most = plane.kind == PlaneKind::kPosition ? kMostTriedPositions : kMostTried;
  ValueFormat format = trials.bestOf(formats, most);
  if (repeats(values, plane.components)) {
    ValueFormat echoing = format.kind == ValueKind::kLabel ? formats.front() : format;
    echoing.echoes = true;
    format = trials.bestOf(std::array{echoing, format}, most);
  }
  if (!sites.graph.copies().empty()) format = trials.bestOf(withCopies(format, formats.front()), kNone);
  if (profile == ValueProfile::kSmall) {  // where values are very regular, fewer contexts learn faster
    ValueFormat quicker = format;
    quicker.profile = ValueProfile::kDefault;
    format = trials.bestOf(std::array{quicker, format}, kNone);
  }
  const std::vector<uint8_t> bytes = trials.encode(format);
  out.byte(headOf(format));
  out.varint(static_cast<uint32_t>(bytes.size()));
  out.append(bytes);
}

bool readPlane(const ValueSites& sites, const WedgeSites& wedges, ByteReader& in, Plane& plane) {
  const size_t before = in.remaining();
  const uint8_t head = in.byte();
  const uint32_t size = in.varint();
  const std::span<const uint8_t> bytes = in.take(size);
  plane.coded_bytes = static_cast<uint32_t>(before - in.remaining());
  const std::optional<ValueFormat> format = formatOf(plane, head);
  if (in.error() != Error::kNone || !format) return false;
  Result<std::vector<int32_t>> values = decodeValues(sites, *format, bytes);
  if (!values) return false;
  spreadValues(*std::move(values), wedges, plane);
  return true;
}

}  // namespace

Outcome<std::vector<uint8_t>> encodeValuePlanes(const AttributeTopology& topology, std::span<const Plane> planes,
                                                ValueProfile profile) {
  if (!isConsistent(topology)) return Failure{FailureKind::kInvalid, "", "the attributes' topology contradicts itself"};
  if (topology.wedge_count == 0) return std::vector<uint8_t>();
  SiteLayouts layouts(topology);
  std::vector<int32_t> scratch;
  ByteWriter out;
  for (size_t i = 0; i < planes.size(); ++i) {
    const Plane& plane = planes[i];
    SiteLayout& layout = layouts.get(plane.attribute);
    const std::vector<int32_t> values = siteValues(plane, layout.wedges);
    if (values.empty() && layout.wedges.count > 0) {
      return Failure{FailureKind::kInvalid, "", "an attribute has two values where its seams allow one"};
    }
    const std::span<const int32_t> places = placesOf(planes, i, layout.wedges, scratch);
    writePlane({*layout.graph, places}, plane, values, profile, out);
  }
  return std::move(out).take();
}

bool decodeValuePlanes(const AttributeTopology& topology, SiteLayouts& layouts, std::span<const uint8_t> bytes,
                       std::span<Plane> planes) {
  if (!isConsistent(topology)) return false;
  if (topology.wedge_count == 0) return bytes.empty();
  std::vector<int32_t> scratch;
  ByteReader in(bytes);
  for (size_t i = 0; i < planes.size(); ++i) {
    SiteLayout& layout = layouts.get(planes[i].attribute);
    const std::span<const int32_t> places = placesOf(planes, i, layout.wedges, scratch);
    if (!readPlane({*layout.graph, places}, layout.wedges, in, planes[i])) return false;
  }
  return in.error() == Error::kNone && in.remaining() == 0;
}

}  // namespace tutte
