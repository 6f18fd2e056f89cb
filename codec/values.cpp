#include "codec/values.h"

#include "codec/value_port.h"
#include "codec/value_predictor.h"

namespace tutte {
namespace {

using values::DirectionGuide;
using values::NoGuide;
using values::SitePredictor;
using values::TexcoordGuide;

constexpr int32_t kMaxValue = (1 << 27) - 1, kMaxPoint = (1 << 20) - 1, kMaxTexcoord = (1 << 18) - 1;

/// Everything about one attribute in one direction; picks the templates one parameter at a time.
template <class Port>
struct Run {
  Port& port;
  const ValueSites& sites;
  const ValueFormat& format;
  std::span<int32_t> values;

  Error profile() {
    switch (format.profile) {
      case ValueProfile::kFast: return kind<1>();
      case ValueProfile::kDefault: return kind<2>();
      default: return kind<5>();
    }
  }

  template <int kInputs>
  Error kind() {
    switch (format.kind) {
      case ValueKind::kTexcoord: return code<kInputs, 2, TexcoordGuide>();
      case ValueKind::kDirection: return code<kInputs, 2, DirectionGuide>();
      default: return components<kInputs>();
    }
  }

  template <int kInputs>
  Error components() {
    switch (format.components) {
      case 1: return code<kInputs, 1, NoGuide<1>>();
      case 2: return code<kInputs, 2, NoGuide<2>>();
      case 3: return code<kInputs, 3, NoGuide<3>>();
      default: return code<kInputs, 4, NoGuide<4>>();
    }
  }

  template <int kInputs, int C, class Guide>
  Error code() {
    SitePredictor<Port, C, kInputs, Guide> predictor(port, sites.graph, sites.places, format.max,
                                                     format.kind == ValueKind::kPoints);
    Index until_check = 1;
    for (const Index site : sites.order) {
      predictor.code(site, std::span<int32_t, C>(&values[size_t{site} * C], size_t{C}));
      if (Port::kWriting || --until_check != 0) continue;
      if (port.overrun()) return Error::kTruncated;
      until_check = 1024;
    }
    return predictor.damaged() ? Error::kMalformed : Error::kNone;
  }
};

}  // namespace

bool supports(const ValueSites& sites, const ValueFormat& format) {
  if (format.components < 1 || format.components > 4 || format.max < 0 || format.max > kMaxValue) return false;
  const bool places = sites.places.size() == size_t{sites.graph.siteCount()} * 3;
  if (!places && !sites.places.empty()) return false;
  switch (format.kind) {
    case ValueKind::kPlain: return true;
    case ValueKind::kPoints: return format.components == 3 && format.max <= kMaxPoint;
    case ValueKind::kTexcoord: return format.components == 2 && format.max <= kMaxTexcoord && places;
    case ValueKind::kDirection: return format.components == 2 && format.max % 2 == 0 && format.max > 0;
  }
  return false;
}

void encodeValues(const ValueSites& sites, const ValueFormat& format, std::span<const int32_t> values, ByteWriter& out) {
  ValueWriter port;
  std::vector<int32_t> scratch(values.begin(), values.end());
  (void)Run<ValueWriter>{port, sites, format, scratch}.profile();
  std::move(port).finish(out);
}

Result<std::vector<int32_t>> decodeValues(const ValueSites& sites, const ValueFormat& format,
                                          std::span<const uint8_t> bytes) {
  if (!supports(sites, format)) return Error::kMalformed;
  ByteReader in(bytes);
  const uint32_t size = in.varint();
  const std::span<const uint8_t> decisions = in.take(size);
  if (in.error() != Error::kNone) return in.error();
  ValueReader port(decisions, bytes.subspan(in.position()));
  std::vector<int32_t> values(size_t{sites.graph.siteCount()} * format.components, 0);
  const Error error = Run<ValueReader>{port, sites, format, values}.profile();
  if (error != Error::kNone) return error;
  if (port.overrun()) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  return values;
}

}  // namespace tutte
