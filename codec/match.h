#pragma once
// Predicts that what followed the last few symbols before will follow them again.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "codec/borrowed.h"
#include "codec/mesh.h"
#include "codec/mixer.h"

namespace tutte {

/// What a MatchModel remembers. Positions up to `past` are those of earlier meshes, so that nothing has to be cleared.
struct MatchMemory {
  std::vector<uint8_t> history;  ///< the symbols, behind eight bytes that are none
  std::vector<Index> positions;
  Index past = 0;
};

class MatchModel {
 public:
  static constexpr Index kNoSymbol = 255;

  MatchModel(bool used, MatchMemory& memory) : used_(used), memory_(memory) {
    std::vector<Index>& positions = memory_->positions;
    if (used && (positions.empty() || memory_->past > kMostPast)) {
      positions.assign(size_t{1} << kTableBits, 0);
      memory_->past = 0;
    }
    positions_ = positions.data();
    past_ = memory_->past;
  }
  ~MatchModel() { memory_->past += static_cast<Index>(size_); }

  /// The symbol that the match expects next, or kNoSymbol. Symbols are valences (0 for a split) or, plus 128, degrees
  /// (1 for a dummy face), each up to 100.
  Index expected() const { return expected_; }

  /// How far the match reaches back, in 8 steps; 0 without a match.
  int lengthClass() const { return kLengthClass[length_]; }

  /// The slot of the opinion that a decision goes the way the expected symbol says.
  Slot& opinion(bool expected_bit) { return slots_[lengthClass() * 2 + expected_bit]; }

  void add(Index symbol) {
    if (used_) note(symbol);
  }

 private:
  [[gnu::noinline]] void note(Index symbol) {
    if (size_ == room_) grow();
    history_[size_++] = static_cast<uint8_t>(symbol);
    key_ = key_ << 8 | (symbol + 1);
    Index& place = positions_[(key_ << 8 * (8 - kLeast)) * 0x9E3779B97F4A7C15u >> (64 - kTableBits)];
    const Index latest = place;
    place = past_ + static_cast<Index>(size_);
    if (symbol == expected_) {
      length_ += length_ < kLongest;
      expected_ = history_[++position_];
    } else {
      length_ = 0;
      expected_ = latest > past_ && find(latest - past_) ? history_[position_] : kNoSymbol;
    }
  }

  [[gnu::noinline]] void grow() {
    std::vector<uint8_t>& history = memory_->history;
    history.resize(std::max<size_t>({256, history.size(), 2 * size_}), kNoSymbol);
    history_ = history.data() + kWord;
    room_ = history.size() - kWord;
  }

  static constexpr int kTableBits = 13;
  static constexpr int kLeast = 6, kMost = 32, kWord = 8;
  static constexpr Index kMostPast = 1u << 30;

  bool find(Index candidate) {
    const uint8_t *at = history_ + candidate, *end = history_ + size_;
    uint64_t differing = wordBefore(at) ^ wordBefore(end);
    if (differing >> 8 * (kWord - kLeast) != 0) return false;
    int length = 0;
    for (; differing == 0 && length < kMost - kWord; length += kWord) {
      differing = wordBefore(at -= kWord) ^ wordBefore(end -= kWord);
    }
    position_ = candidate;
    length_ = length + std::countl_zero(differing) / 8;
    return true;
  }

  // Eight symbols, the last one on top. What comes before the first is none.
  static uint64_t wordBefore(const uint8_t* end) {
    uint64_t word = 0;
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(&word, end - kWord, kWord);
    } else {
      for (int i = 1; i <= kWord; ++i) word = word << 8 | end[-i];
    }
    return word;
  }

  // By the length of the match.
  static constexpr int kLongest = 64;
  static constexpr std::array<uint8_t, kLongest + 1> kLengthClass = [] {
    std::array<uint8_t, kLongest + 1> classes{};
    for (const int step : {1, 8, 12, 16, 24, 32, 64}) {
      for (int length = step; length <= kLongest; ++length) ++classes[length];
    }
    return classes;
  }();

  bool used_;
  uint64_t key_ = 0;
  Index position_ = 0;
  int length_ = 0;
  Borrowed<MatchMemory> memory_;
  uint8_t* history_ = nullptr;
  size_t size_ = 0, room_ = 0;  // of the history
  Index* positions_ = nullptr;
  Index past_ = 0;
  Index expected_ = kNoSymbol;
  std::array<Slot, 16> slots_;
};

/// Predicts nothing.
class NoMatch {
 public:
  NoMatch(bool, MatchMemory&) {}
  static constexpr Index expected() { return MatchModel::kNoSymbol; }
  static void add(Index) {}
};

}  // namespace tutte
