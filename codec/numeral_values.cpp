#include "codec/numeral_values.h"

#include <algorithm>

#include "codec/numeral_coder.h"
#include "codec/value_port.h"

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
         one >= 0 && one <= system.allDigits();
}

std::vector<uint8_t> encodeNumerals(const ValueGraph& graph, const NumeralFormat& format,
                                    std::span<const uint32_t> floats) {
  ValueWriter port;
  numerals::SiteCoder<ValueWriter> coder(port, graph, format);
  const auto count = static_cast<size_t>(format.components);
  std::array<uint32_t, numerals::kMostComponents> bits{};
  for (size_t site = 0; site < graph.siteCount(); ++site) {
    std::copy_n(&floats[site * count], count, bits.begin());
    coder.code(bits);
  }
  ByteWriter out;
  std::move(port).finish(out);
  return std::move(out).take();
}

Result<std::vector<uint32_t>> decodeNumerals(const ValueGraph& graph, const NumeralFormat& format,
                                             std::span<const uint8_t> bytes) {
  if (!format.valid()) return Error::kMalformed;
  ValueReader port(bytes);
  numerals::SiteCoder<ValueReader> coder(port, graph, format);
  const auto count = static_cast<size_t>(format.components);
  std::vector<uint32_t> floats(graph.siteCount() * count);
  for (size_t site = 0; site < graph.siteCount(); ++site) {
    coder.code(std::span(floats).subspan(site * count, count));
    if (coder.damaged()) return Error::kMalformed;
  }
  return port.wrongEnd() ? Result<std::vector<uint32_t>>(Error::kMalformed) : floats;
}

}  // namespace tutte
