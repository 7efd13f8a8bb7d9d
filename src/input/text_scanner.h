// Words and numbers of a text file, line by line, without copies and without the locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/quoted.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// kInvalidMesh with "name:line: what".
Error line_error(const std::string& name, std::uint64_t line, std::string_view what);
/// kInvalidMesh with "name: what".
Error file_error(const std::string& name, std::string_view what);

/// Parses decimal or scientific notation, with an optional leading '+', to the nearest double; a number that is too
/// small for a double gives 0. False, with `why` set, for a word that is not a number, is beyond the range of a double,
/// or is infinite or nan.
bool parse_coordinate(std::string_view word, double& value, std::string_view& why);
/// Parses a decimal integer with an optional sign. False for a word that is not an integer, or exceeds 64 bits.
bool parse_integer(std::string_view word, std::int64_t& value);

/// Reads words separated by blanks and tabs. Lines end with LF, CR LF or CR. With `comment`, that character hides the
/// rest of its line; with `continuation`, a backslash before the end of a line joins it to the next (OBJ).
class TextScanner {
 public:
  TextScanner(std::string_view text, char comment, bool continuation)
      : at_(text.data()), end_(text.data() + text.size()), comment_(comment), continuation_(continuation) {}

  /// The next word of this line; empty at its end.
  std::string_view word();
  /// The next word of this line or a later one; empty at the end of the text.
  std::string_view word_across_lines();
  /// Skips the rest of this line. False at the end of the text.
  bool next_line();
  /// The line of the last word read, from 1.
  std::uint64_t line() const { return line_; }
  bool at_end() const { return at_ == end_; }
  std::uint64_t bytes_left() const { return static_cast<std::uint64_t>(end_ - at_); }

 private:
  bool at_line_end() const { return *at_ == '\n' || *at_ == '\r'; }
  void step_over_line_end();

  const char* at_;
  const char* end_;
  char comment_;  // 0: none
  bool continuation_;
  std::uint64_t line_ = 1;
};

}  // namespace medial_vk
