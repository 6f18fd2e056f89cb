#pragma once
// A Markdown document under construction.

#include <cstdint>
#include <string>
#include <vector>

namespace tutte::theory {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// 12345 -> "12,345".
std::string withCommas(uint64_t number);

/// Rows of equally many cells under a heading.
class Table {
 public:
  explicit Table(std::vector<std::string> head);
  void add(const std::vector<std::string>& cells);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace tutte::theory
