#include "codec/section.h"

namespace tutte {
namespace {

constexpr uint8_t kDegreeMask = 0x0F, kClosed = 0x10, kNewestFirst = 0x20, kRepairs = 0x40, kCopies = 0x80;
constexpr uint8_t kProfileMask = 0x03, kMatch = 0x04, kTableMask = 0x38, kDual = 0x40, kReserved = 0x80;
constexpr int kTableShift = 3, kLeastTableBits = 5;

}  // namespace

std::vector<uint8_t> writeSection(const SectionHeader& header, std::span<const uint8_t> symbols) {
  ByteWriter writer;
  writer.byte(static_cast<uint8_t>(header.uniform_degree | (header.closed ? kClosed : 0) |
                                   (header.tie == TieRule::kNewestFirst ? kNewestFirst : 0) |
                                   (header.repairs ? kRepairs : 0) | (header.copies ? kCopies : 0)));
  writer.byte(static_cast<uint8_t>(static_cast<int>(header.profile) | (header.match ? kMatch : 0) |
                                   (header.dual ? kDual : 0) | (header.table_bits - kLeastTableBits) << kTableShift));
  writer.append(symbols);
  return std::move(writer).take();
}

Result<std::span<const uint8_t>> readSection(std::span<const uint8_t> bytes, SectionHeader& header) {
  ByteReader reader(bytes);
  const uint8_t flags = reader.byte();
  header.uniform_degree = flags & kDegreeMask;
  header.closed = flags & kClosed;
  header.repairs = flags & kRepairs;
  header.copies = flags & kCopies;
  header.tie = flags & kNewestFirst ? TieRule::kNewestFirst : TieRule::kOldestFirst;
  const uint8_t statistics = reader.byte();
  header.profile = static_cast<Profile>(statistics & kProfileMask);
  header.match = statistics & kMatch;
  header.dual = statistics & kDual;
  header.table_bits = ((statistics & kTableMask) >> kTableShift) + kLeastTableBits;
  const std::span<const uint8_t> symbols = reader.take(reader.remaining());
  if (reader.error() != Error::kNone) return reader.error();
  const bool bad_degree = header.uniform_degree != 0 && header.uniform_degree < header.leastDegree();
  if (statistics & kReserved || bad_degree || header.table_bits > mostTableBits(bytes.size())) {
    return Error::kMalformed;
  }
  return symbols;
}

}  // namespace tutte
