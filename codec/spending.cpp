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

  // What was read since about() belongs to another topic.
  void move(Topic topic) {
    add(topic_, {-since_.bits, 0 - since_.decisions});
    add(topic, since_);
    about(topic);
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

// Tells the readers what only the answers show: that a valence was a split, a degree that of a dummy face.
class Accountant : public Unwatched {
 public:
  explicit Accountant(Spending& spending) : spending_(spending) {}

  void open(CountingReader& valences, CountingReader& degrees) {
    valences_ = &valences;
    degrees_ = &degrees;
    valences.reportTo(spending_);
    degrees.reportTo(spending_);
  }

  void face(const FaceQuestion&, const FaceAnswer& answer) {
    if (answer.dummy) degrees_->move(Topic::kHoles);
  }

  void vertex(const VertexQuestion&, Index valence) {
    if (valence == 0) valences_->move(Topic::kSplits);
  }

 private:
  Spending& spending_;
  CountingReader* valences_ = nullptr;
  CountingReader* degrees_ = nullptr;
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
  const Result<Connectivity> mesh = decodeSection<CountingReader>(section, limits, accountant);
  if (!mesh) return mesh.error();
  SectionHeader header;
  const Result<SectionStreams> streams = readSection(section, header);
  if (!streams) return streams.error();
  const double stream_bits = 8.0 * static_cast<double>(streams->valences.size() + streams->degrees.size());
  spending.head_bits = 8.0 * static_cast<double>(section.size()) - stream_bits;
  spending.end_bits = stream_bits;
  for (const TopicBits& topic : spending.topics) spending.end_bits -= topic.bits;
  return spending;
}

}  // namespace tutte
