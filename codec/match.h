#pragma once
// Predicts that what followed the last few symbols before will follow them again.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "codec/borrowed.h"
#include "codec/mesh.h"
#include "codec/mixer.h"

namespace tutte {

/// What a MatchModel remembers. Positions up to `past` are those of earlier meshes, so that nothing has to be cleared.
struct MatchMemory {
  std::vector<uint8_t> history;
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
  int lengthClass() const { return kLengthClass[std::min(length_, kLongest)]; }

  /// The slot of the opinion that a decision goes the way the expected symbol says.
  Slot& opinion(bool expected_bit) { return slots_[lengthClass() * 2 + expected_bit]; }

  void add(Index symbol) {
    if (used_) note(symbol);
  }

 private:
  [[gnu::noinline]] void note(Index symbol) {
    if (size_ == room_) grow();
    history_[size_++] = static_cast<uint8_t>(symbol);
    key_ = (key_ << 8 | (symbol + 1)) & 0xFFFFFFFFFFFFu;
    length_ = symbol == expected_ ? std::min(length_ + 1, 65535) : 0;
    ++position_;
    if (size_ < kLeast) return;
    Index& latest = positions_[key_ * 0x9E3779B97F4A7C15u >> (64 - kTableBits)];
    if (length_ == 0 && latest > past_) find(latest - past_);
    latest = past_ + static_cast<Index>(size_);
    expected_ = length_ == 0 ? kNoSymbol : history_[position_];
  }

  [[gnu::noinline]] void grow() {
    std::vector<uint8_t>& history = memory_->history;
    history.resize(std::max<size_t>({256, history.size(), 2 * size_}));
    history_ = history.data();
    room_ = history.size();
  }

  static constexpr int kTableBits = 13;
  static constexpr int kLeast = 6, kMost = 32;
  static constexpr Index kMostPast = 1u << 30;

  void find(Index candidate) {
    const size_t end = size_;
    int length = 0;
    while (length < kMost && static_cast<Index>(length) < candidate &&
           history_[candidate - 1 - length] == history_[end - 1 - length]) {
      ++length;
    }
    if (length < kLeast) return;
    position_ = candidate;
    length_ = length;
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
