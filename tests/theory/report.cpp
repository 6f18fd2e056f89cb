#include "tests/theory/report.h"

#include <cstdarg>
#include <cstdio>

namespace tutte::theory {

std::string formatted(const char* format, ...) {
  char buffer[1024];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

std::string withCommas(uint64_t number) {
  std::string digits;
  for (int place = 0; place == 0 || number != 0; ++place, number /= 10) {
    if (place > 0 && place % 3 == 0) digits += ',';
    digits += static_cast<char>('0' + number % 10);
  }
  return {digits.rbegin(), digits.rend()};
}

Table::Table(std::vector<std::string> head) {
  add(head);
  add(std::vector<std::string>(head.size(), "---"));
}

void Table::add(const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) text_ += "| " + cell + " ";
  text_ += "|\n";
}

}  // namespace tutte::theory
