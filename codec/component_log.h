#pragma once
// The symbols of components, kept so that a later component can repeat them without coding them again.

#include <algorithm>
#include <vector>

#include "codec/mesh.h"
#include "codec/model.h"

namespace tutte {

/// Either records the current component, or replays an earlier one. Does nothing where copies are not in use.
class ComponentLog {
 public:
  explicit ComponentLog(bool used) : used_(used) {}

  /// Codes whether the component that begins repeats an earlier one, and which: the more recently used, the cheaper.
  /// `original` is the encoder's knowledge; one that was not used for long is coded again. Returns false where the
  /// stream names a component that does not exist.
  template <class Port>
  bool begin(Port& port, Index original) {
    replaying_ = false;
    if (!used_) return true;
    const Index number = components_++;
    const auto known =
        std::find_if(recent_.begin(), recent_.end(), [&](const Entry& e) { return e.number == original; });
    const bool copy = !recent_.empty() && copy_.code(port, known != recent_.end());
    if (copy) {
      const Index rank = rank_.code(port, static_cast<Index>(known - recent_.begin()));
      if (rank >= recent_.size()) return false;
      std::rotate(recent_.begin(), recent_.begin() + rank, recent_.begin() + rank + 1);
      replaying_ = true;
      at_ = recent_.front().start;
    } else {
      recent_.insert(recent_.begin(), {number, size_});
      if (recent_.size() > kMost) recent_.pop_back();
    }
    return true;
  }

  bool replaying() const { return replaying_; }

  /// The number of the component that the current one repeats; kNone: none.
  Index original() const { return replaying_ ? recent_.front().number : kNone; }

  /// Of the current component: the next symbol that was recorded.
  Index next() { return at_ < size_ ? symbols_[at_++] : kNone; }

  void add(Index symbol) {
    if (!used_) return;
    if (size_ == symbols_.size()) symbols_.resize(std::max<size_t>(256, 2 * size_));
    symbols_[size_++] = symbol;
  }

  /// Components that can still be referred to.
  static constexpr Index kMost = 64;

 private:
  struct Entry {
    Index number;
    size_t start;
  };

  bool used_;
  bool replaying_ = false;
  Index components_ = 0;
  size_t at_ = 0;
  std::vector<Index> symbols_;  // the first size_ are in use
  size_t size_ = 0;
  std::vector<Entry> recent_;
  Bit copy_;
  NumberModel rank_;
};

}  // namespace tutte
