#pragma once
// Feeds OBJ text to tinyobjloader line by line, so that its callbacks know where they are.

#include <cstdint>
#include <span>
#include <streambuf>
#include <string>
#include <string_view>

namespace tutte {

/// A stream buffer that hands out one line at a time: while tinyobjloader works on a line, number() and line() tell
/// which. Lines that end in a backslash are joined; comments behind vertices and faces are cut off.
class ObjLines : public std::streambuf {
 public:
  explicit ObjLines(std::span<const uint8_t> bytes) : rest_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  size_t number() const { return number_; }             ///< of the line, from 1
  std::string_view line() const { return statement_; }  ///< without its end
  void stop() { rest_ = {}; }                           ///< ends the stream behind this line

  size_t empty_faces = 0;       ///< first line with an `f` that names no vertex, or 0
  size_t points_and_lines = 0;  ///< lines with other geometry than faces
  size_t groups = 0;            ///< lines that name groups or objects

 protected:
  int_type underflow() override {
    if (rest_.empty()) return traits_type::eof();
    text_.clear();
    number_ += lines_taken_;
    lines_taken_ = 0;
    bool more = true;
    while (more && !rest_.empty()) more = takeLine();
    statement_ = std::string_view(text_);
    cutComment();
    count();
    text_.resize(statement_.size());
    text_.push_back('\n');
    statement_ = std::string_view(text_).substr(0, text_.size() - 1);
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(text_[0]);
  }

 private:
  /// Appends the next line to text_; true when it goes on in the one after it.
  bool takeLine() {
    const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    std::string_view taken = rest_.substr(0, end);
    const bool crlf = rest_.substr(end).starts_with("\r\n");
    rest_.remove_prefix(std::min(end + (crlf ? 2 : 1), rest_.size()));
    ++lines_taken_;
    const bool more = taken.ends_with('\\');
    if (more) taken.remove_suffix(1);
    text_.append(taken);
    return more;
  }

  void cutComment() {
    const size_t first = statement_.find_first_not_of(" \t");
    if (first == statement_.npos || (statement_[first] != 'v' && statement_[first] != 'f')) return;
    statement_ = statement_.substr(0, statement_.find('#'));
  }

  void count() {
    const size_t first = statement_.find_first_not_of(" \t");
    if (first == statement_.npos) return;
    const std::string_view rest = statement_.substr(first);
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
    if (word == "f" && rest.find_first_not_of(" \t", 1) == rest.npos && !empty_faces) empty_faces = number_;
    points_and_lines += word == "p" || word == "l" || word == "curv" || word == "curv2" || word == "surf";
    groups += word == "g" || word == "o";
  }

  std::string_view rest_;
  std::string_view statement_;
  std::string text_;
  size_t number_ = 0;
  size_t lines_taken_ = 1;
};

}  // namespace tutte
