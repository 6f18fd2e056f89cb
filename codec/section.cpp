#include "codec/section.h"

namespace tutte {
namespace {

constexpr uint8_t kDegreeMask = 0x0F, kClosed = 0x10, kNewestFirst = 0x20, kRepairs = 0x40, kReserved = 0x80;

}  // namespace

std::vector<uint8_t> writeSection(const SectionHeader& header, const SectionStreams& streams) {
  ByteWriter writer;
  writer.byte(static_cast<uint8_t>(header.uniform_degree | (header.closed ? kClosed : 0) |
                                   (header.tie == TieRule::kNewestFirst ? kNewestFirst : 0) |
                                   (header.repairs ? kRepairs : 0)));
  if (!header.degreesKnown()) writer.varint(static_cast<uint32_t>(streams.degrees.size()));
  if (header.repairs) writer.varint(static_cast<uint32_t>(streams.repairs.size()));
  writer.append(streams.degrees);
  writer.append(streams.repairs);
  writer.append(streams.valences);
  return std::move(writer).take();
}

Result<SectionStreams> readSection(std::span<const uint8_t> bytes, SectionHeader& header) {
  ByteReader reader(bytes);
  const uint8_t flags = reader.byte();
  header.uniform_degree = flags & kDegreeMask;
  header.closed = flags & kClosed;
  header.repairs = flags & kRepairs;
  header.tie = flags & kNewestFirst ? TieRule::kNewestFirst : TieRule::kOldestFirst;
  const uint32_t degree_bytes = header.degreesKnown() ? 0 : reader.varint();
  const uint32_t repair_bytes = header.repairs ? reader.varint() : 0;
  SectionStreams streams;
  streams.degrees = reader.take(degree_bytes);
  streams.repairs = reader.take(repair_bytes);
  streams.valences = reader.take(reader.remaining());
  if (reader.error() != Error::kNone) return reader.error();
  const bool bad_degree = header.uniform_degree == 1 || header.uniform_degree == 2;
  if (flags & kReserved || bad_degree) return Error::kMalformed;
  return streams;
}

}  // namespace tutte
