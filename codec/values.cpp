#include "codec/values.h"

#include <algorithm>
#include <map>
#include <optional>

#include "codec/value_directions.h"
#include "codec/value_guide_any.h"
#include "codec/value_labels.h"
#include "codec/value_port.h"
#include "codec/value_predictor.h"
#include "codec/value_ranks.h"

namespace tutte {
namespace {

using values::AnyGuide;
using values::DirectionGuide;
using values::NoGuide;
using values::SitePredictor;
using values::TexcoordGuide;
using values::Weighting;

constexpr int32_t kMaxValue = (1 << 27) - 1, kMaxPoint = (1 << 20) - 1, kMaxTexcoord = (1 << 18) - 1;

/// Everything about one attribute in one direction.
template <class Port>
struct Run {
  Port& port;
  const ValueSites& sites;
  const ValueFormat& format;
  std::span<int32_t> values;
  Index most = kNone;  ///< sites that are coded at most
  Weighting weighting = Weighting::kEven;

  Error labels(uint32_t count) {
    values::LabelCoder<Port> coder(port, sites.graph, count);
    everySite([&] { coder.code(values); });
    return Error::kNone;
  }

  Error numbers() {
    if (format.kind == ValueKind::kPlain && format.max > kMaxPoint) return code<4, int64_t, NoGuide<4>>();
#if defined(TUTTE_COMPACT)
    return code<4, int32_t, AnyGuide>();
#else
    switch (format.kind) {
      case ValueKind::kTexcoord: return code<2, int32_t, TexcoordGuide<2>>();
      case ValueKind::kDirection: return code<2, int32_t, DirectionGuide<2>>();
      default: return code<4, int32_t, NoGuide<4>>();
    }
#endif
  }

  template <int C, class T, class Guide>
  Error code() {
    const bool fast = format.profile == ValueProfile::kFast;
    values::Residuals residuals(format.profile == ValueProfile::kSmall, !fast, sites.graph.siteCount());
    SitePredictor<Port, C, T, Guide> predictor(
        port, sites.graph, sites.places,
        {format.components, format.max, format.kind, fast, format.echoes, format.copies, weighting}, residuals);
    everySite([&] { predictor.code(values); });
    return predictor.damaged() ? Error::kMalformed : Error::kNone;
  }

  template <class Code>
  void everySite(Code code) {
    for (Index i = std::min(sites.graph.siteCount(), most); i > 0; --i) code();
  }
};

/// Longer lists cost more than they save.
constexpr size_t kMostRanks = 4096;
constexpr uint32_t kMostNames = 4096;

/// The different tuples of components, sorted, and the label of each site; empty when they are too many.
std::vector<int32_t> namesOf(std::span<const int32_t> values, int components, std::vector<int32_t>& labels) {
  const size_t most = std::min<size_t>(kMostNames, values.size() / components / 2 + 1);
  std::map<std::vector<int32_t>, int32_t> numbers;
  for (size_t i = 0; i < values.size(); i += components) {
    numbers.try_emplace({values.begin() + i, values.begin() + i + components});
    if (numbers.size() > most) return {};
  }
  std::vector<int32_t> names;
  for (auto& [name, number] : numbers) {
    number = static_cast<int32_t>(names.size() / components);
    names.insert(names.end(), name.begin(), name.end());
  }
  for (size_t i = 0; i < values.size(); i += components) {
    labels.push_back(numbers[{values.begin() + i, values.begin() + i + components}]);
  }
  return names;
}

bool encodeLabels(const ValueSites& sites, const ValueFormat& format, std::span<const int32_t> values, Index most,
                  ByteWriter& out, size_t& head) {
  std::vector<int32_t> labels;
  const std::vector<int32_t> names = namesOf(values, format.components, labels);
  if (names.empty()) return false;
  const auto count = static_cast<uint32_t>(names.size()) / format.components;
  out.varint(count);
  for (size_t i = 0; i < names.size(); ++i) {
    // The first components ascend; the others do not.
    const bool first = i % format.components == 0;
    const int32_t base = first && i > 0 ? names[i - format.components] : 0;
    out.varint(static_cast<uint32_t>(names[i] - base));
  }
  head = out.bytes().size();
  ValueWriter port;
  (void)Run<ValueWriter>{port, sites, format, labels, most}.labels(count);
  std::move(port).finish(out);
  return true;
}

std::vector<int32_t> readNames(ByteReader& in, const ValueFormat& format, uint32_t count) {
  std::vector<int32_t> names;
  for (size_t i = 0; i < size_t{count} * format.components; ++i) {
    const bool first = i % format.components == 0;
    const int64_t name = int64_t{first && i > 0 ? names[i - format.components] : 0} + in.varint();
    if (in.error() != Error::kNone || name > format.max) return {};
    names.push_back(static_cast<int32_t>(name));
  }
  return names;
}

/// The port's part of a stream, which is everything that is left.
template <class Decode>
Error readPort(ByteReader& in, Decode decode) {
  if (in.error() != Error::kNone) return in.error();
  ValueReader port(in.take(in.remaining()));
  const Error error = decode(port);
  if (error != Error::kNone) return error;
  return port.wrongEnd() ? Error::kMalformed : Error::kNone;
}

Result<std::vector<int32_t>> decodeLabels(const ValueSites& sites, const ValueFormat& format, ByteReader& in) {
  const uint32_t count = in.varint();
  if (count == 0 || count > kMostNames) return Error::kMalformed;
  const std::vector<int32_t> names = readNames(in, format, count);
  if (names.empty()) return Error::kMalformed;
  std::vector<int32_t> labels(sites.graph.siteCount(), 0);
  const Error error = readPort(in, [&](ValueReader& port) {
    return Run<ValueReader>{port, sites, format, labels}.labels(count);
  });
  if (error != Error::kNone) return error;
  std::vector<int32_t> values(labels.size() * format.components);
  for (size_t site = 0; site < labels.size(); ++site) {
    std::copy_n(&names[static_cast<size_t>(labels[site]) * format.components], format.components,
                &values[site * format.components]);
  }
  return values;
}

}  // namespace

bool supports(const ValueSites& sites, const ValueFormat& format) {
  if (format.components < 1 || format.components > 4 || format.max < 0 || format.max > kMaxValue) return false;
  const bool places = sites.places.size() == size_t{sites.graph.siteCount()} * 3;
  if (!places && !sites.places.empty()) return false;
  if (format.ranked && format.kind != ValueKind::kPlain && format.kind != ValueKind::kPoints) return false;
  if ((format.echoes || format.copies) && format.kind == ValueKind::kLabel) return false;
  switch (format.kind) {
    case ValueKind::kPlain:
    case ValueKind::kLabel: return true;
    case ValueKind::kPoints:
    case ValueKind::kAngular: return format.components == 3 && format.max <= kMaxPoint;
    case ValueKind::kTexcoord: return format.components == 2 && format.max <= kMaxTexcoord && places;
    case ValueKind::kDirection: return format.components == 2 && format.max % 2 == 0 && format.max > 0;
  }
  return false;
}

int8_t findWeighting(const ValueSites& sites, const ValueFormat& format, std::span<const int32_t> directions) {
  if (sites.places.empty()) return 0;
  // The one whose normals are nearest to the directions, whichever side these are on.
  std::array<int64_t, values::kWeightings> nearness{};
  for (int k = 0; k < values::kWeightings; ++k) {
    const auto normals =
        values::SurfaceNormals::of(sites.graph, values::Places(sites.places), static_cast<Weighting>(k));
    for (size_t site = 0; site < normals.size(); ++site) {
      const values::Vector3 normal{normals[site][0], normals[site][1], normals[site][2]};
      const auto direction = values::fromOctahedron(directions[2 * site], directions[2 * site + 1], format.max / 2);
      const int64_t along = values::dot(direction, normal) >> 16;
      nearness[k] += along * along;
    }
  }
  return static_cast<int8_t>(std::ranges::max_element(nearness) - nearness.begin());
}

namespace {

/// `head` becomes how much was written before the values.
bool encodeSome(const ValueSites& sites, const ValueFormat& format, std::span<const int32_t> values, Index most,
                ByteWriter& out, size_t& head) {
  if (!supports(sites, format) || values.empty()) return false;
  if (format.kind == ValueKind::kLabel) return encodeLabels(sites, format, values, most, out, head);
  std::vector<int32_t> scratch;
  ValueFormat coded = format;
  if (format.ranked) {
    const size_t longest =
        std::min({kMostRanks, static_cast<size_t>(format.max) / 2, size_t{sites.graph.siteCount()} / 2});
    const std::optional<ValueRanks> ranks = findRanks(values, format.components, format.max, longest);
    if (!ranks) return false;
    writeRanks(*ranks, out);
    scratch = toRanks(*ranks, values);
    coded.max = ranks->largest();
  } else {
    scratch.assign(values.begin(), values.end());
  }
  Weighting weighting = Weighting::kEven;
  if (format.kind == ValueKind::kDirection) {
    weighting = static_cast<Weighting>(format.weighting < 0 ? findWeighting(sites, format, values) : format.weighting);
    out.byte(static_cast<uint8_t>(weighting));
  }
  head = out.bytes().size();
  ValueWriter port;
  (void)Run<ValueWriter>{port, sites, coded, scratch, most, weighting}.numbers();
  std::move(port).finish(out);
  return true;
}

}  // namespace

bool encodeValues(const ValueSites& sites, const ValueFormat& format, std::span<const int32_t> values,
                  ByteWriter& out) {
  size_t head = 0;
  return encodeSome(sites, format, values, kNone, out, head);
}

std::optional<ValueEstimate> estimateValues(const ValueSites& sites, const ValueFormat& format,
                                            std::span<const int32_t> values, Index most) {
  ByteWriter out;
  size_t head = 0;
  if (!encodeSome(sites, format, values, most, out, head)) return {};
  const uint64_t total = sites.graph.siteCount();
  if (most >= total) return ValueEstimate{out.bytes().size(), std::move(out).take()};
  return ValueEstimate{head + static_cast<size_t>((out.bytes().size() - head) * total / most), {}};
}

Result<std::vector<int32_t>> decodeValues(const ValueSites& sites, const ValueFormat& format,
                                          std::span<const uint8_t> bytes) {
  if (!supports(sites, format)) return Error::kMalformed;
  ByteReader in(bytes);
  if (format.kind == ValueKind::kLabel) return decodeLabels(sites, format, in);
  ValueFormat coded = format;
  std::optional<ValueRanks> ranks;
  if (format.ranked) {
    ranks = readRanks(in, format.components, format.max);
    if (!ranks) return Error::kMalformed;
    coded.max = ranks->largest();
  }
  const uint8_t weighting = format.kind == ValueKind::kDirection ? in.byte() : 0;
  if (weighting >= values::kWeightings) return Error::kMalformed;
  std::vector<int32_t> values(size_t{sites.graph.siteCount()} * format.components, 0);
  const Error error = readPort(in, [&](ValueReader& port) {
    return Run<ValueReader>{port, sites, coded, values, kNone, static_cast<Weighting>(weighting)}.numbers();
  });
  if (error != Error::kNone) return error;
  if (ranks && !fromRanks(*ranks, values)) return Error::kMalformed;
  return values;
}

}  // namespace tutte
