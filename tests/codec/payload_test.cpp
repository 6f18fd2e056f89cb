// The container: every count and section comes back, every damaged bit is noticed.

#include "codec/payload.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "codec/bytes.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;

TEST(Bytes, Crc32OfTheStandardExample) {
  const std::array<uint8_t, 9> digits = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc32(digits), 0xCBF43926u);
  EXPECT_EQ(crc32(std::span(digits).subspan(4), crc32(std::span(digits).first(4))), 0xCBF43926u);
  EXPECT_EQ(crc32({}), 0u);
}

TEST(Bytes, VarintsComeBackInTheirShortestForm) {
  for (const uint32_t value : {0u, 1u, 127u, 128u, 16383u, 16384u, 0x0FFFFFFFu, 0x10000000u, 0xFFFFFFFFu}) {
    ByteWriter writer;
    writer.varint(value);
    ByteReader reader(writer.bytes());
    EXPECT_EQ(reader.varint(), value);
    EXPECT_EQ(reader.error(), Error::kNone);
    EXPECT_EQ(reader.remaining(), 0u);
  }
}

TEST(Bytes, RefusesVarintsThatAreNotCanonical) {
  for (const Bytes& bytes : {Bytes{0x80, 0x00}, Bytes{0xFF, 0x80, 0x00}, Bytes{0xFF, 0xFF, 0xFF, 0xFF, 0x10},
                             Bytes{0x80, 0x80, 0x80, 0x80, 0x80, 0x01}}) {
    ByteReader reader(bytes);
    reader.varint();
    EXPECT_EQ(reader.error(), Error::kMalformed);
  }
}

TEST(Bytes, ErrorsStick) {
  const Bytes bytes = {0x80};
  ByteReader reader(bytes);
  EXPECT_EQ(reader.varint(), 0u);
  EXPECT_EQ(reader.error(), Error::kTruncated);
  EXPECT_EQ(reader.byte(), 0u);
  EXPECT_TRUE(reader.take(0).empty());
  EXPECT_EQ(reader.error(), Error::kTruncated);
}

Bytes someBytes(size_t count, uint64_t seed) {
  shapes::Random random(seed);
  Bytes bytes(count);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next());
  return bytes;
}

/// A payload with the sections whose bits are set in `mask`.
PayloadParts parts(unsigned mask) {
  PayloadParts result;
  result.counts = {8, 8, 6, 24, 12, 1, 0};
  for (int s = 0; s < kSectionCount; ++s) {
    if (mask >> s & 1) result.set(static_cast<Section>(s), someBytes(5 * static_cast<size_t>(s) + 1, mask));
  }
  if (mask >> static_cast<int>(Section::kSeams) & 1) result.counts.wedges = 300;
  if (mask >> static_cast<int>(Section::kSeams) & mask >> static_cast<int>(Section::kRings) & 1)
    result.counts.welded = 7;
  if (mask >> static_cast<int>(Section::kGroups) & 1) result.counts.groups = 4;
  if (mask >> static_cast<int>(Section::kAttributes) & 1) result.counts.attributes = 3;
  if (mask >> static_cast<int>(Section::kTriangulation) & 1) result.counts.triangles = 1000;
  return result;
}

TEST(Payload, KeepsCountsAndSections) {
  for (unsigned mask = 1; mask < 64; mask += 2) {
    const PayloadParts stored = parts(mask);
    const Bytes bytes = writePayload(stored);
    const Result<PayloadView> view = parsePayload(bytes);
    ASSERT_TRUE(view.ok()) << mask;
    EXPECT_EQ(view->counts, stored.counts);
    EXPECT_EQ(view->present, stored.present);
    for (int s = 0; s < kSectionCount; ++s) {
      EXPECT_EQ(Bytes(view->sections[s].begin(), view->sections[s].end()), stored.sections[s]);
    }
    const Result<PayloadCounts> counts = peekCounts(bytes);
    ASSERT_TRUE(counts.ok());
    EXPECT_EQ(*counts, stored.counts);
  }
}

TEST(Payload, GoldenBytes) {
  PayloadParts stored;
  stored.counts = {8, 8, 6, 24, 12, 1, 0};
  stored.set(Section::kConnectivity, {0xAB, 0xCD});
  const Bytes head = {'T', 'U', 'T', 'T', 0, 0x01, 8, 6, 24};
  Bytes covered = head;
  covered.insert(covered.end(), {2, 0xAB, 0xCD});
  Bytes expected = head;
  expected.push_back(2);
  const uint32_t checksum = crc32(covered);
  for (int shift = 0; shift < 32; shift += 8) expected.push_back(static_cast<uint8_t>(checksum >> shift));
  expected.insert(expected.end(), {0xAB, 0xCD});
  EXPECT_EQ(writePayload(stored), expected);
  EXPECT_EQ(checksum, 0x296BEC7Au);
}

TEST(Payload, GoldenHeadOfAWeldedMesh) {
  PayloadParts stored;
  stored.counts = {24, 24, 6, 24, 12, 1, 0, 16};
  stored.set(Section::kConnectivity, {0xAB});
  stored.set(Section::kSeams, {});
  const Bytes bytes = writePayload(stored);
  const Bytes head = {'T', 'U', 'T', 'T', 0, 0x83, 0x01, 24, 15, 0, 6, 24};
  EXPECT_TRUE(std::ranges::equal(std::span(bytes).first(head.size()), head));
}

TEST(Payload, NoticesEveryFlippedBit) {
  for (const unsigned mask : {1u, 3u, 33u, 63u}) {
    Bytes bytes = writePayload(parts(mask));
    for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
      EXPECT_FALSE(parsePayload(bytes).ok()) << mask << " bit " << bit;
      bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    }
  }
}

TEST(Payload, NoticesEveryTruncationAndWhatIsBehindTheEnd) {
  for (const unsigned mask : {1u, 63u}) {
    Bytes bytes = writePayload(parts(mask));
    for (size_t size = 0; size < bytes.size(); ++size) {
      const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      const Result<PayloadView> view = parsePayload(cut);
      ASSERT_FALSE(view.ok());
      EXPECT_EQ(view.error(), Error::kTruncated);
    }
    bytes.push_back(0);
    EXPECT_EQ(parsePayload(bytes).error(), Error::kTrailingBytes);
  }
}

Error errorOf(Bytes bytes) {
  const Result<PayloadView> view = parsePayload(bytes);
  return view ? Error::kNone : view.error();
}

TEST(Payload, NamesWhatIsWrongWithTheHeader) {
  const Bytes good = writePayload(parts(1));
  const auto with = [&](size_t at, uint8_t value) {
    Bytes bytes = good;
    bytes[at] = value;
    return bytes;
  };
  EXPECT_EQ(errorOf(with(0, 'X')), Error::kMalformed);
  EXPECT_EQ(errorOf(with(4, 1)), Error::kUnsupportedVersion);
  EXPECT_EQ(errorOf(with(5, 0)), Error::kMissingSection);
  EXPECT_EQ(errorOf(with(9, 77)), Error::kTruncated);
  EXPECT_EQ(errorOf(with(good.size() - 1, static_cast<uint8_t>(good.back() ^ 1))), Error::kChecksum);

  ByteWriter reserved;
  for (const char c : {'T', 'U', 'T', 'T', '\0'}) reserved.byte(static_cast<uint8_t>(c));
  reserved.varint(0x101);
  for (int i = 0; i < 20; ++i) reserved.byte(1);
  EXPECT_EQ(errorOf(Bytes(reserved.bytes().begin(), reserved.bytes().end())), Error::kMalformed);
}

TEST(Payload, RefusesImpossibleCounts) {
  PayloadParts groups = parts(5);
  groups.counts.groups = 7;  // six faces
  EXPECT_EQ(errorOf(writePayload(groups)), Error::kMalformed);
  PayloadParts wedges = parts(3);
  wedges.counts.vertices = 0xFFFFFFF0u;
  wedges.counts.wedges = 0x20u;  // the sum does not fit
  EXPECT_EQ(errorOf(writePayload(wedges)), Error::kMalformed);
  PayloadParts points = parts(3);
  points.counts.welded = 8;  // no point is left
  EXPECT_EQ(errorOf(writePayload(points)), Error::kMalformed);
  PayloadParts seamless = parts(1);
  seamless.counts.welded = 1;
  EXPECT_EQ(errorOf(writePayload(seamless)), Error::kMalformed);
  PayloadParts attributes = parts(33);
  attributes.counts.attributes = kMaxAttributes + 1;
  EXPECT_EQ(errorOf(writePayload(attributes)), Error::kMalformed);
}

}  // namespace
}  // namespace tutte
