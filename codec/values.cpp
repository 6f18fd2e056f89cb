#include "codec/values.h"

#include "codec/value_port.h"
#include "codec/value_predictor.h"

namespace tutte {
namespace {

template <int kInputs, int C, class Port>
Error run(Port& port, const ValueGraph& graph, std::span<const Index> order, const ValueFormat& format,
          std::span<int32_t> values) {
  values::SitePredictor<Port, C, kInputs> predictor(port, graph, format.max, format.tangent);
  Index until_check = 1024;
  for (const Index site : order) {
    predictor.code(site, std::span<int32_t, C>(&values[size_t{site} * C], size_t{C}));
    if (!Port::kWriting && --until_check == 0) {
      if (port.overrun()) return Error::kTruncated;
      until_check = 1024;
    }
  }
  return predictor.damaged() ? Error::kMalformed : Error::kNone;
}

template <int kInputs, class Port>
Error runComponents(Port& port, const ValueGraph& graph, std::span<const Index> order, const ValueFormat& format,
                    std::span<int32_t> values) {
  switch (format.components) {
    case 1: return run<kInputs, 1>(port, graph, order, format, values);
    case 2: return run<kInputs, 2>(port, graph, order, format, values);
    case 3: return run<kInputs, 3>(port, graph, order, format, values);
    default: return run<kInputs, 4>(port, graph, order, format, values);
  }
}

template <class Port>
Error runProfile(Port& port, const ValueGraph& graph, std::span<const Index> order, const ValueFormat& format,
                 std::span<int32_t> values) {
  switch (format.profile) {
    case ValueProfile::kFast: return runComponents<1>(port, graph, order, format, values);
    case ValueProfile::kDefault: return runComponents<2>(port, graph, order, format, values);
    default: return runComponents<5>(port, graph, order, format, values);
  }
}

}  // namespace

void encodeValues(const ValueGraph& graph, std::span<const Index> order, const ValueFormat& format,
                  std::span<const int32_t> values, ByteWriter& out) {
  ValueWriter port;
  std::vector<int32_t> scratch(values.begin(), values.end());
  (void)runProfile(port, graph, order, format, scratch);
  std::move(port).finish(out);
}

Result<std::vector<int32_t>> decodeValues(const ValueGraph& graph, std::span<const Index> order,
                                          const ValueFormat& format, std::span<const uint8_t> bytes) {
  ByteReader in(bytes);
  const uint32_t size = in.varint();
  const std::span<const uint8_t> decisions = in.take(size);
  if (in.error() != Error::kNone) return in.error();
  ValueReader port(decisions, bytes.subspan(in.position()));
  std::vector<int32_t> values(size_t{graph.site_count} * format.components, 0);
  const Error error = runProfile(port, graph, order, format, values);
  if (error != Error::kNone) return error;
  if (port.overrun()) return Error::kTruncated;
  if (port.trailing()) return Error::kTrailingBytes;
  return values;
}

}  // namespace tutte
