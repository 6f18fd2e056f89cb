#include "codec/payload.h"

#include <algorithm>

#include "codec/bytes.h"

namespace tutte {
namespace {

constexpr std::array<uint8_t, 4> kMagic = {'T', 'U', 'T', 'T'};
constexpr uint8_t kVersion = 0;
constexpr uint32_t kTriangleCountFlag = 1u << kSectionCount;
constexpr uint32_t kWeldedFlag = 2 * kTriangleCountFlag;
constexpr uint32_t kKnownFlags = 2 * kWeldedFlag - 1;

constexpr uint32_t flagOf(Section section) { return 1u << static_cast<int>(section); }

/// How many triangles there are when all faces are polygons without holes.
uint64_t usualTriangles(const PayloadCounts& counts) {
  return counts.corners >= 2 * uint64_t{counts.faces} ? counts.corners - 2 * uint64_t{counts.faces} : 0;
}

struct Header {
  uint32_t flags = 0;
  PayloadCounts counts;
};

/// A claim that is stored one or more below its value; 0 stands for one that does not fit 32 bits.
Index raised(uint32_t stored, Index by) {
  const uint64_t value = uint64_t{stored} + by;
  return value < kNone ? static_cast<Index>(value) : 0;
}

bool plausible(const Header& header) {
  const PayloadCounts& counts = header.counts;
  if (counts.wedges < counts.vertices || counts.groups == 0) return false;
  const bool welded = header.flags & kWeldedFlag;
  if (welded && !(header.flags & flagOf(Section::kSeams))) return false;
  if (welded && (counts.welded == 0 || counts.welded >= counts.vertices)) return false;
  if ((header.flags & flagOf(Section::kAttributes)) && counts.attributes == 0) return false;
  if (counts.attributes > kMaxAttributes) return false;
  if ((header.flags & kTriangleCountFlag) && counts.triangles == usualTriangles(counts)) return false;
  return counts.groups <= std::max(counts.faces, 1u);
}

Header readCounts(ByteReader& reader) {
  Header header;
  PayloadCounts& counts = header.counts;
  header.flags = reader.varint();
  counts.vertices = reader.varint();
  if (header.flags & kWeldedFlag) counts.welded = raised(reader.varint(), 1);
  counts.wedges = header.flags & flagOf(Section::kSeams) ? raised(reader.varint(), counts.vertices) : counts.vertices;
  counts.faces = reader.varint();
  counts.corners = reader.varint();
  counts.triangles = header.flags & kTriangleCountFlag ? reader.varint() : static_cast<Index>(usualTriangles(counts));
  if (header.flags & flagOf(Section::kGroups)) counts.groups = raised(reader.varint(), 1);
  if (header.flags & flagOf(Section::kAttributes)) counts.attributes = raised(reader.varint(), 1);
  return header;
}

Result<Header> readHeader(ByteReader& reader) {
  const auto magic = reader.take(kMagic.size());
  if (reader.error() != Error::kNone) return reader.error();
  if (!std::ranges::equal(magic, kMagic)) return Error::kMalformed;
  const uint8_t version = reader.byte();
  if (reader.error() == Error::kNone && version != kVersion) return Error::kUnsupportedVersion;
  const Header header = readCounts(reader);
  if (reader.error() != Error::kNone) return reader.error();
  if (header.flags & ~kKnownFlags) return Error::kMalformed;
  if (!(header.flags & flagOf(Section::kConnectivity))) return Error::kMissingSection;
  if (!plausible(header)) return Error::kMalformed;
  return header;
}

/// One line of the section table.
struct Entry {
  uint32_t length = 0;
  uint32_t checksum = 0;
};

using Table = std::array<Entry, kSectionCount>;

/// What every section's checksum starts with: the header and all lengths.
uint32_t headerChecksum(std::span<const uint8_t> header, const Table& table, uint32_t flags) {
  ByteWriter lengths;
  for (int s = 0; s < kSectionCount; ++s) {
    if (flags & 1u << s) lengths.varint(table[s].length);
  }
  return crc32(lengths.bytes(), crc32(header));
}

Table readTable(ByteReader& reader, uint32_t flags) {
  Table table;
  for (int s = 0; s < kSectionCount; ++s) {
    if (!(flags & 1u << s)) continue;
    table[s].length = reader.varint();
    table[s].checksum = reader.u32();
  }
  return table;
}

Error readSections(ByteReader& reader, const Table& table, PayloadView& view) {
  for (int s = 0; s < kSectionCount; ++s) {
    if (view.present[s]) view.sections[s] = reader.take(table[s].length);
  }
  if (reader.error() != Error::kNone) return reader.error();
  return reader.remaining() == 0 ? Error::kNone : Error::kTrailingBytes;
}

bool checksumsMatch(const PayloadView& view, const Table& table, uint32_t header_checksum) {
  for (int s = 0; s < kSectionCount; ++s) {
    if (view.present[s] && crc32(view.sections[s], header_checksum) != table[s].checksum) return false;
  }
  return true;
}

uint32_t flagsOf(const PayloadParts& parts) {
  uint32_t flags = parts.counts.triangles == usualTriangles(parts.counts) ? 0 : kTriangleCountFlag;
  if (parts.counts.welded > 0) flags |= kWeldedFlag;
  for (int s = 0; s < kSectionCount; ++s) flags |= parts.present[s] ? 1u << s : 0u;
  return flags;
}

void writeHeader(ByteWriter& writer, const PayloadCounts& counts, uint32_t flags) {
  writer.append(kMagic);
  writer.byte(kVersion);
  writer.varint(flags);
  writer.varint(counts.vertices);
  if (flags & kWeldedFlag) writer.varint(counts.welded - 1);
  if (flags & flagOf(Section::kSeams)) writer.varint(counts.wedges - counts.vertices);
  writer.varint(counts.faces);
  writer.varint(counts.corners);
  if (flags & kTriangleCountFlag) writer.varint(counts.triangles);
  if (flags & flagOf(Section::kGroups)) writer.varint(counts.groups - 1);
  if (flags & flagOf(Section::kAttributes)) writer.varint(counts.attributes - 1);
}

}  // namespace

std::string_view nameOf(Section section) {
  switch (section) {
    case Section::kConnectivity: return "CONNECTIVITY";
    case Section::kSeams: return "SEAMS";
    case Section::kGroups: return "GROUPS";
    case Section::kRings: return "RINGS";
    case Section::kTriangulation: return "TRIANGULATION";
    case Section::kAttributes: return "ATTRIBUTES";
  }
  return "unknown";
}

Result<PayloadView> parsePayload(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes);
  const Result<Header> header = readHeader(reader);
  if (!header) return header.error();
  const auto head = bytes.first(reader.position());
  const Table table = readTable(reader, header->flags);
  if (reader.error() != Error::kNone) return reader.error();

  PayloadView view;
  view.counts = header->counts;
  view.header_bytes = static_cast<uint32_t>(reader.position());
  for (int s = 0; s < kSectionCount; ++s) view.present[s] = header->flags >> s & 1;
  if (const Error error = readSections(reader, table, view); error != Error::kNone) return error;
  if (!checksumsMatch(view, table, headerChecksum(head, table, header->flags))) return Error::kChecksum;
  return view;
}

Result<PayloadCounts> peekCounts(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes);
  const Result<Header> header = readHeader(reader);
  if (!header) return header.error();
  return header->counts;
}

std::vector<uint8_t> writePayload(const PayloadParts& parts) {
  const uint32_t flags = flagsOf(parts);
  ByteWriter writer;
  writeHeader(writer, parts.counts, flags);
  Table table;
  for (int s = 0; s < kSectionCount; ++s) table[s].length = static_cast<uint32_t>(parts.sections[s].size());
  const uint32_t header_checksum = headerChecksum(writer.bytes(), table, flags);
  for (int s = 0; s < kSectionCount; ++s) {
    if (!parts.present[s]) continue;
    writer.varint(table[s].length);
    writer.u32(crc32(parts.sections[s], header_checksum));
  }
  for (int s = 0; s < kSectionCount; ++s) {
    if (parts.present[s]) writer.append(parts.sections[s]);
  }
  return std::move(writer).take();
}

}  // namespace tutte
