#include "codec/numeral_values.h"

#include <algorithm>

#include "codec/numeral_coder.h"
#include "codec/range_coder.h"

namespace tutte {

bool NumeralFormat::valid() const {
  if (components < 1 || components > 4) return false;
  for (int i = 0; i < components; ++i) {
    if (!systems[i].valid()) return false;
  }
  if (relation == Relation::kNone) return true;
  if (relation > Relation::kUnitSum || (relation == Relation::kUnitVector && components < 3)) return false;
  const int related = relation == Relation::kUnitVector ? 3 : components;
  const NumeralSystem& system = systems[0];
  const int one = system.spare() - system.top;
  return std::all_of(systems.begin(), systems.begin() + related, [&](const auto& other) { return other == system; }) &&
         one >= 0 && one <= system.digits + system.spare();
}

std::vector<uint8_t> encodeNumerals(const ValueGraph& graph, const NumeralFormat& format,
                                    std::span<const uint32_t> floats) {
  RangeWriter port;
  numerals::SiteCoder<RangeWriter> coder(port, graph, format);
  const size_t count = static_cast<size_t>(format.components);
  std::array<uint32_t, numerals::kMostComponents> bits{};
  for (Index site = 0; site < graph.siteCount(); ++site) {
    std::copy_n(&floats[site * count], count, bits.begin());
    coder.code(site, bits);
  }
  return std::move(port).finish();
}

Result<std::vector<uint32_t>> decodeNumerals(const ValueGraph& graph, const NumeralFormat& format,
                                             std::span<const uint8_t> bytes) {
  if (!format.valid()) return Error::kMalformed;
  RangeReader port(bytes);
  numerals::SiteCoder<RangeReader> coder(port, graph, format);
  const size_t count = static_cast<size_t>(format.components);
  std::vector<uint32_t> floats(graph.siteCount() * count);
  for (Index site = 0; site < graph.siteCount(); ++site) {
    coder.code(site, std::span(floats).subspan(site * count, count));
    if (coder.damaged()) return Error::kMalformed;
    if (site % 1024 == 0 && port.overrun()) return Error::kTruncated;
  }
  if (port.overrun()) return Error::kTruncated;
  return port.trailing() ? Result<std::vector<uint32_t>>(Error::kTrailingBytes) : floats;
}

}  // namespace tutte
