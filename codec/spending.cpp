#include "codec/spending.h"

#include <cmath>

#include "codec/decode_section.h"

namespace tutte {
namespace {

// A reader that adds up what it reads, by topic.
class CountingReader : public RangeReader {
 public:
  using RangeReader::RangeReader;

  void reportTo(Spending& spending) { spending_ = &spending; }

  void about(Topic topic) {
    topic_ = topic;
    since_ = {};
  }

  // What was read since about(from) belongs to another topic. In a copy of a component nothing was.
  void move(Topic from, Topic to) {
    if (topic_ != from) return;
    add(from, {-since_.bits, 0 - since_.decisions});
    add(to, since_);
    about(to);
  }

  bool code(Probability one, bool = false) {
    const bool value = RangeReader::code(one);
    count(16 - std::log2(value ? one : 65536 - one));
    return value;
  }

  Index uniform(Index choices, Index = 0) {
    count(std::log2(choices));
    return RangeReader::uniform(choices);
  }

  void take(Index start, Index size, Index total) {
    count(std::log2(total) - std::log2(size));
    RangeReader::take(start, size, total);
  }

 private:
  void count(double bits) {
    since_.bits += bits;
    ++since_.decisions;
    add(topic_, {bits, 1});
  }

  void add(Topic topic, const TopicBits& more) {
    TopicBits& sum = spending_->topics[static_cast<size_t>(topic)];
    sum.bits += more.bits;
    sum.decisions += more.decisions;
  }

  Spending* spending_ = nullptr;
  Topic topic_ = Topic::kComponents;
  TopicBits since_;
};

// Tells the reader what only the answers show: that a valence was a split, a degree that of a dummy face.
class Accountant : public Unwatched {
 public:
  explicit Accountant(Spending& spending) : spending_(spending) {}

  void open(CountingReader& reader) {
    reader_ = &reader;
    reader.reportTo(spending_);
  }

  void face(const FaceQuestion&, const FaceAnswer& answer) {
    if (answer.dummy) reader_->move(Topic::kDegrees, Topic::kHoles);
  }

  void vertex(const VertexQuestion&, Index valence) {
    if (valence == 0) reader_->move(Topic::kValences, Topic::kSplits);
  }

 private:
  Spending& spending_;
  CountingReader* reader_ = nullptr;
};

}  // namespace

std::string_view nameOf(Topic topic) {
  constexpr std::array<std::string_view, kTopicCount> kNames = {
      "components", "copies", "valences", "splits", "degrees", "holes", "flips", "strays", "joins", "isolated"};
  return kNames[static_cast<size_t>(topic)];
}

Result<Spending> spendingOf(std::span<const uint8_t> section, const Limits& limits) {
  Spending spending;
  Accountant accountant(spending);
  CodecMemory memory;
  const Result<Connectivity> mesh = decodeSection<CountingReader>(section, limits, accountant, memory);
  if (!mesh) return mesh.error();
  SectionHeader header;
  const Result<std::span<const uint8_t>> symbols = readSection(section, header);
  if (!symbols) return symbols.error();
  const double symbol_bits = 8.0 * static_cast<double>(symbols->size());
  spending.head_bits = 8.0 * static_cast<double>(section.size()) - symbol_bits;
  spending.end_bits = symbol_bits;
  for (const TopicBits& topic : spending.topics) spending.end_bits -= topic.bits;
  return spending;
}

}  // namespace tutte
