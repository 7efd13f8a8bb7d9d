// Lines and words of tables (CSV), as far as tables of numbers need them: no quotes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

/// Goes through the lines of a text that are not blank. A byte order mark before the first is skipped.
class CsvLines {
 public:
  explicit CsvLines(std::string_view text);

  /// Goes to the next line. False at the end of the text.
  bool next();
  std::string_view line() const { return line_; }
  std::uint64_t number() const { return number_; }  ///< From 1; blank lines count.

 private:
  std::string_view rest_, line_;
  std::uint64_t number_ = 0;
};

/// The words between commas, without the blanks around them.
std::vector<std::string_view> csv_words(std::string_view line);

/// The bytes of a file; "-": of standard input. Error: kInvalidMesh, with the name of the file, or stdin.
Result<std::string> read_table(const std::string& path);

}  // namespace medial_vk
